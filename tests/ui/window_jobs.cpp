// Tests background jobs in a real window: cancelling, and which job replaces or refuses another.

#include <QFile>
#include <QPushButton>
#include <QToolButton>
#include <semaphore>

#include "document/edits.h"
#include "io/file_actions.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_jobs {

namespace {

/// A job that waits at a gate until the test opens it or the job is cancelled.
class Gate {
 public:
  Jobs::Work work(MeshPointer mesh, Document& document) {
    return [this, mesh = std::move(mesh), &document](const Progress& progress) -> Jobs::Finish {
      reached_ = true;
      while (!open_.try_acquire_for(std::chrono::milliseconds(1))) {
        progress.report(0.4);
      }
      return
          [mesh, &document] { edits::replaceMesh(document, mesh, QStringLiteral("new"), QStringLiteral("open new")); };
    };
  }
  bool reached() const { return reached_; }
  void open() { open_.release(); }

 private:
  std::atomic<bool> reached_ = false;
  std::counting_semaphore<> open_{0};
};

MeshPointer another() { return generate({MeshKind::cloth, {5, 4, 1}, 1, {}}); }

}  // namespace

class WindowJobs : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void theHandDragsOnWhileAFileIsOpened() {
    Gate gate;
    Workbench bench;
    load(bench, gate);
    const Point before = bench.position(1, 31);
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(140, -90)}, false);
    QTRY_VERIFY(bench.position(1, 31) != before);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from);
    QVERIFY(bench.window.jobs().running());
    gate.open();
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), 20U);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("open new"));
  }

  void cancellingLeavesTheObject() {
    Gate gate;
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    load(bench, gate);
    QTRY_VERIFY(bench.find<QWidget>("jobBar")->isVisible());
    QTest::mouseClick(bench.find<QToolButton>("jobCancel"), Qt::LeftButton);
    QVERIFY(!bench.window.jobs().running());  // at once
    QVERIFY(!bench.find<QWidget>("jobBar")->isVisible());
    gate.open();
    bench.settle();
    QCOMPARE(bench.document().mesh(), before);
    QVERIFY(!bench.document().undoStack().canUndo());
    QVERIFY(!bench.window.messages().isVisible());
  }

  void escapeIsFirstTheToolsThenTheJobs() {
    Gate gate;
    Workbench bench;
    bench.trigger("toolCut");
    load(bench, gate);
    const QPoint from = bench.place(0, 20);
    bench.stroke(0, {from, from + QPoint(60, 60)}, false);
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(bench.window.jobs().running());
    QVERIFY(bench.document().highlight().marks().links.empty());
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from);
    QCOMPARE(bench.document().cuts().count(), 0U);
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(!bench.window.jobs().running());
  }

  void whatIsLoadedLaterReplacesWhatIsBeingLoaded() {
    Gate gate;
    Workbench bench;
    load(bench, gate);
    bench.find<QPushButton>("buildMesh")->click();  // while the first job waits
    QVERIFY(bench.window.jobs().text().startsWith(QStringLiteral("Building")));
    bench.settle();
    QVERIFY(bench.document().undoStack().undoText().startsWith(QStringLiteral("build")));
    QCOMPARE(bench.document().undoStack().count(), 1);
  }

  void savingGivesWayToNothingUnasked() {
    Gate gate;
    Workbench bench;
    bench.window.jobs().start(Jobs::Kind::save, QStringLiteral("Saving a.obj"), gate.work(another(), bench.document()));
    bench.window.openFile(QStringLiteral("b.obj"));
    QVERIFY(bench.window.messages().isVisible());
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("Saving a.obj")));
    QCOMPARE(bench.window.jobs().text(), QStringLiteral("Saving a.obj"));
    gate.open();
    bench.settle();
    QCOMPARE(bench.document().undoStack().count(), 1);  // the save job finished
  }

  void savingDoesNotEndAnOpening() {
    Gate gate;
    Workbench bench;
    load(bench, gate);
    const QString path = folder_.filePath(QStringLiteral("not now.obj"));
    bench.window.findChild<FileActions*>()->savePath(path);
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("Opening new.obj")));
    gate.open();
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), 20U);
    QVERIFY(!QFile::exists(path));
  }

  void theFirstObjectIsNoStepOfUndo() {
    const QString path = folder_.filePath(QStringLiteral("first.obj"));
    Workbench bench;
    bench.window.findChild<FileActions*>()->savePath(path);
    bench.settle();
    const bool first = true;
    bench.window.openFile(path, first);
    bench.settle();
    QVERIFY(bench.window.windowTitle().startsWith(QStringLiteral("first.obj")));
    QVERIFY(!bench.document().undoStack().canUndo());
  }

 private:
  static void load(Workbench& bench, Gate& gate) {
    bench.window.jobs().start(Jobs::Kind::load, QStringLiteral("Opening new.obj"),
                              gate.work(another(), bench.document()));
  }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowJobs)

}  // namespace chainmail::window_jobs

#include "window_jobs.moc"
