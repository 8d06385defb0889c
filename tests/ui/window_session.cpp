// Tests sessions in a real window: saving, opening, and dropping files.

#include <QDropEvent>
#include <QFile>
#include <QMimeData>

#include "document/edits.h"
#include "io/file_actions.h"
#include "io/sessions.h"
#include "session_bench.h"
#include "window/message_bar.h"
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

  /// The docks show the settings of the session. The solvers must use the same settings in the next drag.
  void theSolversTakeTheSettingsOfASession() {
    const QString path = folder_.filePath(QStringLiteral("settings.chainmail"));
    const SolverSettings saved{{true, 0.5, RelaxationScheme::link}, {{2, 0.4}, {3, 4, 5}}};
    const SolverSettings other{{false, 0.75, RelaxationScheme::equilibrium}, {{3, 0.2}, {2, 2, 2}}};
    const auto set = [](Workbench& bench, const SolverSettings& settings) {
      edits::setRelaxation(bench.document(), settings.relaxation);
      edits::setElastic(bench.document(), settings.elastic, QStringLiteral("material"));
    };
    {
      Workbench bench(cloth());
      set(bench, saved);
      bench.window.sessions().savePath(path);
      bench.settle();
    }
    Workbench bench;
    set(bench, other);
    bench.open(path);
    for (int i = 0; i < 2; ++i) {
      for (int panel = 0; panel < bench.document().panels(); ++panel) {
        QVERIFY(bench.settings(panel) == saved);
      }
      bench.document().undo();
      for (int panel = 0; panel < bench.document().panels(); ++panel) {
        QVERIFY(bench.settings(panel) == other);
      }
      bench.document().redo();
    }
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

  /// A camera that was turned but not moved shows the whole object, from the chosen side, in a window of any size.
  void aCameraThatWasOnlyTurnedFitsTheNextWindow() {
    const QString path = folder_.filePath(QStringLiteral("turned.chainmail"));
    {
      Workbench bench(generate({MeshKind::tetra, {5, 4, 3}, 1, {}}));
      bench.trigger("viewTop");
      bench.window.sessions().savePath(path);
      bench.settle();
    }
    Workbench bench;
    bench.window.resize(1000, 640);
    bench.settle();
    bench.open(path);
    QCOMPARE(bench.view(0).camera()->pose().yaw, 0.0);
    QCOMPARE(bench.view(0).camera()->pose().pitch, 90.0);
    const QRect all = bench.view(0).rect();
    QVERIFY(all.contains(bench.place(0, 0)) && all.contains(bench.place(0, 59)));
  }

  void whatWasDoneIsGoneBackInAndForth() {
    const QString path = folder_.filePath(QStringLiteral("moves.chainmail"));
    Workbench bench(cloth());
    changeEverything(bench);
    bench.document().undo();  // the last drag is then undone and can be redone
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
    QCOMPARE(document.moves().history().position(), saved.moves_done);
    document.moves().goTo(0);
    again.settle();
    // The positions are floats of a few units.
    QVERIFY((again.position(0, 50) - document.mesh()->rest_position(50)).norm() < 1e-6);
    QVERIFY(document.cuts().links().empty() && document.pins().empty());
    document.moves().goTo(saved.moves_done);
    again.settle();
    compare(sessionOf(again), saved);
    document.moves().goTo(saved.moves.size());
    again.settle();
    compare(sessionOf(again), ahead);
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

  void aSessionIsDropped() {
    const QString path = folder_.filePath(QStringLiteral("d.CHAINMAIL"));
    Workbench bench(cloth());
    bench.window.sessions().savePath(path);
    bench.settle();
    edits::replaceMesh(bench.document(), generate({MeshKind::line, {5, 1, 1}, 1, {}}), QStringLiteral("line"),
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
    changeEverything(bench);
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

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowSession)

}  // namespace chainmail::window_session

#include "window_session.moc"
