// Tests opening and saving in a real window.

#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>

#include "document/edits.h"
#include "document/element_facts.h"
#include "io/file_actions.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_files {

class WindowFiles : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aBadFileGetsASentenceAndChangesNothing() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.open(write("bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"));
    QVERIFY(bench.window.messages().isVisible());
    QVERIFY2(bench.window.messages().sentence().contains(QStringLiteral("bad.obj:3: ")),
             qPrintable(bench.window.messages().sentence()));
    QCOMPARE(bench.document().mesh(), before);
    QVERIFY(!bench.document().undoStack().canUndo());

    bench.open(folder_.filePath(QStringLiteral("not there.obj")));
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("not there.obj")));
    bench.open(write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    QCOMPARE(bench.window.messages().count(), 1);  // the messages about the earlier files are gone
    QCOMPARE(bench.window.messages().sentence(),
             QStringLiteral("good.obj: 3 elements, 3 links, 1 triangle, 1 part, 1 × 1 units"));
    QCOMPARE(bench.document().mesh()->element_count(), 3U);
  }

  void aFileIsDropped() {
    Workbench bench;
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(write("dropped.obj", "v 0 0 0\nv 2 0 0\nl 1 2\n"))});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench.window, &drop);
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), 2U);
  }

  void whatIsSavedOpensAgain_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("dat") << QStringLiteral("saved.dat");
    QTest::newRow("obj") << QStringLiteral("saved.obj");
  }
  void whatIsSavedOpensAgain() {
    QFETCH(QString, name);
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    edits::cut(bench.document(), {0, 5});
    const QString path = folder_.filePath(name);
    files(bench).savePath(path);
    bench.settle();
    bench.open(path);
    QVERIFY2(bench.window.messages().severity() == Severity::info, qPrintable(bench.window.messages().sentence()));
    const Mesh& again = *bench.document().mesh();
    QCOMPARE(again.element_count(), before->element_count());
    QCOMPARE(again.link_count(), before->link_count() - 2);
    for (ElementId e = 0; e < again.element_count(); ++e) {
      QCOMPARE(again.rest_position(e), before->rest_position(e));
    }
  }

  void theDeformedShapeIsSaved() {
    Workbench bench;
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(140, -90)});
    const Point shown = bench.position(1, 31);
    files(bench).saveShapePath(1, folder_.filePath(QStringLiteral("shape.vtu")));
    bench.settle();
    QVERIFY(!bench.window.messages().isVisible());
    QVERIFY(QFile(folder_.filePath(QStringLiteral("shape.vtu"))).size() > 0);
    const QString path = folder_.filePath(QStringLiteral("shape.obj"));
    files(bench).saveShapePath(1, path);
    bench.settle();
    bench.open(path);
    QCOMPARE(bench.document().mesh()->rest_position(31), shown);
  }

  void closingAsksNothingAndLosesNothing() {
    Point moved;
    {
      Workbench bench;
      bench.window.sessions().protect();
      edits::setPinned(bench.document(), {3}, true);
      const QPoint from = bench.place(0, 31);
      bench.stroke(0, {from, from + QPoint(60, 30)});
      moved = bench.position(0, 31);
      QVERIFY(bench.window.close());
    }
    for (const char* button : {"restoreWork", "discardWork"}) {
      Workbench again;
      again.window.sessions().protect();
      QVERIFY(again.window.sessions().recoveryBar().isVisible());
      QVERIFY(again.find<QLabel>("recovery")->text().contains(QStringLiteral("closed")));
      again.find<QPushButton>(button)->click();
      again.settle();
      QVERIFY(!again.window.sessions().recoveryBar().isVisible());
      const bool restored = QLatin1String(button) == QLatin1String("restoreWork");
      QCOMPARE(isPinned(again.document(), 3), restored);
      QCOMPARE(again.position(0, 31) == moved, restored);
      QVERIFY(again.window.close());  // restored work is still unsaved; discarded work is deleted
    }
    Workbench last;
    last.window.sessions().protect();
    QVERIFY(!last.window.sessions().recoveryBar().isVisible());
  }

 private:
  QString write(const char* name, const char* text) {
    const QString path = folder_.filePath(QLatin1String(name));
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(text) < 0) {
      qFatal("cannot write %s", name);
    }
    return path;
  }
  static FileActions& files(Workbench& bench) { return *bench.window.findChild<FileActions*>(); }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowFiles)

}  // namespace chainmail::window_files

#include "window_files.moc"
