#include <QtTest>

#include "core/threads.h"
#include "equilibrium/link_energy.h"
#include "measure/shape_measures.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"

namespace chainmail::test_settling {

using namespace chainmail::test;

/// The relaxation scheme `equilibrium` in a simulation: the object settles, stays valid, and sleeps.
class SettlingTest : public QObject {
  Q_OBJECT

 private slots:
  void after_a_drag_it_settles_and_sleeps_data();
  void after_a_drag_it_settles_and_sleeps();
  void a_drag_while_it_settles_is_followed();
  void at_rest_nothing_is_prepared();
  void what_comes_no_closer_is_not_settled();
  void another_material_wakes_it();
  void pins_that_contradict_each_other_leave_a_remark();
  void iterations_at_once_end_at_the_residual();
  void another_scheme_begins_at_once();
  void softness_is_felt_without_a_pass();
  void positions_from_elsewhere_stay();
  void a_solver_moves_nothing_before_it_is_woken();
  void a_cancelled_iteration_moves_nothing_and_goes_on();
  void a_thread_settles_between_passes();
  void fine_only_where_needed_it_settles_as_without();
  void fine_only_where_needed_it_is_repeated_to_the_bit();
};

namespace {

constexpr ElementId handle = 119;  // the last element of the grid
constexpr commands::SetRelaxation on{true, 1, RelaxationScheme::equilibrium};

MeshPointer made_grid() { return make_mesh(MeshKind::grid, {12, 10, 1}); }

/// Pins the left side.
void pin_left(Simulation& simulation) {
  std::vector<ElementId> left;
  for (ElementId row = 0; row < 10; ++row) {
    left.push_back(12 * row);
  }
  carry_out(simulation, commands::Pin{left});
}

Simulation held_grid(Algorithm algorithm, Precision precision = Precision::double_precision) {
  Simulation simulation(made_grid(), algorithm, precision);
  pin_left(simulation);
  carry_out(simulation, on);
  return simulation;
}

bool is_valid(const Simulation& simulation) {
  return measure_violation(simulation.mesh(), simulation.softness(), simulation.body().cuts(),
                           simulation.body().positions())
             .fraction == 0;
}

/// A solid of 24,576 cells in open regions, pinned at its left side, with a handle at its surface.
class Solid {
 public:
  explicit Solid(bool local)
      : simulation(make_mesh(MeshKind::tetra, {17, 17, 17}), Algorithm::exact, Precision::double_precision) {
    play(commands::SetSoftness{Softness{{0, 3, 2}, {}, EnergyKind::material}});
    play(commands::Pin{layer(simulation.mesh(), *find_side("left"))});
    play(commands::SetRelaxation{true, 1, RelaxationScheme::equilibrium, false, local});
    relax(0);
    play(commands::Grab{std::vector<ElementId>{4771, 4772, 4788, 4789}});
  }
  void drag(double by) {
    commands::Drag drag{Point(0, by / 2, by)};
    drag.relative = true;
    play(drag);
  }
  void play(const Command& command) {
    simulation.apply(command);
    const auto* set = std::get_if<commands::SetRelaxation>(&command);
    start_ = set != nullptr ? commands::Relaxed::Start::awake : start_;
    if (set == nullptr && !is_one_of<commands::KeepState>(command)) {
      moves.push_back(command);
    }
  }
  /// Runs slices, and records them.
  void relax(std::uint32_t slices) {
    const std::uint32_t before = simulation.slices();
    for (std::uint32_t i = 0; i < slices && simulation.continue_relaxation(); ++i) {
    }
    const auto counts = std::make_shared<commands::SliceCounts>(1);
    counts->note(0, Algorithm::exact, simulation.slices() - before);
    const commands::SetRelaxation& how = simulation.relaxation();
    moves.push_back(commands::Relaxed{how.scheme, how.step, std::exchange(start_, commands::Relaxed::Start::goes_on),
                                      counts, 0, how.local});
  }

  Simulation simulation;
  std::vector<Command> moves;

 private:
  commands::Relaxed::Start start_ = commands::Relaxed::Start::goes_on;
};

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, std::abs(one[i] - other[i]));
  }
  return largest;
}

/// Steps until it sleeps. Returns the number of steps; 0 if that takes too many, or if a state on the way is not valid.
int steps_to_sleep(Simulation& simulation) {
  constexpr int most = 1000;
  for (int steps = 1; steps < most; ++steps) {
    const bool more = simulation.continue_relaxation();
    if (!is_valid(simulation)) {
      return 0;
    }
    if (!more) {
      return steps;
    }
  }
  return 0;
}

}  // namespace

void SettlingTest::after_a_drag_it_settles_and_sleeps_data() {
  QTest::addColumn<Point>("by");
  QTest::addColumn<bool>("binds");
  QTest::addColumn<bool>("in_float");
  QTest::newRow("no region binds") << Point(0.12, 0.09, 0) << false << false;
  QTest::newRow("regions bind") << Point(1.8, 1.1, 0) << true << false;
  QTest::newRow("regions bind, float") << Point(1.8, 1.1, 0) << true << true;
}

void SettlingTest::after_a_drag_it_settles_and_sleeps() {
  QFETCH(Point, by);
  QFETCH(bool, binds);
  QFETCH(bool, in_float);
  Simulation simulation =
      held_grid(Algorithm::exact, in_float ? Precision::single_precision : Precision::double_precision);
  QVERIFY(steps_to_sleep(simulation) > 0);  // a scene at rest comes to rest
  QVERIFY(!simulation.continue_relaxation());
  drag_by(simulation, handle, by);
  const Point target = position_of(simulation, handle);
  const double energy =
      elastic_energy(simulation.mesh(), simulation.softness(), simulation.body().cuts(), simulation.body().positions());
  const int steps = steps_to_sleep(simulation);
  QVERIFY(steps > 1);
  QVERIFY(simulation.statistics().residual.value_or(1) <= 1e-4);
  QVERIFY(elastic_energy(simulation.mesh(), simulation.softness(), simulation.body().cuts(),
                         simulation.body().positions()) < energy);
  QVERIFY(position_of(simulation, handle) == target);
  const auto certificate = simulation.certificate();
  QVERIFY(certificate && certificate->binds == binds);
  QCOMPARE(simulation.statistics().sweeps, std::uint64_t(steps));
  // Asleep, it costs nothing and nothing moves.
  const auto asleep = positions_of(simulation);
  QVERIFY(!simulation.continue_relaxation() && !simulation.statistics().relaxing);
  QVERIFY(same_bits(positions_of(simulation), asleep));
}

void SettlingTest::at_rest_nothing_is_prepared() {
  Simulation simulation = held_grid(Algorithm::natural_queue);
  carry_out(simulation, commands::Cut{{3}});
  simulation.continue_relaxation();  // the cut woke it
  QVERIFY(!simulation.continue_relaxation());
  QCOMPARE(simulation.statistics().residual, std::optional(0.0));
  QVERIFY(!simulation.certificate());
  drag_by(simulation, handle, Point(0.5, 0.3, 0));
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(simulation.certificate());
}

/// The two links of a chain contradict each other, so sweeps over links never end. It tries once more, then it stops
/// and says so.
void SettlingTest::what_comes_no_closer_is_not_settled() {
  Simulation chain(make_mesh(MeshKind::line, {3, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  carry_out(chain, commands::Pin{{0}});
  drag_by(chain, 2, Point(0.2, 0, 0));
  carry_out(chain, commands::Release{});
  carry_out(chain, commands::Pin{{2}});
  carry_out(chain, commands::SetRelaxation{true, 1, RelaxationScheme::link});
  const auto slices_to_stop = [&] {
    const std::uint32_t before = chain.slices();
    while (chain.continue_relaxation()) {
    }
    return chain.slices() - before;
  };
  QVERIFY(slices_to_stop() > 2000);
  QVERIFY(chain.statistics().unsettled.value_or(0) > 0.01 && !chain.statistics().relaxing);
  carry_out(chain, commands::SetRelaxation{true, 1, RelaxationScheme::link, true});
  QVERIFY(!chain.statistics().unsettled && chain.statistics().relaxing);
  QVERIFY(slices_to_stop() > 2000);
  carry_out(chain, commands::SetRelaxation{true, 1, RelaxationScheme::mean});  // this scheme has an end there
  slices_to_stop();
  QVERIFY(!chain.statistics().unsettled);
}

void SettlingTest::another_material_wakes_it() {
  Simulation simulation = held_grid(Algorithm::exact);
  carry_out(simulation, commands::SetSoftness{Softness{{0, 100, 100}, {}, EnergyKind::material}});
  carry_out(simulation, commands::Grab{handle});
  carry_out(simulation, commands::Drag{position_of(simulation, handle) + Point(3, 1, 0)});
  QVERIFY(steps_to_sleep(simulation) > 0);
  const auto before = positions_of(simulation);
  ElasticOptions options;
  options.material.poisson = 0.49;
  carry_out(simulation, commands::SetElastic{options});
  QVERIFY(steps_to_sleep(simulation) > 1);
  QVERIFY(!same_bits(positions_of(simulation), before));
}

void SettlingTest::a_drag_while_it_settles_is_followed() {
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
    Simulation simulation = held_grid(algorithm);
    carry_out(simulation, commands::Grab{handle});
    const Point start = position_of(simulation, handle);
    for (int i = 1; i <= 20; ++i) {
      const Point target = start + i * Point(0.08, 0.05, 0);
      carry_out(simulation, commands::Drag{target});
      QVERIFY(position_of(simulation, handle) == target);
      QVERIFY(simulation.continue_relaxation());
      QVERIFY(position_of(simulation, handle) == target);
      QVERIFY(is_valid(simulation));
    }
    QVERIFY2(steps_to_sleep(simulation) > 0, qPrintable(QString::number(simulation.statistics().residual.value_or(1))));
    QVERIFY(simulation.statistics().residual.value_or(1) <= 1e-4);
    carry_out(simulation, commands::Release{});
    QVERIFY(steps_to_sleep(simulation) > 0);  // back to rest
    QVERIFY((position_of(simulation, handle) - start).norm() < 0.01);
  }
}

void SettlingTest::pins_that_contradict_each_other_leave_a_remark() {
  Simulation simulation(make_mesh(MeshKind::line, {4, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::Pin{{3}});
  drag_by(simulation, 0, Point(-5, 0, 0));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Pin{{0}});
  const auto before = positions_of(simulation);
  carry_out(simulation, on);
  QVERIFY(!simulation.continue_relaxation());
  QVERIFY(!simulation.statistics().remark.empty() && !simulation.statistics().residual);
  QVERIFY(same_bits(positions_of(simulation), before));
  QVERIFY_THROWS_EXCEPTION(Error, carry_out(simulation, commands::Relax{5, 1, RelaxationScheme::equilibrium}));
  // Without the contradiction, the remark goes.
  carry_out(simulation, commands::Unpin{{0}});
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(simulation.statistics().remark.empty() && simulation.statistics().residual);
}

void SettlingTest::iterations_at_once_end_at_the_residual() {
  const auto relaxed = [](std::uint32_t most, double until) {
    auto simulation = std::make_unique<Simulation>(made_grid(), Algorithm::exact, Precision::double_precision);
    pin_left(*simulation);
    drag_by(*simulation, handle, Point(0.12, 0.09, 0));
    carry_out(*simulation, commands::Relax{most, 1, RelaxationScheme::equilibrium, until});
    return simulation;
  };
  const auto few = relaxed(200, 1e-2), many = relaxed(200, 1e-6), all = relaxed(7, 0);
  QVERIFY(few->certificate()->residual <= 1e-2);
  QVERIFY(many->certificate()->residual <= 1e-6);
  QVERIFY(few->certificate()->iterations < many->certificate()->iterations);
  QVERIFY(many->certificate()->iterations < 200);
  QVERIFY(*many->certificate()->gap < 1e-6);
  QCOMPARE(all->certificate()->iterations, 7);
  QVERIFY(!few->statistics().relaxing);
  QVERIFY(few->relaxation().scheme == RelaxationScheme::mean);  // the command has its own scheme
}

void SettlingTest::another_scheme_begins_at_once() {
  Simulation simulation(made_grid(), Algorithm::exact, Precision::double_precision);
  pin_left(simulation);
  carry_out(simulation, commands::SetRelaxation{true, 1, RelaxationScheme::mean});
  drag_by(simulation, handle, Point(0.4, 0.3, 0));
  while (simulation.continue_relaxation()) {
  }
  QVERIFY(!simulation.statistics().residual);
  carry_out(simulation, on);
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(simulation.statistics().residual);
  carry_out(simulation, commands::SetRelaxation{true, 1, RelaxationScheme::link});
  QVERIFY(!simulation.statistics().residual);
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(!simulation.statistics().residual);
}

/// The handle of the last pass is pinned, so no pass answers the change.
void SettlingTest::softness_is_felt_without_a_pass() {
  Simulation simulation = held_grid(Algorithm::exact);
  drag_by(simulation, handle, Point(1.8, 1.1, 0));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Pin{{handle}});
  QVERIFY(steps_to_sleep(simulation) > 0);
  QVERIFY(simulation.certificate()->binds);
  const Point before = position_of(simulation, handle - 1);
  carry_out(simulation, commands::SetSoftness{{{0, 100, 100}, {}}});
  QVERIFY(steps_to_sleep(simulation) > 1);
  QVERIFY(!simulation.certificate()->binds);
  QVERIFY((position_of(simulation, handle - 1) - before).norm() > 0.01);
}

void SettlingTest::positions_from_elsewhere_stay() {
  Simulation simulation = held_grid(Algorithm::exact);
  drag_by(simulation, handle, Point(0.4, 0.3, 0));
  QVERIFY(simulation.continue_relaxation());
  carry_out(simulation, commands::Reset{});
  QVERIFY(!simulation.continue_relaxation() && !simulation.statistics().residual);
  simulation.relax(5, {1, simulation.relaxation().scheme});  // an object at rest is at equilibrium
  QVERIFY(same_bits(positions_of(simulation), simulation.mesh().rest));
}

/// A solver sleeps at first, after positions were set, and when it is told to. Then an iteration costs and moves
/// nothing.
void SettlingTest::a_solver_moves_nothing_before_it_is_woken() {
  Deformer solver(made_grid(), Algorithm::exact, Precision::double_precision);
  const Mesh& mesh = solver.body().mesh();
  solver.body().pin(std::vector<ElementId>{0});
  solver.set_relaxation(RelaxationScheme::equilibrium);
  const auto moves = [&] {
    const auto before = positions_of(solver, mesh);
    const RelaxationResult result = solver.relax_slice(1, mesh.element_count(), std::array{handle});
    const bool same = same_bits(positions_of(solver, mesh), before);
    return result.visited != 0 || !same;
  };
  solver.move(handle, mesh.rest_position(handle) + Point(0.4, 0.3, 0));
  QVERIFY(!moves());
  solver.wake_all();
  QVERIFY(moves());
  std::vector<double> elsewhere = mesh.rest;
  elsewhere[2 * 60] += 0.2;
  solver.body().set_positions(elsewhere);
  QVERIFY(!moves());
  solver.wake_all();
  QVERIFY(moves());
  solver.sleep();
  QVERIFY(!moves());
}

void SettlingTest::a_cancelled_iteration_moves_nothing_and_goes_on() {
  const Progress job = Progress::watched();
  Simulation simulation = held_grid(Algorithm::exact);
  simulation.set_progress(job);
  drag_by(simulation, handle, Point(0.4, 0.3, 0));
  const auto before = positions_of(simulation);
  job.cancel();
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(same_bits(positions_of(simulation), before));
  job.cancel(false);
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(!same_bits(positions_of(simulation), before));
}

void SettlingTest::a_thread_settles_between_passes() {
  SolverThread solver(make_mesh(MeshKind::grid, {60, 50, 1}), Algorithm::exact, [] {});
  solver.post(on);
  solver.post(commands::Pin{{0}});
  solver.post(commands::Grab{2999});
  for (int i = 1; i <= 30; ++i) {
    solver.post(commands::Drag{Point(59 + 0.2 * i, 49 + 0.1 * i, 0)});
    QVERIFY(wait_for_passes(solver, std::uint64_t(i)));
    const Frame& frame = solver.latest_frame();
    QCOMPARE(frame.positions[5998], float(59 + 0.2 * i));  // the handle is where it was dragged
  }
  QVERIFY(wait_until([&] { return !solver.latest_frame().statistics.relaxing && solver.settled(); }));
  QVERIFY(solver.latest_frame().statistics.residual.has_value());
  QCOMPARE(solver.take_error(), std::string());
  // The thread ends while the object settles.
  solver.post(commands::Drag{Point(70, 60, 0)});
  QVERIFY(wait_for_passes(solver, 31));
}

void SettlingTest::fine_only_where_needed_it_settles_as_without() {
  Solid local(true), whole(false);
  for (Solid* solid : {&local, &whole}) {
    for (int i = 1; i <= 4; ++i) {
      solid->drag(0.7 * i);
      solid->relax(1);
      QCOMPARE(solid->simulation.statistics().estimate.has_value(), solid == &local);
      QVERIFY(solid->simulation.statistics().residual.has_value() != (solid == &local));
    }
  }
  QVERIFY(local.simulation.statistics().nodes < local.simulation.mesh().element_count() / 2);
  QVERIFY(*local.simulation.statistics().estimate < 0.2);
  local.relax(1);  // writes what is inside
  const auto followed = positions_of(local.simulation);
  for (Solid* solid : {&local, &whole}) {
    solid->relax(300);
    QVERIFY(!solid->simulation.statistics().relaxing && !solid->simulation.statistics().estimate);
    QVERIFY(solid->simulation.statistics().residual.value_or(1) <= 1e-4);
  }
  const auto settled = positions_of(local.simulation);
  QVERIFY(largest_difference(settled, positions_of(whole.simulation)) < 0.01);
  const double apart = largest_difference(followed, settled);
  QVERIFY2(apart > 1e-4 && apart < 0.3, qPrintable(QString::number(apart)));
}

/// Also where states are kept in between, which are complete.
void SettlingTest::fine_only_where_needed_it_is_repeated_to_the_bit() {
  Solid solid(true);
  for (int i = 1; i <= 3; ++i) {
    solid.drag(i);
    solid.relax(1);
    solid.play(commands::KeepState{1});
  }
  const auto kept = positions_of(solid.simulation);
  solid.play(commands::Cut{{solid.simulation.mesh().entry_link[solid.simulation.mesh().first_entry[4772]]}});
  solid.drag(2);
  solid.relax(4);
  solid.play(commands::Release{});
  solid.relax(3);
  solid.play(commands::Grab{std::vector<ElementId>{4700, 4701}});
  solid.drag(-1);
  solid.relax(2);
  Simulation again(solid.simulation.mesh_pointer(), Algorithm::exact, Precision::double_precision);
  again.set_threads(2);
  for (const Command& command : solid.moves) {
    again.apply(command);
  }
  QVERIFY(same_bits(positions_of(again), positions_of(solid.simulation)));
  carry_out(solid.simulation, commands::RestoreState{1});
  QVERIFY(same_bits(positions_of(solid.simulation), kept));
  QVERIFY(inverted_cells(solid.simulation.mesh(), solid.simulation.body().positions()).value_or(1) == 0);
}

CHAINMAIL_TEST(SettlingTest)

}  // namespace chainmail::test_settling

#include "test_settling.moc"
