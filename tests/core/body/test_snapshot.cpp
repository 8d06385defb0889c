#include <QtTest>

#include "core/simulations.h"
#include "core/threads.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_snapshot {

using namespace chainmail::test;

/// Snapshots of positions, taken from one simulation and restored in another.
class SnapshotTest : public QObject {
  Q_OBJECT

 private slots:
  void another_simulation_takes_it_to_the_bit();
  void what_moves_then_is_kept_and_undone();
  void elements_that_are_not_given_stand_at_rest();
  void held_otherwise_it_is_rounded_alone();
  void what_does_not_fit_is_refused();
  void a_solver_is_asked_in_turn();

 private:
  static Command place(Snapshot snapshot) {
    return commands::SetPositions{std::make_shared<const Snapshot>(std::move(snapshot))};
  }
  static Simulation dragged(const MeshPointer& mesh, Algorithm algorithm, Precision precision) {
    Simulation simulation(mesh, algorithm, precision);
    drag_by(simulation, mesh->element_count() / 2, Point(2.3, 1.7, -0.4));
    drag_by(simulation, 0, Point(-0.1, 1.0 / 3, 0.2));
    return simulation;
  }
};

void SnapshotTest::another_simulation_takes_it_to_the_bit() {
  for (const MeshFamily& family : families()) {
    for (const Precision precision : precisions) {
      for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
        const Simulation one = dragged(family.mesh, algorithm, precision);
        Simulation other(family.mesh, algorithm, precision);
        carry_out(other, place(one.snapshot()));
        QVERIFY2(same_bits(positions_of(other), positions_of(one)), family.name.c_str());
        QVERIFY(other.snapshot() == one.snapshot());
        QVERIFY(!other.valid());  // validity is not known
      }
    }
  }
}

void SnapshotTest::what_moves_then_is_kept_and_undone() {
  const auto mesh = make_mesh(MeshKind::cloth, {20, 20, 1});
  const Simulation one = dragged(mesh, Algorithm::spiral, Precision::single_precision);
  Simulation other(mesh, Algorithm::natural_queue, Precision::single_precision);
  drag_by(other, 399, Point(3, 3, 0));
  const auto before = positions_of(other);
  carry_out(other, commands::KeepState{1});
  carry_out(other, place(one.snapshot()));
  carry_out(other, commands::KeepState{2});
  drag_by(other, 17, Point(0, -4, 0));
  carry_out(other, commands::RestoreState{2});
  QVERIFY(same_bits(positions_of(other), positions_of(one)));
  carry_out(other, commands::RestoreState{1});
  QVERIFY(same_bits(positions_of(other), before));
}

void SnapshotTest::elements_that_are_not_given_stand_at_rest() {
  const auto mesh = make_mesh(MeshKind::grid, {30, 10, 1});
  Simulation simulation = dragged(mesh, Algorithm::natural_queue, Precision::double_precision);
  simulation.forget_changes();
  const PositionRuns some{false, {70, 71, 200, 202}, {7, 8, 1, 2, 3, 4}};
  carry_out(simulation, place(snapshot_of(some, *mesh, Precision::double_precision)));
  auto expected = mesh->rest;
  std::copy_n(std::array{7.0, 8.0}.begin(), 2, expected.begin() + 140);
  std::copy_n(std::array{1.0, 2.0, 3.0, 4.0}.begin(), 4, expected.begin() + 400);
  QVERIFY(same_bits(positions_of(simulation), expected));
  carry_out(simulation, place({}));
  QVERIFY(same_bits(positions_of(simulation), mesh->rest));
  QVERIFY(simulation.valid());
}

void SnapshotTest::held_otherwise_it_is_rounded_alone() {
  const auto mesh = jittered_triangles(8, 8, 3);
  for (const auto& [from, to] :
       {std::pair(Algorithm::exact, Algorithm::spiral), {Algorithm::spiral, Algorithm::exact}}) {
    const Simulation one = dragged(mesh, from, Precision::single_precision);
    Simulation other(mesh, to, Precision::single_precision);
    carry_out(other, place(one.snapshot()));
    const auto expected = positions_of(one), found = positions_of(other);
    for (std::size_t i = 0; i < found.size(); ++i) {
      QVERIFY(std::abs(found[i] - expected[i]) < 1e-6 * 8);  // two roundings of a float below 16
    }
  }
}

void SnapshotTest::what_does_not_fit_is_refused() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  Simulation simulation = dragged(mesh, Algorithm::spiral, Precision::single_precision);
  const SavedState before(simulation);
  const std::vector<PositionRuns> wrong{
      {false, {0, 1}, {1}},       {false, {0, 1}, {1, 2, 3}},        {false, {0}, {}},
      {false, {1, 0}, {}},        {false, {15, 17}, {1, 2, 3, 4}},   {false, {0, 1, 0, 1}, {1, 2, 3, 4}},
      {false, {0, 1}, {1, 1e38}}, {false, {0, 1}, {1, std::nan("")}}};
  for (const PositionRuns& positions : wrong) {
    QVERIFY_THROWS_EXCEPTION(Error, snapshot_of(positions, *mesh, Precision::single_precision));
  }
  const auto block = [](std::size_t count, double value) {
    return std::make_shared<const std::vector<double>>(count, value);
  };
  for (const Snapshot& snapshot :
       {Snapshot{false, {block(31, 0)}}, Snapshot{false, {block(33, 0)}}, Snapshot{false, {block(32, 0), nullptr}},
        Snapshot{false, {block(32, 1e38)}}, Snapshot{false, {block(32, std::nan(""))}}}) {
    QVERIFY_THROWS_EXCEPTION(Error, carry_out(simulation, place(snapshot)));
    QVERIFY(SavedState(simulation) == before);
  }
}

void SnapshotTest::a_solver_is_asked_in_turn() {
  const auto mesh = make_mesh(MeshKind::cloth, {16, 16, 1});
  SolverThread solver(mesh, Algorithm::natural_queue, [] {});
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::single_precision);
  std::vector<Snapshot> answers;  // only the solver's thread writes it until the solver is idle
  for (int i = 0; i < 20; ++i) {
    for (const Command& command :
         {Command(commands::Grab{static_cast<ElementId>(i)}), Command(commands::Drag{Point(i, -2, 0)})}) {
      solver.post(command);
      simulation.apply(command);
    }
    const auto expected = simulation.snapshot();
    solver.ask([&answers](const Simulation& asked) { answers.push_back(asked.snapshot()); });
    if (i % 5 == 0) {
      QVERIFY(wait_until([&] { return solver.idle(); }));
      QVERIFY(answers.back() == expected);
    }
  }
  QVERIFY(wait_until([&] { return solver.idle(); }));
  QCOMPARE(answers.size(), std::size_t{20});
  QVERIFY(answers.back() == simulation.snapshot());
}

CHAINMAIL_TEST(SnapshotTest)

}  // namespace chainmail::test_snapshot

#include "test_snapshot.moc"
