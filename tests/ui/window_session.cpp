// Tests sessions in a real window: saving and opening.

#include <QFile>

#include "document/edits.h"
#include "io/sessions.h"
#include "session_bench.h"
#include "window/bars.h"
#include "window/window_layout.h"

namespace chainmail::window_session {

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
      changeEverything(bench);
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
    QCOMPARE(bench.document().files().session(), path);
    QCOMPARE(bench.window.colouring().mode(), ColourMode::violation);
    QCOMPARE(bench.view(0).camera()->pose().height, pose.height);
    QCOMPARE(bench.view(0).camera()->pose().centre, pose.centre);
    // The panels show the opened object.
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      QVERIFY(bench.position(panel, 50) != bench.document().mesh()->rest_position(50));
    }
  }

  void aSessionSaysOnceWhatHasLeftTheWindow() {
    Workbench bench;
    applyLayout(bench.window,
                R"({"docks": [{"id": "sizeTestDock", "visible": false}, {"id": "other", "visible": true}]})");
    QCOMPARE(bench.window.messages().count(), 0);
    applyLayout(bench.window, R"({"docks": [{"id": "sizeTestDock", "visible": true}]})");
    QCOMPARE(bench.window.messages().count(), 1);
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("Size test")));
  }

  /// The cameras are restored in direction, position and distance, whatever the cameras of the next window are.
  void everyPanelIsLookedAtAsBefore() {
    const QString path = folder_.filePath(QStringLiteral("cameras.chainmail"));
    const auto block = generate({MeshKind::tetra, {5, 4, 3}, 1, {}});
    std::vector<Camera::Pose> poses;
    {
      Workbench bench(block);
      bench.trigger("addPanel");
      bench.trigger("linkCameras");
      bench.settle();
      bench.view(0).setParallel(true);
      bench.view(0).orbit({70, 35});
      bench.view(0).pan({40, -25});
      bench.view(1).orbit({-55, 20});
      bench.view(1).zoom(1.7, {20, 30});
      bench.view(1).setParallel(true);
      bench.view(2).lookFrom(-90, 30);
      bench.view(2).zoom(0.6);
      for (int panel = 0; panel < 3; ++panel) {
        poses.push_back(bench.view(panel).camera()->pose());
      }
      bench.window.sessions().savePath(path);
      bench.settle();
    }
    Workbench bench;
    bench.open(path);
    QCOMPARE(bench.document().panels(), 3);
    QVERIFY(!bench.find<QAction>("linkCameras")->isChecked());
    QVERIFY(bench.find<QAction>("parallelRays")->isChecked());
    for (int panel = 0; panel < 3; ++panel) {
      const Camera::Pose now = bench.view(panel).camera()->pose(), before = poses[std::size_t(panel)];
      QVERIFY2(now.centre == before.centre, qPrintable(QString::number(panel)));
      QCOMPARE(now.height, before.height);
      QCOMPARE(now.yaw, before.yaw);
      QCOMPARE(now.pitch, before.pitch);
      QCOMPARE(now.parallel, before.parallel);
      QCOMPARE(now.framed, before.framed);
    }
    QVERIFY(poses[0].yaw != poses[1].yaw && poses[1].yaw != poses[2].yaw);
  }

  void openingIsOneStepOfUndo() {
    const QString path = folder_.filePath(QStringLiteral("b.chainmail"));
    Workbench bench(cloth());
    changeEverything(bench);
    bench.window.sessions().savePath(path);
    bench.settle();
    const Session saved = sessionOf(bench);
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {5, 4, 1}, 1, {}}), QStringLiteral("grid"),
                       QStringLiteral("build"));
    edits::setAlgorithm(bench.document(), 0, Algorithm::chainmail_3d);
    bench.document().files().setSession({});
    drag(bench.document(), 7, {1, 1, 0});
    bench.settle();
    const Session other = sessionOf(bench);
    const int steps = bench.document().undoStack().count();
    bench.open(path);
    QCOMPARE(bench.document().undoStack().count(), steps + 1);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("open b.chainmail"));
    for (int i = 0; i < 2; ++i) {
      compare(sessionOf(bench), saved);
      QCOMPARE(bench.document().files().session(), path);
      bench.document().undo();
      bench.settle();
      compare(sessionOf(bench), other);
      QCOMPARE(bench.document().files().session(), QString());
      bench.document().redo();
      bench.settle();
    }
    QVERIFY2(!bench.window.messages().isVisible(), qPrintable(bench.window.messages().sentence()));
  }

  void theTitleNamesTheFileAndMarksChanges() {
    const QString path = folder_.filePath(QStringLiteral("c.chainmail"));
    Workbench bench;
    QVERIFY(!bench.window.isWindowModified());
    edits::setPinned(bench.document(), {3}, true);
    QVERIFY(bench.window.isWindowModified());
    bench.window.sessions().savePath(path);
    bench.settle();
    QVERIFY(!bench.window.isWindowModified());
    QVERIFY(bench.window.windowTitle().startsWith(QStringLiteral("c.chainmail[*]")));
    drag(bench.document(), 31, {1, 0, 0});
    QVERIFY(bench.window.isWindowModified());
    QTest::keyClick(&bench.window, Qt::Key_S, Qt::ControlModifier);  // saves to the same file, without asking
    bench.settle();
    QVERIFY(!bench.window.isWindowModified());
    bench.document().undo();
    QVERIFY(bench.window.isWindowModified());
    bench.document().redo();
    QVERIFY(!bench.window.isWindowModified());
    const QStringList recent = QSettings().value(QStringLiteral("recentFiles")).toStringList();
    QCOMPARE(recent.value(0), path);
  }

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowSession)

}  // namespace chainmail::window_session

#include "window_session.moc"
