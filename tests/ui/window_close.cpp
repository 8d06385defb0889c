// Tests that a window closes within two seconds, whatever it does at that time, and that unsaved work is stored.

#include <QDir>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <functional>

#include "docks/replay_dock.h"
#include "docks/report/report_thread.h"
#include "document/edits.h"
#include "fair_timer.h"
#include "files/mesh/mesh_file.h"
#include "folders.h"
#include "io/file_actions.h"
#include "io/film.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "mesh/layers.h"
#include "panels/legend.h"
#include "session_bench.h"

namespace chainmail::window_close {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr qint64 promised = 20'000;
#else
constexpr qint64 promised = 2'000;  // milliseconds
#endif

using Begin = std::function<void(Workbench&)>;

MeshPointer grid(std::uint32_t width) { return generate({MeshKind::grid, {width, width, 1}, 1, {}}); }
MeshPointer solid(std::uint32_t width, std::uint32_t height) {
  return generate({MeshKind::tetra, {width, height, height}, 1, {}});
}

/// Drags a corner. The solvers have not finished the move when this returns.
void pull(Document& document) {
  const ElementId corner = document.mesh()->element_count() - 1;
  document.handle().grab(corner);
  document.handle().drag(document.mesh()->rest_position(corner) + Point(3, 2, 0));
}

/// Starts sweeps that would run for hours; a file of recorded moves may contain such a command.
void relaxForHours(Workbench& bench) {
  const std::vector<Command> moves{commands::Grab{0}, commands::Drag{Point(-900, -700, 0)}, commands::Release{},
                                   commands::Relax{1'000'000, 1, RelaxationScheme::mean}};
  bench.document().moves().load(std::make_shared<const std::vector<Command>>(moves), QStringLiteral("open moves"));
  bench.settle();
  bench.trigger("replayLast");
  QTRY_COMPARE(bench.document().moves().history().position(), moves.size());
  QVERIFY(!bench.document().solvers().idle());
}

/// Returns a function that starts the preparation of an elastic method in the first panel.
Begin prepares(Algorithm algorithm) {
  return [algorithm](Workbench& bench) {
    edits::setPinned(bench.document(), layer(*bench.document().mesh(), *find_side("left")), true);
    edits::setAlgorithm(bench.document(), 0, algorithm);
    bench.settle();
    pull(bench.document());
    QVERIFY(!bench.document().solvers().idle());
  };
}

void computesTheReference(Workbench& bench) {
  edits::setPinned(bench.document(), layer(*bench.document().mesh(), *find_side("left")), true);
  pull(bench.document());
  bench.document().handle().release();
  bench.settle();
  bench.window.colouring().setMode(ColourMode::physicsError);
  QTRY_VERIFY_WITH_TIMEOUT(bench.window.panel(0).legend().title().contains(QStringLiteral("computing")), 20'000);
}

void reports(Workbench& bench) {
  bench.trigger("showReport");
  bench.find<QPushButton>("reportRun")->click();
  QVERIFY(bench.window.findChild<ReportThread*>()->atWork());
}

void builds(Workbench& bench) {
  bench.find<QSpinBox>("sizeW")->setValue(1024);
  bench.find<QSpinBox>("sizeH")->setValue(1024);
  bench.find<QPushButton>("buildMesh")->click();
  QVERIFY(bench.window.jobs().running());
}

void fills(Workbench& bench) {
  bench.open(sourceFile("meshes/sphere.obj"));
  bench.trigger("fillSurface");
  auto* size = bench.find<QDoubleSpinBox>("fillSize");
  size->setValue(size->minimum());
  bench.find<QPushButton>("fillAgree")->click();
  QTRY_VERIFY(bench.window.jobs().running());
}

/// Starts thousands of moves of a large object.
void goesToTheEnd(Workbench& bench) {
  std::vector<Command> moves{commands::Grab{0}};
  for (int i = 0; i < 5000; ++i) {
    moves.emplace_back(commands::Drag{Point(i % 2 == 0 ? -900 : 900, -300, 0)});
  }
  bench.document().moves().load(std::make_shared<const std::vector<Command>>(std::move(moves)), QStringLiteral("open"));
  bench.settle();
  bench.trigger("replayLast");
  QTRY_VERIFY(bench.document().moves().history().position() > 0);
  QVERIFY(!bench.document().solvers().idle());
}

void plays(Workbench& bench) {
  drag(bench.document(), 5, {30, 20, 0});
  bench.settle();
  bench.trigger("replayPlay");
  QTRY_VERIFY(bench.document().moves().history().position() < bench.document().moves().history().length());
}

/// Starts Exact ChainMail, which has to search for the regions of all elements for each new handle.
void takesALongPass(Workbench& bench) {
  edits::setPinned(bench.document(), {0, 5, 777}, true);
  edits::setAlgorithm(bench.document(), 0, Algorithm::exact);
  edits::setAlgorithm(bench.document(), 1, Algorithm::enhanced);
  bench.settle();
  for (const ElementId element : {100'000U, 30'000U, 60'000U}) {
    drag(bench.document(), element, {100, 200, 0});
  }
  QVERIFY(!bench.document().solvers().idle());
}

}  // namespace

class WindowClose : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void atAnyWork_data() {
    QTest::addColumn<MeshPointer>("mesh");
    QTest::addColumn<Begin>("begin");
    const MeshPointer small = grid(20), large = grid(400);
    const MeshPointer finite = solid(20, 17);  // nearly the largest object for neo-Hookean FEM
    const auto row = [](const char* name, const MeshPointer& mesh, Begin begin) {
      QTest::newRow(name) << mesh << std::move(begin);
    };
    row("nothing", small, [](Workbench&) {});
    row("opening a large mesh", small, [this](Workbench& bench) {
      save_mesh(path("large.obj").toStdString(), {*grid(600), {}, rest_positions(*grid(600)), {}});
      bench.window.openFile(path("large.obj"));
      QTRY_VERIFY(bench.window.jobs().running());
    });
    row("building", small, builds);
    row("filling", small, fills);
    row("the report", grid(120), reports);
    row("the reference solution", finite, computesTheReference);
    row("sweeps of relaxation", large, relaxForHours);
    row("going to the end of many moves", large, goesToTheEnd);
    row("playing moves", large, plays);
    row("preparing linear FEM", solid(32, 30), prepares(Algorithm::linear_fem));
    row("neo-Hookean FEM", finite, prepares(Algorithm::neo_hookean));
    row("preparing BEM", solid(18, 15), prepares(Algorithm::boundary_elements));
    row("long passes", large, takesALongPass);
    if (Film::canMakeVideos()) {
      row("a video of moves", large, [this](Workbench& bench) { films(bench, path("film.mp4")); });
    }
  }

  void atAnyWork() {
    QFETCH(MeshPointer, mesh);
    QFETCH(Begin, begin);
    auto bench = std::make_unique<Workbench>(mesh);
    begin(*bench);
    if (QTest::currentTestFailed()) {
      return;
    }
    const test::FairTimer timer;
    QVERIFY(bench->window.close());
    bench.reset();
    QVERIFY2(timer.within(promised), qPrintable(timer.inWords()));
    QVERIFY(!QFile::exists(path("film.mp4")));
  }

  /// The window closes at once. The file that it was saving is complete after the window is deleted.
  void saving() {
    auto bench = std::make_unique<Workbench>(grid(500));
    bench->window.findChild<FileActions*>()->savePath(path("saved.obj"));
    const test::FairTimer timer;
    QVERIFY(bench->window.close());
    QVERIFY2(timer.within(promised), qPrintable(timer.inWords()));
    bench.reset();
    QCOMPARE(read_mesh(path("saved.obj").toStdString())->element_count(), 250'000U);
  }

  /// The work is offered at the next start, with the positions that the solvers had reached.
  void whatIsUnsavedIsKeptThoughASolverWouldGoOnForHours() {
    auto bench = std::make_unique<Workbench>(grid(150));
    bench->window.sessions().protect();
    edits::setPinned(bench->document(), {7}, true);
    relaxForHours(*bench);
    const test::FairTimer timer;
    QVERIFY(bench->window.close());
    bench.reset();
    QVERIFY2(timer.within(promised), qPrintable(timer.inWords()));
    const QDir kept(unsaved_work::folder());
    const QStringList files = kept.entryList({QStringLiteral("*.chainmail")}, QDir::Files);
    QCOMPARE(files.size(), 1);
    QVERIFY(unsaved_work::isClosed(files.first()));
    const Session session = unsaved_work::read(kept.filePath(files.first()));
    QCOMPARE(session.mesh->element_count(), 22'500U);
    QVERIFY(!session.panels.front().positions.is_at_rest());  // the drag is stored
    QVERIFY(QFile::remove(kept.filePath(files.first())));
  }

  /// A pass that cannot be stopped continues after the window is closed. Then the work is written.
  void whatIsUnsavedIsKeptThoughAPassCannotBeGivenUp() {
    auto bench = std::make_unique<Workbench>(grid(400));
    bench->window.sessions().protect();
    takesALongPass(*bench);
    for (int i = 0; i < 8; ++i) {  // each handle needs its own regions
      bench->document().handle().release();
      pull(bench->document());
    }
    QVERIFY(bench->window.close());
    bench.reset();
    const QDir kept(unsaved_work::folder());
    const QStringList files = kept.entryList({QStringLiteral("*.chainmail")}, QDir::Files);
    QCOMPARE(files.size(), 1);
    const Session session = unsaved_work::read(kept.filePath(files.first()));
    QCOMPARE(session.panels.size(), std::size_t{2});
    QCOMPARE(session.pins, (std::vector<ElementId>{0, 5, 777}));
    QVERIFY(QFile::remove(kept.filePath(files.first())));
  }

  /// Undo stops and reverts a long relaxation at once.
  void sweepsAreTakenBackAtOnce() {
    Workbench bench(grid(150));
    relaxForHours(bench);
    bench.document().undo();
    QTRY_VERIFY_WITH_TIMEOUT(bench.document().solvers().settled(), int(promised));
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      const auto& positions = bench.document().solvers().frame(panel)->positions;
      QVERIFY(std::equal(positions.begin(), positions.end(), bench.document().mesh()->rest.begin()));
    }
  }

 private:
  QString path(const char* name) const { return folder_.filePath(QLatin1String(name)); }

  void films(Workbench& bench, const QString& to) {
    for (int i = 0; i < 20; ++i) {
      drag(bench.document(), 5, {30.0 + i, 20, 0});
      bench.settle();
    }
    auto* dock = bench.find<ReplayDock>("replayDock");
    dock->saveFilm(to);
    QTRY_VERIFY(bench.window.jobs().running() && bench.window.jobs().share() > 0);
  }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowClose)

}  // namespace chainmail::window_close

#include "window_close.moc"
