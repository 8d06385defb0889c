#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <numbers>

#include "core/simulations.h"
#include "equilibrium/link_energy.h"
#include "mesh/layers.h"
#include "mesh/parts.h"
#include "program.h"

namespace chainmail::test_simulation {

using namespace chainmail::test;

/// The effect of each command on an object.
class SimulationTest : public QObject {
  Q_OBJECT

 private slots:
  void exact_takes_over_at_once();
  void what_passes_did_goes_with_them();
  void grabbing_moves_nothing();
  void a_drag_is_one_pass();
  void after_release_a_drag_has_nothing_to_move();
  void new_softness_acts_at_once_under_load();
  void new_softness_at_rest_moves_nothing();
  void a_turned_handle_stays_whatever_is_set_data();
  void a_turned_handle_stays_whatever_is_set();
  void the_algorithm_may_change_midway();
  void cut_and_uncut();
  void reset_keeps_cuts_and_softness();
  void after_a_reset_sweeps_repeat_to_the_bit();
  void another_mesh_is_uncut_and_at_rest();
  void every_setting_survives_another_mesh();
  void relaxation_runs_in_idle_time_and_sleeps();
  void relaxation_stops_when_switched_off();
  void a_cut_under_tension_is_felt();
  void sweeps_at_once_need_no_switch();
  void sweeps_of_a_large_mesh_are_those_of_its_solver();
  void sweeps_are_given_up_in_the_middle_of_one();
  void statistics_say_what_happened();
  void large_objects_are_measured_in_slices();
  void valid_is_what_the_whole_mesh_says();
};

namespace {

Simulation grid_simulation(Algorithm algorithm = Algorithm::natural_queue) {
  return {make_mesh(MeshKind::grid, {6, 5, 1}), algorithm, Precision::double_precision};
}

/// Runs steps until the simulation sleeps. Returns false if it does not within this number of slices.
bool comes_to_rest(Simulation& simulation, int slices = 100'000) {
  for (int i = 0; i < slices; ++i) {
    if (!simulation.continue_relaxation()) {
      return true;
    }
  }
  return false;
}

}  // namespace

void SimulationTest::grabbing_moves_nothing() {
  auto simulation = grid_simulation();
  const auto before = positions_of(simulation);
  carry_out(simulation, commands::Grab{7});
  QCOMPARE(simulation.grabbed()[0], 7u);
  QVERIFY(same_bits(before, positions_of(simulation)));
  QCOMPARE(simulation.statistics().passes, std::uint64_t{0});
  carry_out(simulation, commands::Grab{8});  // another handle takes over
  QCOMPARE(simulation.grabbed()[0], 8u);
}

void SimulationTest::a_drag_is_one_pass() {
  auto simulation = grid_simulation();
  Trace trace, expected;
  simulation.set_trace(&trace);
  const auto solver =
      std::make_unique<Deformer>(simulation.mesh_pointer(), Algorithm::natural_queue, Precision::double_precision);
  drag_by(simulation, 7, Point(2, 1, 0));
  drag_by(simulation, 7, Point(-1, 3, 0));
  solver->move(7, Point(3, 2, 0), &expected);
  const PassCount count = solver->move(7, Point(2, 5, 0), &expected);
  QVERIFY(same_bits(positions_of(*solver, simulation.mesh()), positions_of(simulation)));
  QVERIFY(trace == expected);
  QCOMPARE(simulation.statistics().passes, std::uint64_t{2});
  QCOMPARE(simulation.statistics().last_pass.checked, count.checked);
  QCOMPARE(simulation.statistics().last_pass.moved, count.moved);
}

void SimulationTest::after_release_a_drag_has_nothing_to_move() {
  auto simulation = grid_simulation();
  drag_by(simulation, 7, Point(2, 1, 0));
  carry_out(simulation, commands::Release{});
  QVERIFY(simulation.grabbed().empty());
  carry_out(simulation, commands::Release{});  // has no effect
  const SavedState before(simulation);
  QVERIFY_EXCEPTION_THROWN(carry_out(simulation, commands::Drag{Point(9, 9, 0)}), std::runtime_error);
  QVERIFY(SavedState(simulation) == before);
}

void SimulationTest::new_softness_acts_at_once_under_load() {
  Simulation simulation(make_mesh(MeshKind::line, {4, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 2, 0}, {}}});
  drag_by(simulation, 0, Point(-6, 0, 0));
  QCOMPARE(positions_of(simulation), (std::vector<double>{-6, -4, -2, 0}));
  carry_out(simulation, commands::SetSoftness{{{0.5, 1.5, 0}, {}}});
  QCOMPARE(positions_of(simulation), (std::vector<double>{-6, -4.5, -3, -1.5}));
  carry_out(simulation, commands::SetSoftness{{{0.5, 1.5, 0}, {{0, {1, 1, 0}}}}});
  QCOMPARE(positions_of(simulation), (std::vector<double>{-6, -5, -3.5, -2}));
}

void SimulationTest::new_softness_at_rest_moves_nothing() {
  auto simulation = grid_simulation();
  const auto before = positions_of(simulation);
  carry_out(simulation, commands::SetSoftness{{{1, 1, 0}, {}}});
  QVERIFY(same_bits(before, positions_of(simulation)));
  QVERIFY(simulation.softness() == (Softness{{1, 1, 0}, {}}));
}

void SimulationTest::a_turned_handle_stays_whatever_is_set_data() {
  QTest::addColumn<Algorithm>("algorithm");
  QTest::newRow("ChainMail") << Algorithm::natural_queue;
  QTest::newRow("elasticity") << Algorithm::linear_fem;
}

/// A side of a solid is turned by 60° and held while everything else is set, and then in another simulation. Only the
/// equilibrium may move what is held, to make the links around it valid.
void SimulationTest::a_turned_handle_stays_whatever_is_set() {
  QFETCH(Algorithm, algorithm);
  const auto mesh = make_mesh(MeshKind::tetra, {4, 3, 3});
  const std::vector<ElementId> handle = layer(*mesh, *find_side("right"));
  const Point by(0.5, -0.25, 0.125), pivot(3, 1, 1);
  Simulation simulation(mesh, algorithm, Precision::double_precision);
  carry_out(simulation, commands::Pin{layer(*mesh, *find_side("left"))});
  carry_out(simulation, commands::Grab{handle});
  carry_out(simulation, commands::Drag{by, {Point(1, 2, 2), 60}, true});
  const Eigen::AngleAxisd turn(std::numbers::pi / 3, Point(1, 2, 2) / 3);
  const auto stays = [&](const Simulation& one) {
    return std::ranges::all_of(handle, [&](ElementId e) {
      return (position_of(one, e) - (pivot + by + turn * (mesh->rest_position(e) - pivot))).norm() < 1e-12;
    });
  };
  QVERIFY(stays(simulation));
  const Softness soft{{0.5, 1.5, 0.25}, {}};
  const Algorithm other = algorithm == Algorithm::linear_fem ? Algorithm::natural_queue : Algorithm::linear_fem;
  const std::vector<Command> commands{
      commands::SetSoftness{soft},
      commands::SetSoftness{{soft.global, {{0, {1, 1, 0}}}, EnergyKind::material}},
      commands::SetSoftness{{soft.global, {}, standard_energy, {AxesKind::given, Point(0.1, 0.2, 0.3)}}},
      commands::SetElastic{{{2, 0.25}}},
      commands::SetAlgorithm{other},
      commands::SetElastic{{{3, 0.4}}},
      commands::SetSoftness{},
      commands::Cut{{0, 1}},
      commands::Uncut{{0, 1}},
      commands::Pin{{1}},
      commands::Unpin{{1}},
      commands::Relax{3},
      commands::SetRelaxation{true}};
  for (const Command& command : commands) {
    carry_out(simulation, command);
    QVERIFY2(stays(simulation), qPrintable(QString("command of kind %1").arg(command.index())));
  }
  for (int slice = 0; slice < 3; ++slice) {
    simulation.continue_relaxation();
  }
  QVERIFY(stays(simulation));
  Simulation heir(mesh, algorithm, Precision::double_precision);
  heir.take(simulation.hand_over(), algorithm);
  carry_out(heir, commands::SetSoftness{soft});
  carry_out(heir, commands::SetElastic{{{2, 0.25}}});
  QVERIFY(stays(heir));
}

void SimulationTest::the_algorithm_may_change_midway() {
  auto simulation = grid_simulation(Algorithm::generalized);
  drag_by(simulation, 7, Point(2, 1, 0));
  const auto before = positions_of(simulation);
  carry_out(simulation, commands::SetAlgorithm{Algorithm::natural_queue});
  QVERIFY(same_bits(before, positions_of(simulation)));
  QVERIFY(simulation.statistics().algorithm == Algorithm::natural_queue);
  const auto solver =
      std::make_unique<Deformer>(simulation.mesh_pointer(), Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_positions(before);
  drag_by(simulation, 7, Point(1, 1, 0));
  solver->move(7, position_of(simulation, 7));
  QVERIFY(same_bits(positions_of(*solver, simulation.mesh()), positions_of(simulation)));
}

void SimulationTest::cut_and_uncut() {
  auto simulation = grid_simulation();
  const auto before = positions_of(simulation);
  carry_out(simulation, commands::Cut{{3, 1, 4, 1}});
  QCOMPARE(simulation.body().cuts().links(), (std::vector<LinkId>{1, 3, 4}));
  carry_out(simulation, commands::Uncut{{1, 4}});
  QCOMPARE(simulation.body().cuts().links(), (std::vector<LinkId>{3}));
  QVERIFY(same_bits(before, positions_of(simulation)));
}

void SimulationTest::reset_keeps_cuts_and_softness() {
  auto simulation = grid_simulation();
  const Softness softness{{0.5, 1.5, 0.25}, {{4, {1, 1, 0}}}};
  carry_out(simulation, commands::SetSoftness{softness});
  carry_out(simulation, commands::Cut{{5}});
  drag_by(simulation, 7, Point(4, 0, 0));
  carry_out(simulation, commands::Reset{});
  QVERIFY(positions_of(simulation) == simulation.mesh().rest);
  QCOMPARE(simulation.body().cuts().links(), (std::vector<LinkId>{5}));
  QVERIFY(simulation.softness() == softness);
  QVERIFY(simulation.valid());
  carry_out(simulation, commands::Drag{Point(2, 2, 0)});  // the element is still grabbed
  QVERIFY(position_of(simulation, 7) == Point(2, 2, 0));
}

void SimulationTest::another_mesh_is_uncut_and_at_rest() {
  auto simulation = grid_simulation();
  const LinkSoftness global{0.5, 1.5, 0.25};
  carry_out(simulation, commands::SetSoftness{{global, {{4, {1, 1, 0}}}}});
  carry_out(simulation, commands::Cut{{5}});
  drag_by(simulation, 7, Point(4, 0, 0));
  const auto tetra = make_mesh(MeshKind::tetra, {3, 3, 3});
  carry_out(simulation, commands::ReplaceMesh{tetra});
  QVERIFY(simulation.mesh_pointer() == tetra);
  QVERIFY(positions_of(simulation) == tetra->rest);
  QVERIFY(simulation.body().cuts().links().empty());
  QVERIFY(simulation.softness() == (Softness{global, {}}));  // softness per link belongs to the old one
  QVERIFY(simulation.grabbed().empty());
  // The global softness also applies to the new mesh: the link along the drag stretches to 1.5.
  drag_by(simulation, 0, Point(-8, 0, 0));
  QCOMPARE(position_of(simulation, 1)[0], -8 + 1.5);
}

namespace {

/// What a pass got from its simulation.
struct PassSettings {
  std::optional<Precision> precision;
  int threads = 0;
  const Trace* trace = nullptr;
  Progress progress;
};

/// Moves nothing, and notes what it got.
class NotingMethod : public Method {
 public:
  NotingMethod(PassSettings& seen, Precision precision) : seen_(seen), precision_(precision) {}
  PassCount move(Body& /*body*/, HandleMove& /*move*/, PassOutput output) override {
    seen_ = {precision_, output.threads, output.trace, output.progress};
    output.moved.clear();
    return {};
  }

 private:
  PassSettings& seen_;
  Precision precision_;
};

constexpr auto noting_algorithm = Algorithm(1002);

AlgorithmInfo noting_entry(PassSettings& seen) {
  return {.algorithm = noting_algorithm,
          .name = "noting",
          .label = "Noting",
          .source = "nobody 2000",
          .summary = "notes what it got",
          .style = {"M0 0H1V1Z", "#123456"},
          .make = [&seen](Precision precision, int) { return std::make_unique<NotingMethod>(seen, precision); }};
}

const Softness other_softness{
    {0.4, 1.7, 0.3, 0.2, 3, -0.5}, {}, EnergyKind::axial, RegionAxes(AxesKind::given, {0, 0, 0.3})};
const ElasticOptions other_elastic{{2.5, 0.2}, {3, 5, 6}, 17, {StrainLaw::Kind::gent, 4, 0.25}, 0.03};
const commands::SetRelaxation other_relaxation{true, 0.5, RelaxationScheme::link, false, true};

/// True if every setting differs from its default, so that one that is lost is seen. A new member of these structures
/// does not compile here until it is looked at.
bool all_are_other() {
  const auto& [material, lattice, iterations, law, thickness] = other_elastic;
  const auto& [young, poisson] = material;
  const auto& [kind, gent_limit, fung_exponent] = law;
  const auto& [on, step, scheme, anew, local] = other_relaxation;
  const auto& [global, links, energy, frame] = other_softness;
  const ElasticOptions elastic;
  const commands::SetRelaxation relaxation;
  return std::ranges::none_of(
             softness_numbers,
             [&](const SoftnessNumber& one) { return global.*one.value == LinkSoftness().*one.value; }) &&
         links.empty() && energy != standard_energy && frame != RegionAxes() && young != elastic.material.young &&
         poisson != elastic.material.poisson && lattice[0] != elastic.lattice[0] && lattice[1] != elastic.lattice[1] &&
         lattice[2] != elastic.lattice[2] && iterations != elastic.iterations && kind != elastic.law.kind &&
         gent_limit != elastic.law.gent_limit && fung_exponent != elastic.law.fung_exponent &&
         thickness != elastic.thickness && on != relaxation.on && step != relaxation.step &&
         scheme != relaxation.scheme && local != relaxation.local && !anew;  // which is of the command, not a setting
}

SplitPointer split_of_two_triangles() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  add_triangle(parts, 0, 1, 2);
  add_triangle(parts, 0, 2, 3);
  return make_split(build_mesh(std::move(parts)),
                    {{SplitPoint::copy(0), SplitPoint::copy(2)}, {1}, {{4, 5, 3}}, {}, {}});
}

/// Returns what of a simulation's settings is not as set; empty if all is. Runs a pass, which notes into `seen`.
std::string lost_setting(Simulation& simulation, const PassSettings& seen, const Trace& trace, const Progress& job) {
  drag_by(simulation, 0, Point(1, 0, 0));
  job.cancel();
  bool can_be_cancelled = false;
  try {
    seen.progress.report(0);
  } catch (const Cancelled&) {
    can_be_cancelled = true;
  }
  job.cancel(false);
  return simulation.statistics().algorithm != noting_algorithm               ? "algorithm"
         : seen.precision != Precision::single_precision                     ? "precision"
         : seen.threads != 3                                                 ? "threads"
         : seen.trace != &trace                                              ? "trace"
         : !can_be_cancelled                                                 ? "progress"
         : simulation.softness() != other_softness                           ? "softness"
         : simulation.elastic() != other_elastic                             ? "elastic options"
         : simulation.relaxation() != other_relaxation                       ? "relaxation"
         : simulation.deformer().relaxation() != other_relaxation.scheme     ? "scheme of the solver"
         : simulation.deformer().relaxes_locally() != other_relaxation.local ? "local relaxation of the solver"
                                                                             : "";
}

}  // namespace

void SimulationTest::every_setting_survives_another_mesh() {
  QVERIFY(all_are_other());
  PassSettings seen;
  const ExtraAlgorithm extra(noting_entry(seen));
  const auto split = split_of_two_triangles();
  Trace trace;
  const Progress job = Progress::watched();
  Simulation simulation(split->before(), noting_algorithm, Precision::single_precision);
  simulation.set_threads(3);
  simulation.set_trace(&trace);
  simulation.set_progress(job);
  carry_out(simulation, commands::SetSoftness{other_softness});
  carry_out(simulation, commands::SetElastic{other_elastic});
  carry_out(simulation, other_relaxation);
  carry_out(simulation, commands::KeepState{1});
  const std::vector<std::pair<const char*, Command>> ways{
      {"a split", commands::Split{split}},
      {"its undoing", commands::RestoreState{1}},
      {"another object", commands::ReplaceMesh{make_mesh(MeshKind::grid, {3, 3, 1})}}};
  for (const auto& [name, command] : ways) {
    const MeshPointer before = simulation.mesh_pointer();
    carry_out(simulation, command);
    QVERIFY(simulation.mesh_pointer() != before);
    seen = {};
    const std::string lost = lost_setting(simulation, seen, trace, job);
    QVERIFY2(lost.empty(), (lost + " after " + name).c_str());
  }
}

void SimulationTest::relaxation_runs_in_idle_time_and_sleeps() {
  auto simulation = grid_simulation();
  QVERIFY(!simulation.continue_relaxation());  // off
  carry_out(simulation, commands::SetRelaxation{true, 1});
  QVERIFY(comes_to_rest(simulation));  // at rest there is nothing to relax
  QVERIFY(positions_of(simulation) == simulation.mesh().rest);
  drag_by(simulation, 0, Point(-2, -1, 0));
  QVERIFY(simulation.statistics().relaxing);
  const double before =
      elastic_energy(simulation.mesh(), simulation.softness(), simulation.body().cuts(), simulation.body().positions());
  QVERIFY(simulation.continue_relaxation());
  QVERIFY(comes_to_rest(simulation));
  QVERIFY(!simulation.statistics().relaxing);
  QVERIFY(!simulation.continue_relaxation());
  QVERIFY(position_of(simulation, 0) == Point(-2, -1, 0));  // the handle stays
  const double after =
      elastic_energy(simulation.mesh(), simulation.softness(), simulation.body().cuts(), simulation.body().positions());
  QVERIFY(after < before / 10);
}

void SimulationTest::relaxation_stops_when_switched_off() {
  // Off, the scheme may be another one: it is for sweeps that are asked for.
  for (const RelaxationScheme scheme : {RelaxationScheme::mean, RelaxationScheme::link}) {
    auto simulation = grid_simulation();
    carry_out(simulation, commands::SetRelaxation{true, 1, RelaxationScheme::mean});
    drag_by(simulation, 0, Point(-2, -1, 0));
    QVERIFY(simulation.continue_relaxation());
    carry_out(simulation, commands::SetRelaxation{false, 1, scheme});
    QVERIFY(!simulation.statistics().relaxing);
    const auto before = positions_of(simulation);
    QVERIFY(!simulation.continue_relaxation());
    drag_by(simulation, 0, Point(0, 0, 0));
    QVERIFY(!simulation.continue_relaxation());
    QVERIFY(same_bits(before, positions_of(simulation)));
  }
}

void SimulationTest::a_cut_under_tension_is_felt() {
  // After the cut, the other two return to their rest length.
  Simulation simulation(make_mesh(MeshKind::line, {3, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 2, 0}, {{0, {1, 1, 0}}}}});
  drag_by(simulation, 0, Point(-2, 0, 0));
  QCOMPARE(positions_of(simulation), (std::vector<double>{-2, -1, 1}));
  carry_out(simulation, commands::SetRelaxation{true, 1});
  carry_out(simulation, commands::Cut{{0}});
  QVERIFY(comes_to_rest(simulation));
  QCOMPARE(positions_of(simulation)[0], -2.0);
  QVERIFY(std::abs(positions_of(simulation)[2] - positions_of(simulation)[1] - 1) < 1e-3);
}

void SimulationTest::sweeps_at_once_need_no_switch() {
  Simulation simulation(make_mesh(MeshKind::line, {3, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 1.5, 0}, {}}});
  drag_by(simulation, 0, Point(-2, 0, 0));
  QCOMPARE(positions_of(simulation), (std::vector<double>{-2, -0.5, 1}));
  // 1 moves to the mean of −2 + 1 and 1 − 1, which is where it is. 2 moves to −0.5 + 1. Then 1 moves to −0.75, 2 to
  // 0.25.
  simulation.relax(2, {1, simulation.relaxation().scheme});
  QCOMPARE(positions_of(simulation), (std::vector<double>{-2, -0.75, 0.25}));
  QVERIFY(!simulation.statistics().relaxing);
}

/// Sweeps run in slices, and they can be cancelled between slices.
void SimulationTest::sweeps_of_a_large_mesh_are_those_of_its_solver() {
  const auto mesh = make_mesh(MeshKind::grid, {250, 200, 1});
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  drag_by(simulation, 0, Point(-90, -70, 0));
  solver->move(0, mesh->rest_position(0) + Point(-90, -70, 0));
  carry_out(simulation, commands::SetRelaxation{true, 0.5, RelaxationScheme::mean});  // wakes all
  solver->wake_all();
  simulation.relax(3, {0.5, simulation.relaxation().scheme});
  for (int i = 0; i < 3; ++i) {
    solver->relax_slice(0.5, std::numeric_limits<std::uint64_t>::max(), std::array{ElementId{0}});
  }
  QVERIFY(same_bits(positions_of(simulation), positions_of(*solver, *mesh)));
}

void SimulationTest::sweeps_are_given_up_in_the_middle_of_one() {
  const auto mesh = make_mesh(MeshKind::grid, {250, 200, 1});
  const Progress job = Progress::watched();
  Simulation given_up(mesh, Algorithm::natural_queue, Precision::double_precision);
  Simulation never(mesh, Algorithm::natural_queue, Precision::double_precision);
  given_up.set_progress(job);
  for (Simulation* one : {&given_up, &never}) {
    carry_out(*one, commands::SetRelaxation{false, 1, RelaxationScheme::link});
    carry_out(*one, commands::KeepState{1});
    drag_by(*one, 0, Point(-90, -70, 0));
  }
  job.cancel();
  const commands::Relax sweeps{1'000'000, 1, RelaxationScheme::mean};
  QVERIFY_THROWS_EXCEPTION(Cancelled, carry_out(given_up, sweeps));
  job.cancel(false);
  // It continues as if the cancelled sweeps had never been: with its own scheme, and without active elements from
  // before.
  for (Simulation* one : {&given_up, &never}) {
    carry_out(*one, commands::RestoreState{1});
    drag_by(*one, 0, Point(-9, -7, 0));
    one->relax(2, {});
  }
  QVERIFY(same_bits(positions_of(given_up), positions_of(never)));
}

void SimulationTest::statistics_say_what_happened() {
  auto simulation = grid_simulation();
  QVERIFY(!simulation.is_measured());
  QVERIFY(simulation.measure() && simulation.is_measured());
  QCOMPARE(simulation.statistics().violation.links, std::uint64_t{simulation.mesh().link_count()});
  drag_by(simulation, 0, Point(0.05, 0, 0));
  QVERIFY(!simulation.is_measured());
  QVERIFY(simulation.measure());
  QCOMPARE(simulation.statistics().violation.links, std::uint64_t{simulation.mesh().link_count()});
  QCOMPARE(simulation.statistics().last_second.passes, 1);
  QVERIFY(simulation.statistics().last_pass_ms >= 0);
  // Whatever changes what is violated is measured again.
  const std::vector<Command> changes{commands::SetSoftness{std::make_shared<Softness>(Softness{{1, 1, 0}, {}})},
                                     commands::Cut{{0}},
                                     commands::KeepState{1},
                                     commands::Uncut{{0}},
                                     commands::Reset{},
                                     commands::RestoreState{1}};
  for (const Command& change : changes) {
    simulation.apply(change);
    QCOMPARE(simulation.is_measured(), std::holds_alternative<commands::KeepState>(change));
    simulation.measure_all();
    QVERIFY(simulation.statistics().violation == measure_violation(simulation.mesh(), simulation.softness(),
                                                                   simulation.body().cuts(),
                                                                   simulation.body().positions()));
  }
}

/// While dragging and at rest, the figures are of the same links: all.
void SimulationTest::large_objects_are_measured_in_slices() {
  Simulation simulation(make_mesh(MeshKind::grid, {300, 300, 1}), Algorithm::generalized, Precision::single_precision);
  QVERIFY(!simulation.measure());  // more than one slice is needed
  QVERIFY(simulation.statistics().violation.links > 0);
  drag_by(simulation, 0, Point(2, 9, 0));
  int slices = 1;
  for (; !simulation.measure(); ++slices) {
    QVERIFY(!simulation.is_measured());
  }
  QVERIFY(slices >= 2);
  QVERIFY(simulation.is_measured());
  // Of the current positions, without results from before the command.
  QVERIFY(simulation.statistics().violation == measure_violation(simulation.mesh(), simulation.softness(),
                                                                 simulation.body().cuts(),
                                                                 simulation.body().positions()));
}

void SimulationTest::valid_is_what_the_whole_mesh_says() {
  Simulation simulation(sphere(12, 6), Algorithm::generalized, Precision::double_precision);
  QVERIFY(simulation.valid());
  drag_by(simulation, 0, Point(0, 0, 9));
  simulation.measure_all();
  QVERIFY(simulation.statistics().violation.fraction > 0);  // a known property of Generalized
  QVERIFY(!simulation.valid());
  carry_out(simulation, commands::Reset{});
  QVERIFY(simulation.valid());
}

void SimulationTest::after_a_reset_sweeps_repeat_to_the_bit() {
  const MeshPointer mesh = generate({MeshKind::tetra, {4, 6, 4}});
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
  const ElementId last = mesh->element_count() - 1;
  const auto drag = [&] {
    carry_out(simulation, commands::Grab{{last}});
    for (const double share : {1.0, 2.0}) {
      carry_out(simulation, commands::Drag{mesh->rest_position(last) + share * Point(0.5, 0.3, 0.2)});
      carry_out(simulation, commands::Relax{5});
    }
    carry_out(simulation, commands::Release{});
    std::vector<double> positions(mesh->rest.size());
    simulation.body().copy_positions(positions);
    return positions;
  };
  const std::vector<double> first = drag();
  QVERIFY(first != mesh->rest);
  for (int i = 0; i < 3; ++i) {
    carry_out(simulation, commands::Reset{});
    QVERIFY(drag() == first);
  }
}

void SimulationTest::exact_takes_over_at_once() {
  Simulation simulation(sphere(16, 8), Algorithm::generalized, Precision::single_precision);
  drag_by(simulation, 0, Point(0, 0, 6));
  simulation.measure_all();
  QVERIFY(simulation.statistics().violation.max > 0.1);
  carry_out(simulation, commands::SetAlgorithm{Algorithm::exact});
  simulation.measure_all();
  QVERIFY(simulation.statistics().violation.max < 1e-4);
  QCOMPARE(simulation.statistics().passes, std::uint64_t{2});
}

void SimulationTest::what_passes_did_goes_with_them() {
  // After a change of algorithm, a reset or an undo, the figures of an older pass must not remain.
  const std::vector<Command> changes{commands::SetAlgorithm{Algorithm::spiral}, commands::Reset{},
                                     commands::RestoreState{1}};
  for (const Command& change : changes) {
    Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, Precision::double_precision);
    carry_out(simulation, commands::KeepState{1});
    carry_out(simulation, commands::Pin{{0}});
    drag_by(simulation, 11, Point(50, 0, 0));
    QVERIFY(simulation.statistics().last_pass.stopped && simulation.statistics().last_pass.moved > 0);
    simulation.measure();
    QCOMPARE(simulation.statistics().last_second.passes, 1);
    simulation.apply(change);
    QVERIFY(!simulation.statistics().last_pass.stopped);
    QCOMPARE(simulation.statistics().last_pass.moved, std::uint64_t{0});
    QCOMPARE(simulation.statistics().last_pass_ms, 0.0);
    QCOMPARE(simulation.statistics().last_second.passes, 0);
  }
}

CHAINMAIL_TEST(SimulationTest)

}  // namespace chainmail::test_simulation

#include "test_simulation.moc"
