// Sessions in a real window: saved, opened, dropped, and what a crash leaves.

#include <QDir>
#include <QDropEvent>
#include <QFile>
#include <QMimeData>
#include <QProcess>
#include <QPushButton>
#include <csignal>

#include "autosave.h"
#include "file_actions.h"
#include "message_bar.h"
#include "recovery_bar.h"
#include "session_draft.h"
#include "sessions.h"
#include "window.h"
#include "window_look.h"

using namespace chainmail;

namespace {

MeshPointer cloth() { return generate({MeshKind::cloth, {12, 9, 1}, 0.7, {}}); }

void drag(Document& document, ElementId element, const Point& by) {
  document.grab(element);
  document.drag(document.mesh()->rest_position(element) + by);
  document.release();
}

/// A bit of everything that a session holds.
void work(Workbench& bench) {
  Document& document = bench.document();
  document.setAlgorithm(0, Algorithm::exact);
  document.setAlgorithm(1, Algorithm::spiral);
  document.setPinned({0, 11}, true);
  document.cut({3, 40});
  document.setSoftness({0.7, 1.3, 0.15}, QStringLiteral("softness"));
  document.setSoftnessOf({5, 6}, LinkSoftness{1, 1, 0});
  document.setRelaxation({false, 0.5, RelaxationScheme::link});
  drag(document, 50, {1.3, -0.9, 0});
  drag(document, 100, {-0.1, 1.0 / 3, 0});
  bench.settle();
}

Session sessionOf(Workbench& bench) { return SessionDraft(bench.document(), lookOf(bench.window)).finished({}); }

QStringList autosaved() { return QDir(Autosave::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

/// Works, says what there is when it is on the disk, and goes on until it is killed.
int crashingProgram(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  QApplication application(argc, argv);
  styleApplication();
  Workbench bench(cloth());
  bench.window.sessions().protect();
  bench.document().setSessionFile(QStringLiteral("/somewhere/mine.chainmail"));
  work(bench);
  save_session(argv[2], sessionOf(bench));
  std::puts("worked");
  std::fflush(stdout);
  return QApplication::exec();
}

}  // namespace

class WindowSession : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void everythingComesBackToTheBit() {
    const QString path = folder_.filePath(QStringLiteral("a.chainmail"));
    Session before;
    Camera::Pose pose;
    {
      Workbench bench(cloth());
      work(bench);
      bench.view(0).camera()->zoom(1.7, {20, 30}, bench.view(0).size());
      bench.window.colouring().setMode(ColourMode::violation);
      pose = bench.view(0).camera()->pose();
      bench.window.sessions().savePath(path);
      bench.settle();
      QVERIFY2(QFile::exists(path), qPrintable(bench.window.messages().sentence()));
      before = sessionOf(bench);
    }
    Workbench bench;
    bench.open(path);
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
    compare(sessionOf(bench), before);
    QCOMPARE(bench.document().sessionFile(), path);
    QCOMPARE(bench.window.colouring().mode(), ColourMode::violation);
    QCOMPARE(bench.view(0).camera()->pose().height, pose.height);
    QCOMPARE(bench.view(0).camera()->pose().centre, pose.centre);
    // What the panels show is the object that was opened.
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      QVERIFY(bench.position(panel, 50) != bench.document().mesh()->rest_position(50));
    }
  }

  void whatWasDoneIsGoneBackInAndForth() {
    const QString path = folder_.filePath(QStringLiteral("moves.chainmail"));
    Workbench bench(cloth());
    work(bench);
    bench.document().undo();  // the last drag lies ahead
    bench.settle();
    bench.window.sessions().savePath(path);
    bench.settle();
    const Session saved = sessionOf(bench);
    QVERIFY(saved.moves_done < saved.moves.size());
    bench.document().redo();
    bench.settle();
    const Session ahead = sessionOf(bench);

    Workbench again;
    again.open(path);
    Document& document = again.document();
    QCOMPARE(document.tape().position(), saved.moves_done);
    document.goTo(0);
    again.settle();
    QVERIFY((again.position(0, 50) - document.mesh()->rest_position(50)).norm() < 1e-6);  // floats of some units
    QVERIFY(document.cuts().links().empty() && document.pins().empty());
    document.goTo(saved.moves_done);
    again.settle();
    compare(sessionOf(again), saved);
    document.goTo(saved.moves.size());
    again.settle();
    compare(sessionOf(again), ahead);
  }

  void openingIsOneStepOfUndo() {
    const QString path = folder_.filePath(QStringLiteral("b.chainmail"));
    Workbench bench(cloth());
    work(bench);
    bench.window.sessions().savePath(path);
    bench.settle();
    const Session saved = sessionOf(bench);
    bench.document().replaceMesh(generate({MeshKind::grid, {5, 4, 1}, 1, {}}), QStringLiteral("grid"),
                                 QStringLiteral("build"));
    bench.document().setAlgorithm(0, Algorithm::original);
    bench.document().setSessionFile({});
    drag(bench.document(), 7, {1, 1, 0});
    bench.settle();
    const Session other = sessionOf(bench);
    const int steps = bench.document().undoStack().count();
    bench.open(path);
    QCOMPARE(bench.document().undoStack().count(), steps + 1);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("open b.chainmail"));
    for (int i = 0; i < 2; ++i) {
      compare(sessionOf(bench), saved);
      QCOMPARE(bench.document().sessionFile(), path);
      bench.document().undo();
      bench.settle();
      compare(sessionOf(bench), other);
      QCOMPARE(bench.document().sessionFile(), QString());
      bench.document().redo();
      bench.settle();
    }
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
  }

  void theTitleNamesTheFileAndMarksChanges() {
    const QString path = folder_.filePath(QStringLiteral("c.chainmail"));
    Workbench bench;
    QVERIFY(!bench.window.isWindowModified());
    bench.document().setPinned({3}, true);
    QVERIFY(bench.window.isWindowModified());
    bench.window.sessions().savePath(path);
    bench.settle();
    QVERIFY(!bench.window.isWindowModified());
    QVERIFY(bench.window.windowTitle().startsWith(QStringLiteral("c.chainmail[*]")));
    drag(bench.document(), 31, {1, 0, 0});
    QVERIFY(bench.window.isWindowModified());
    QTest::keyClick(&bench.window, Qt::Key_S, Qt::ControlModifier);  // to the same file, unasked
    bench.settle();
    QVERIFY(!bench.window.isWindowModified());
    bench.document().undo();
    QVERIFY(bench.window.isWindowModified());
    bench.document().redo();
    QVERIFY(!bench.window.isWindowModified());
    const QStringList recent = QSettings().value(QStringLiteral("recentFiles")).toStringList();
    QCOMPARE(recent.value(0), path);
  }

  void aSessionIsDropped() {
    const QString path = folder_.filePath(QStringLiteral("d.CHAINMAIL"));
    Workbench bench(cloth());
    bench.window.sessions().savePath(path);
    bench.settle();
    bench.document().replaceMesh(generate({MeshKind::line, {5, 1, 1}, 1, {}}), QStringLiteral("line"),
                                 QStringLiteral("build"));
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &enter);
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &drop);
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), 108U);
  }

  void aBadSessionGetsASentenceAndChangesNothing() {
    const QString path = folder_.filePath(QStringLiteral("e.chainmail"));
    Workbench bench(cloth());
    work(bench);
    bench.window.sessions().savePath(path);
    bench.settle();
    QFile file(path);
    QVERIFY(file.resize(file.size() / 2));
    const Session before = sessionOf(bench);
    const int steps = bench.document().undoStack().count();
    bench.open(path);
    QVERIFY2(bench.window.messages().sentence().contains(QStringLiteral("it ends too early")),
             qPrintable(bench.window.messages().sentence()));
    compare(sessionOf(bench), before);
    QCOMPARE(bench.document().undoStack().count(), steps);
  }

  void whatACrashLeftIsOffered() {
    const QString expected = folder_.filePath(QStringLiteral("expected.chainmail"));
    QProcess program;
    program.start(QApplication::applicationFilePath(), {QStringLiteral("--crash"), expected});
    QByteArray said;
    QTRY_VERIFY_WITH_TIMEOUT((said += program.readAllStandardOutput()).contains("worked"), 30000);
    QTest::qWait(5000);  // what is promised: no more is lost
    QVERIFY(::kill(pid_t(program.processId()), SIGKILL) == 0);
    QVERIFY(program.waitForFinished());
    QCOMPARE(autosaved().size(), 1);

    Workbench bench;
    bench.window.sessions().protect();
    QVERIFY(bench.window.sessions().recoveryBar().isVisible());
    bench.find<QPushButton>("restoreWork")->click();
    bench.settle();
    compare(sessionOf(bench), read_session(expected.toStdString()));
    QCOMPARE(bench.document().sessionFile(), QStringLiteral("/somewhere/mine.chainmail"));
    QVERIFY(bench.window.isWindowModified());
    QVERIFY(!bench.window.sessions().recoveryBar().isVisible());
    QCOMPARE(autosaved().size(), 1);  // this window's own: safe from the first moment
    {
      Workbench second;  // what a running window holds is nobody else's
      second.window.sessions().protect();
      QVERIFY(!second.window.sessions().recoveryBar().isVisible());
    }
    QCOMPARE(autosaved().size(), 1);
    bench.window.close();  // and still unsaved
    QCOMPARE(autosaved(), QStringList{QStringLiteral("closed.chainmail")});
    QVERIFY(QFile::remove(Autosave::closedPath()));
  }

  void whatIsDiscardedIsGone() {
    for (const char* name : {"one.chainmail", "two.chainmail"}) {
      QFile file(QDir(Autosave::folder()).filePath(QLatin1String(name)));
      QVERIFY(file.open(QIODevice::WriteOnly) && file.write("{") > 0);
    }
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.window.sessions().protect();
    auto& bar = bench.window.sessions().recoveryBar();
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("restoreWork")->click();  // damaged: a sentence, and it may still be discarded
    bench.settle();
    QVERIFY(bench.window.messages().isVisible() && bar.isVisible());
    QCOMPARE(bench.document().mesh(), before);
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(!bar.isVisible());
    QCOMPARE(autosaved().size(), 0);
  }

  void workIsKeptSafeWhileThereIsSomeToLose() {
    const QString path = folder_.filePath(QStringLiteral("f.chainmail"));
    Workbench bench;
    bench.window.sessions().protect();
    auto* timer = bench.find<QTimer>("autosaveTimer");
    const auto passTime = [&] {
      timer->start(0);
      QTRY_VERIFY(!timer->isActive());
      bench.settle();
    };
    passTime();
    QCOMPARE(autosaved().size(), 0);  // nothing was done
    bench.document().setPinned({3}, true);
    QVERIFY(timer->isActive());
    passTime();
    QTRY_COMPARE(autosaved().size(), 1);
    QTRY_VERIFY(!timer->isActive());  // a still scene costs nothing
    const QString file = QDir(Autosave::folder()).filePath(autosaved().first());
    QCOMPARE(read_session(file.toStdString()).pins, std::vector<ElementId>{3});
    bench.window.sessions().savePath(path);
    bench.settle();
    passTime();
    QTRY_COMPARE(autosaved().size(), 0);
  }

 private:
  static void compare(const Session& again, const Session& before) {
    QCOMPARE(again.name, before.name);
    QVERIFY(again.mesh->rest == before.mesh->rest && again.mesh->links == before.mesh->links);
    QVERIFY(again.mesh->triangles == before.mesh->triangles && again.mesh->neighbours == before.mesh->neighbours);
    QCOMPARE(again.cuts, before.cuts);
    QCOMPARE(again.pins, before.pins);
    QVERIFY(*again.softness == *before.softness);
    QVERIFY(again.relaxation == before.relaxation);
    QCOMPARE(again.panels.size(), before.panels.size());
    for (std::size_t panel = 0; panel < again.panels.size(); ++panel) {
      QVERIFY(again.panels[panel].algorithm == before.panels[panel].algorithm);
      QVERIFY(!again.panels[panel].placement.runs.empty());
      QVERIFY(again.panels[panel].placement == before.panels[panel].placement);
    }
  }

  QTemporaryDir folder_;
};

int main(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == "--crash") {
    return crashingProgram(argc, argv);
  }
  return runWindowTest<WindowSession>(argc, argv);
}
#include "window_session.moc"
