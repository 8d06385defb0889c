#include <QtTest>

#include "core/threads.h"
#include "program.h"
#include "simulate/command_log.h"

namespace chainmail::test_command_log {

using namespace chainmail::test;

/// One log sends the same commands in the same order to both panels, and no solver falls behind the handle.
class CommandLogTest : public QObject {
  Q_OBJECT

 private slots:
  void both_solvers_end_where_a_simulation_ends();
  void a_move_waits_for_the_next_sample();
  void idle_solvers_get_a_move_at_once();
  void of_several_moves_the_last_is_sent();
  void other_commands_follow_the_move_before_them();
  void a_slider_is_sampled_like_a_move();
  void kinds_keep_their_order();
  void while_one_solver_is_busy_neither_gets_a_move();
};

namespace {

/// Two solvers of the same algorithm on the same mesh, fed by one log.
struct TwoPanels {
  explicit TwoPanels(const MeshPointer& mesh = make_mesh(MeshKind::grid, {8, 8, 1}),
                     Algorithm algorithm = Algorithm::natural_queue)
      : left(mesh, algorithm, [this] { gate.pass(); }),
        right(mesh, algorithm, [] {}),
        log({&left, &right}, [this](const Command&) { ++posted; }) {}
  ~TwoPanels() { gate.open(); }  // otherwise the left solver would wait for ever

  bool wait_for_passes(std::uint64_t passes) {
    return test::wait_for_passes(left, passes) && test::wait_for_passes(right, passes);
  }
  /// Keeps the left solver busy until the gate opens.
  void keep_busy() {
    gate.close();
    left.ask([this](const Simulation&) { gate.pass(); });
  }
  bool sample_until_sent() {
    return wait_until([this] {
      log.sample();
      return !log.waits();
    });
  }

  Gate gate;  // the left solver's frames go through it
  SolverThread left, right;
  int posted = 0;  // number of commands
  CommandLog log;
};

std::array<float, 2> position_in(const Frame& frame, ElementId element) {
  return {frame.positions[2 * element], frame.positions[2 * element + 1]};
}

}  // namespace

void CommandLogTest::both_solvers_end_where_a_simulation_ends() {
  std::mt19937_64 random(21);
  const auto mesh = jittered_triangles(10, 10, 9);
  TwoPanels panels(mesh, Algorithm::generalized);
  Simulation simulation(mesh, Algorithm::generalized, Precision::single_precision);
  const auto all = [&](const Command& command) {
    simulation.apply(command);
    panels.log.post(command);
    QVERIFY(panels.sample_until_sent());  // otherwise a later move might replace this one
  };
  for (int i = 0; i < 60 && !QTest::currentTestFailed(); ++i) {
    all(commands::Grab{static_cast<ElementId>(random() % mesh->element_count())});
    all(commands::Drag{Point(uniform(random, -5, 15), uniform(random, -5, 15), 0)});
    all(commands::Cut{{static_cast<LinkId>(random() % mesh->link_count())}});
    all(commands::SetSoftness{{{uniform(random, 0, 1), uniform(random, 1, 2), uniform(random, 0, 1)}, {}}});
    all(commands::Drag{Point(uniform(random, -5, 15), uniform(random, -5, 15), 0)});
    all(commands::Release{});
  }
  QVERIFY(panels.wait_for_passes(simulation.statistics().passes));
  QVERIFY(panels.left.latest_frame().positions == floats_of(simulation));
  QVERIFY(panels.right.latest_frame().positions == floats_of(simulation));
}

void CommandLogTest::a_move_waits_for_the_next_sample() {
  TwoPanels panels;
  panels.log.sample();  // nothing waits
  panels.keep_busy();
  panels.log.post(commands::Grab{9});
  QVERIFY(!panels.log.waits());
  panels.log.post(commands::Drag{Point(3, 3, 0)});
  QVERIFY(panels.log.waits());
  QCOMPARE(panels.posted, 2);
  panels.gate.open();
  QVERIFY(panels.sample_until_sent());
  QVERIFY(panels.wait_for_passes(1));
  QCOMPARE(panels.posted, 2);
}

void CommandLogTest::idle_solvers_get_a_move_at_once() {
  TwoPanels panels;
  panels.log.post(commands::Grab{9});
  QVERIFY(wait_until([&] { return panels.left.idle() && panels.right.idle(); }));
  panels.log.post(commands::Drag{Point(3, 3, 0)});
  QVERIFY(!panels.log.waits());
  QVERIFY(panels.wait_for_passes(1));
}

void CommandLogTest::of_several_moves_the_last_is_sent() {
  TwoPanels panels;
  panels.log.post(commands::Grab{9});
  panels.keep_busy();
  for (int i = 0; i < 50; ++i) {
    panels.log.post(commands::Drag{Point(i, 3, 0)});
  }
  panels.gate.open();
  QVERIFY(panels.sample_until_sent());
  QVERIFY(panels.wait_for_passes(1));
  QVERIFY(position_in(panels.left.latest_frame(), 9) == (std::array<float, 2>{49, 3}));
}

void CommandLogTest::other_commands_follow_the_move_before_them() {
  // The last move of the handle counts, although it was not sampled before the release.
  TwoPanels panels;
  panels.log.post(commands::Grab{9});
  panels.keep_busy();
  panels.log.post(commands::Drag{Point(4, 3, 0)});
  panels.log.post(commands::Drag{Point(5, 3, 0)});
  panels.log.post(commands::Release{});
  QVERIFY(!panels.log.waits());
  panels.gate.open();
  QVERIFY(panels.wait_for_passes(1));
  QVERIFY(position_in(panels.right.latest_frame(), 9) == (std::array<float, 2>{5, 3}));
  QVERIFY(panels.left.take_error().empty() && panels.right.take_error().empty());
}

void CommandLogTest::a_slider_is_sampled_like_a_move() {
  TwoPanels panels;
  panels.log.post(commands::Grab{9});
  panels.log.post(commands::Drag{Point(7, 7, 0)});
  QVERIFY(panels.sample_until_sent());
  panels.keep_busy();
  for (int i = 0; i < 50; ++i) {
    panels.log.post(commands::SetSoftness{{{0.8, 1.2 + 0.01 * i, 0.1}, {}}});
  }
  panels.gate.open();
  QVERIFY(panels.sample_until_sent());
  QVERIFY(panels.wait_for_passes(2));  // one for the move, and one that answers the new softness
}

void CommandLogTest::kinds_keep_their_order() {
  TwoPanels panels;
  Simulation simulation(make_mesh(MeshKind::grid, {8, 8, 1}), Algorithm::natural_queue, Precision::single_precision);
  const std::vector<Command> in_order{commands::Grab{9},
                                      commands::Drag{Point(7, 7, 0)},
                                      commands::SetSoftness{{{0.5, 1.5, 0.2}, {}}},
                                      commands::Drag{Point(-2, 3, 0)},
                                      commands::SetSoftness{{{0.9, 1.1, 0}, {}}},
                                      commands::Drag{Point(5, -4, 0)},
                                      commands::Release{}};
  for (const Command& command : in_order) {  // no two commands of one kind follow each other, so none is replaced
    simulation.apply(command);
    panels.log.post(command);
  }
  QVERIFY(panels.wait_for_passes(5));
  QVERIFY(panels.left.latest_frame().positions == floats_of(simulation));
  QVERIFY(panels.right.latest_frame().positions == floats_of(simulation));
}

void CommandLogTest::while_one_solver_is_busy_neither_gets_a_move() {
  TwoPanels panels;
  panels.gate.close();
  panels.log.post(commands::Grab{9});
  QVERIFY(wait_until([&] { return panels.gate.someone_stands(); }));
  panels.log.post(commands::Cut{{0}});  // the left solver cannot start it
  QVERIFY(!panels.left.idle());
  for (int i = 0; i < 5; ++i) {
    panels.log.post(commands::Drag{Point(i, 7, 0)});
    panels.log.sample();
    QVERIFY(panels.log.waits());
  }
  QVERIFY(wait_until([&] { return panels.right.idle(); }));
  panels.log.sample();
  QVERIFY(panels.log.waits());  // the right solver is idle, and waits for the left one
  QCOMPARE(panels.right.latest_frame().statistics.passes, std::uint64_t{0});
  panels.gate.open();
  QVERIFY(panels.sample_until_sent());
  QVERIFY(panels.wait_for_passes(1));
  QVERIFY(position_in(panels.left.latest_frame(), 9) == (std::array<float, 2>{4, 7}));
  QVERIFY(panels.left.latest_frame().positions == panels.right.latest_frame().positions);
}

CHAINMAIL_TEST(CommandLogTest)

}  // namespace chainmail::test_command_log

#include "test_command_log.moc"
