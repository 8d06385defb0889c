#include <QtTest>
#include <cstring>
#include <sstream>

#include "core/threads.h"
#include "files/session/moves.h"
#include "files/support.h"
#include "program.h"
#include "simulate/command_log.h"

namespace chainmail::test_relaxed_moves {

using namespace chainmail::test;

/// Two panels that relax in idle time, and the recorded moves: what another simulation makes of them is what the panel
/// showed, bit for bit.
class RelaxedMovesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_replay_ends_where_the_panel_was_data();
  void a_replay_ends_where_the_panel_was();
  void a_session_goes_on_where_it_was_saved();
  void files_that_are_wrong_are_refused_data();
  void files_that_are_wrong_are_refused();
};

namespace {

constexpr std::array panel_algorithms{Algorithm::natural_queue, Algorithm::exact};

class Panels {
 public:
  explicit Panels(const MeshPointer& mesh)
      : a_(mesh, panel_algorithms[0], [] {}), b_(mesh, panel_algorithms[1], [] {}), log_({&a_, &b_}) {}

  void act(const Command& command) {
    seen_ = {a_.newest_frame(), b_.newest_frame()};
    log_.post(command);
    log_.flush();
  }
  /// Waits until every panel has relaxed a little after a command that frames show, each as long as it takes.
  bool relax(std::uint64_t sweeps = 3) {
    const auto has_relaxed = [&](SolverThread& one, std::uint64_t seen) {
      return wait_until([&] {
        const Frame& frame = one.latest_frame();
        return one.idle() && frame.number > seen && (frame.statistics.sweeps >= sweeps || !frame.statistics.relaxing);
      });
    };
    return has_relaxed(a_, seen_[0]) && has_relaxed(b_, seen_[1]);
  }
  /// Returns the positions of both panels at one moment, which the recorded commands end with.
  std::array<std::vector<double>, 2> positions() {
    std::array<std::promise<std::vector<double>>, 2> promises;
    std::vector<SolverThread::Question> questions;
    for (auto& promise : promises) {
      questions.emplace_back([&](const Simulation& simulation) { promise.set_value(positions_of(simulation)); });
    }
    log_.ask_all(questions);
    return {promises[0].get_future().get(), promises[1].get_future().get()};
  }
  std::vector<Command> moves() { return log_.history().commands(); }
  void replay(const Command& command) { log_.replay(command); }

 private:
  SolverThread a_, b_;
  std::array<std::uint64_t, 2> seen_{};  // frames before the last command
  CommandLog log_;
};

std::vector<Command> written_and_read(const std::vector<Command>& moves, const MeshPointer& mesh) {
  std::ostringstream out;
  write_moves(out, moves, *mesh);
  return read_moves(out.str(), std::filesystem::path("m.json"), mesh);
}

/// Returns the positions after the moves with an algorithm.
std::vector<double> replayed(const std::vector<Command>& moves, const MeshPointer& mesh, Algorithm algorithm,
                             int threads) {
  Simulation simulation(mesh, algorithm, Precision::single_precision);
  simulation.set_threads(threads);
  for (const Command& command : moves) {
    simulation.apply(command);
  }
  return positions_of(simulation);
}

std::size_t relaxed_slices(const std::vector<Command>& moves) {
  std::size_t slices = 0;
  for (const Command& command : moves) {
    if (const auto* relaxed = std::get_if<commands::Relaxed>(&command)) {
      slices += relaxed->counts->slices(0);
    }
  }
  return slices;
}

}  // namespace

void RelaxedMovesTest::a_replay_ends_where_the_panel_was_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::addColumn<RelaxationScheme>("scheme");
  QTest::addColumn<EnergyKind>("energy");
  const auto triangles = jittered_triangles(12, 12, 7);
  const auto row = [](const char* name, const MeshPointer& mesh, RelaxationScheme scheme, EnergyKind energy) {
    QTest::addRow("%s, %s, %s", name, std::string(info(scheme).name).c_str(), std::string(info(energy).name).c_str())
        << mesh << scheme << energy;
  };
  for (const RelaxationSchemeInfo& scheme : relaxation_schemes) {
    for (const EnergyKind energy :
         {EnergyKind::isotropic, EnergyKind::axial, EnergyKind::corotated, EnergyKind::material}) {
      row("triangles", triangles, scheme.scheme, energy);
    }
  }
  row("cloth", make_mesh(MeshKind::cloth, {9, 9, 1}, 3), RelaxationScheme::equilibrium, EnergyKind::material);
  row("solid", make_mesh(MeshKind::tetra, {11, 11, 11}), RelaxationScheme::equilibrium, EnergyKind::material);
  // More elements than one slice visits.
  row("large grid", make_mesh(MeshKind::grid, {180, 180, 1}), RelaxationScheme::mean, EnergyKind::isotropic);
}

void RelaxedMovesTest::a_replay_ends_where_the_panel_was() {
  QFETCH(MeshPointer, mesh);
  QFETCH(RelaxationScheme, scheme);
  QFETCH(EnergyKind, energy);
  Panels panels(mesh);
  const ElementId last = mesh->element_count() - 1, middle = last / 2;
  const auto drag = [&](ElementId element, const Point& by, int passes) {
    panels.act(commands::Grab{element});
    for (int i = 1; i <= passes; ++i) {
      commands::Drag drag{Point(by * i / passes)};
      drag.relative = true;
      panels.act(drag);
      if (!panels.relax(std::uint64_t(i))) {
        return false;
      }
    }
    panels.act(commands::Release{});
    return panels.relax();
  };
  panels.act(commands::SetSoftness{Softness{{0.7, 1.5, 0.4}, {}, energy}});
  panels.act(commands::Pin{{0}});
  panels.act(commands::SetRelaxation{true, 1, scheme});
  QVERIFY(drag(last, Point(1.5, 1, 0), 4));
  panels.act(commands::KeepState{1});
  QVERIFY(drag(middle, Point(-1, 2, 0), 2));
  panels.act(commands::RestoreState{1});  // undo: another branch begins, in which relaxation sleeps
  QVERIFY(drag(middle, Point(2, -1, 0), 2));
  panels.act(commands::Cut{{0, 5}});
  QVERIFY(panels.relax());
  panels.act(commands::SetRelaxation{true, 0.5, scheme});
  QVERIFY(panels.relax(10));
  panels.act(commands::SetRelaxation{true, 0.5, scheme, true});
  QVERIFY(panels.relax(5));
  panels.act(commands::SetRelaxation{false, 0.5, scheme});
  panels.act(commands::SetRelaxation{true, 1, scheme});
  QVERIFY(drag(last, Point(-0.4, -0.3, 0), 3));
  const auto shown = panels.positions();
  const auto moves = written_and_read(panels.moves(), mesh);
  QVERIFY(relaxed_slices(moves) > 0);
  for (const int threads : {1, 2}) {
    for (std::size_t i = 0; i < shown.size(); ++i) {
      QVERIFY2(same_bits(replayed(moves, mesh, panel_algorithms[i], threads), shown[i]),
               qPrintable(QString("panel %1, threads %2").arg(i).arg(threads)));
    }
  }
  // As the window does it, which may wait between two commands, and keep states.
  Panels again(mesh);
  for (const Command& command : moves) {
    again.replay(command);
    if (std::holds_alternative<commands::Drag>(command)) {
      again.act(commands::KeepState{2});
      QVERIFY(again.relax());
    }
  }
  QVERIFY(again.positions() == shown);
}

/// A session has positions, not what relaxation keeps. So relaxation begins anew there, in the panels and in a replay.
void RelaxedMovesTest::a_session_goes_on_where_it_was_saved() {
  const auto mesh = jittered_triangles(12, 12, 7);
  const commands::SetRelaxation on{true, 1, RelaxationScheme::equilibrium};
  Panels panels(mesh);
  panels.act(commands::SetSoftness{Softness{{0.7, 1.5, 0.4}, {}, EnergyKind::corotated}});
  panels.act(on);
  panels.act(commands::Grab{0});
  panels.act(commands::Drag{Point(-3, -2, 0)});
  QVERIFY(panels.relax(2));
  panels.act(commands::SetRelaxation{true, 1, RelaxationScheme::equilibrium, true});  // as a session does
  QVERIFY(panels.relax(5));
  const auto shown = panels.positions();
  const auto moves = panels.moves();
  QVERIFY(same_bits(replayed(moves, mesh, panel_algorithms[0], 1), shown[0]));
  // A simulation that runs neither algorithm repeats what the first panel did.
  QVERIFY(!replayed(moves, mesh, Algorithm::generalized, 1).empty());
}

void RelaxedMovesTest::files_that_are_wrong_are_refused_data() {
  QTest::addColumn<QString>("command");
  QTest::addColumn<QString>("said");
  const auto row = [](const char* command, const char* said) {
    QTest::addRow("%s", command) << QString(command) << QString(said);
  };
  row(R"("scheme": "mean", "step": 1, "start": "now", "panels": ["exact"], "slices": [1])", "'start' is not known");
  row(R"("scheme": "mean", "step": 1, "start": "awake", "panels": ["exact"], "slices": [])", "one item for each panel");
  row(R"("scheme": "mean", "step": 1, "start": "awake", "panels": ["none"], "slices": [1])", "is not known");
  row(R"("scheme": "mean", "step": 1, "start": "awake", "panels": ["exact"], "slices": [-1])", "of 'slices' is not");
  row(R"("scheme": "mean", "step": 9, "start": "awake", "panels": ["exact"], "slices": [1])", "step");
  row(R"("scheme": "mean", "step": 1, "start": "awake", "panels": 3, "slices": [1])", "panels");
}

void RelaxedMovesTest::files_that_are_wrong_are_refused() {
  QFETCH(QString, command);
  QFETCH(QString, said);
  const std::string text = R"({"version": 3, "commands": [{"do": "relaxed", )" + command.toStdString() + "}]}";
  try {
    read_moves(text, std::filesystem::path("m.json"), made(MeshKind::grid, {3, 2, 1}));
    QFAIL("it was read");
  } catch (const Error& error) {
    const QString sentence = QString::fromStdString(error.what());
    QVERIFY2(sentence.contains("command 0") && sentence.contains(said), qPrintable(sentence));
  }
}

CHAINMAIL_TEST(RelaxedMovesTest)

}  // namespace chainmail::test_relaxed_moves

#include "test_relaxed_moves.moc"
