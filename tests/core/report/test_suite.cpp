#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "program.h"
#include "report/run/beam.h"
#include "report/run/contest.h"
#include "report/run/drag_reference.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"
#include "report/run/suite.h"
#include "report/run/suite_experiments.h"
#include "report/table/format.h"
#include "report/table/summary.h"

namespace chainmail::test_suite {

using namespace chainmail::report;
using namespace chainmail::report::figures;

namespace {

/// A bar whose end section is turned about its axis.
Case twisted_bar(double degrees) {
  Case object;
  object.name = "bar";
  object.mesh = generate({MeshKind::tetra, {6, 3, 3}});
  object.pins = layer(*object.mesh, *find_side("left"));
  object.drags = {{"twist", "", {commands::Grab{layer(*object.mesh, *find_side("right"))}}}};
  object.drags.front().commands.emplace_back(commands::Drag{Point::Zero(), {Point::UnitX(), degrees}, true});
  return object;
}

/// Drags of the right side of an object by some distances along its axis.
std::vector<Command> pull_by(const Case& object, const std::vector<double>& distances) {
  std::vector<Command> commands{commands::Grab{grabbed_by(object.drags.front())}};
  for (const double x : distances) {
    commands.emplace_back(commands::Drag{{x, 0, 0}, {}, true});
  }
  return commands;
}

/// Returns the rows of contestants in a drag, compared with finite elements on the same cells.
std::vector<Row> rows_of_contest(const Case& object, const std::vector<Contestant>& contestants,
                                 const RecordedMoves& drag, const ContestOptions& options) {
  const auto reference = DragReferences(object, std::nullopt).at_end(drag);
  PhysicsReferee referee(reference.solution);
  return Contest(object, contestants, options).run(drag, &referee, {});
}

/// A part of a suite with a row for each experiment, whose error tells which it is.
Results part(const std::vector<std::string>& names, double first_error = 0) {
  Results suite{.kind = ReportKind::suite, .runs = {{{}, "1/1", names}}};
  for (const std::string& name : names) {
    Row row{.object = suite.objects.size(), .drag = 0, .contestant = {Algorithm::exact}};
    row.set(relative, first_error + double(suite.objects.size()));
    suite.rows.push_back(std::move(row));
    suite.objects.push_back({.name = name, .drags = {{.name = "pull"}}});
  }
  return suite;
}

}  // namespace

/// Tests the suite of experiments: its closed forms, its references, its figures, and how parts are joined.
class SuiteTest : public QObject {
  Q_OBJECT

 private slots:
  void timoshenko_meets_both_ends();
  void timoshenko_balances_its_forces();
  void a_slender_beam_bends_as_euler_says();
  void linear_fem_has_its_theoretical_order();
  void linear_fem_meets_the_beam();
  void a_handle_that_turns_has_a_reference();
  void limited_iterations_count_unlimited_ones_must_converge();
  void iterations_end_at_the_own_limit_data();
  void iterations_end_at_the_own_limit();
  void experiments_have_the_handles_that_they_say();
  void the_coarse_organ_has_a_reference_of_three_levels();
  void bars_for_fronts_have_the_size_that_they_say();
  void long_experiments_run_only_where_they_are_named();
  void times_grow_with_the_accuracy();
  void a_fresh_move_is_timed_with_its_grab();
  void a_curve_has_the_error_of_each_drag();
  void parts_have_every_experiment_once();
  void parts_are_joined_in_the_order_of_experiments();
  void an_experiment_twice_is_refused();
};

void SuiteTest::timoshenko_meets_both_ends() {
  const Beam beam{10, 2, {1, 0, 0}, 0.3};
  for (const double across : {-1.0, 0.0, 1.0}) {
    QVERIFY(timoshenko(beam, 0.5, {1, 0, across}).norm() < 1e-12);
    QVERIFY((timoshenko(beam, 0.5, {11, 0, across}) - Point(0, 0, 0.5)).norm() < 1e-12);
  }
}

/// Along the beam the shear strain w' - φ is constant, and the moment E I φ' falls linearly: its slope is the shear
/// force.
void SuiteTest::timoshenko_balances_its_forces() {
  const Beam beam{8, 1, Point::Zero(), 0.25};
  const double step = 1e-4, shear_modulus = 1 / (2 * 1.25), inertia = 1.0 / 12, coefficient = 10 * 1.25 / (12 + 2.75);
  const auto deflection = [&](double x) { return timoshenko(beam, 1, {x, 0, 0}).z(); };
  const auto turn = [&](double x) { return -timoshenko(beam, 1, {x, 0, 1}).x(); };
  for (const double x : {1.0, 3.0, 6.5}) {
    const double slope = (deflection(x + step) - deflection(x - step)) / (2 * step);
    const double force = coefficient * shear_modulus * (slope - turn(x));
    const double moment_falls = -inertia * (turn(x + step) - 2 * turn(x) + turn(x - step)) / (step * step);
    QVERIFY2(std::abs(force - moment_falls) < 1e-5 * force, qPrintable(QString::number(force / moment_falls)));
  }
}

void SuiteTest::a_slender_beam_bends_as_euler_says() {
  const double length = 1000;
  const Beam beam{length, 1, Point::Zero(), 0.3};
  for (const double x : {200.0, 500.0, 800.0}) {
    const double euler = 3 * std::pow(x / length, 2) - 2 * std::pow(x / length, 3);
    QVERIFY(std::abs(timoshenko(beam, 1, {x, 0, 0}).z() - euler) < 1e-5);
  }
}

void SuiteTest::linear_fem_has_its_theoretical_order() {
  SuiteOptions options;
  options.algorithms = {Algorithm::linear_fem, Algorithm::natural_queue};
  const Results suite = run_suite({"refinement"}, options);
  const auto fem = points_of(suite, "refinement", {Algorithm::linear_fem});
  QCOMPARE(fem.size(), std::size_t(4));
  const double observed = order_of(fem).value();
  QVERIFY2(std::abs(observed - 2) < 0.1, qPrintable(QString::number(observed)));
  QVERIFY(fem.back().figures.row[relative].value() < 1e-4);
  // No figure of the mesh makes a pass of ChainMail come closer.
  QVERIFY(std::abs(order_of(points_of(suite, "refinement", {Algorithm::natural_queue})).value()) < 0.1);
}

void SuiteTest::linear_fem_meets_the_beam() {
  SuiteOptions options;
  options.algorithms = {Algorithm::linear_fem, Algorithm::exact};
  options.repetitions = 1;
  const Results suite = run_suite({"cantilever"}, options);
  QCOMPARE(suite.objects.front().reference, std::string("closed form"));
  const auto row_of = [&](const Contestant& contestant) { return joined(suite, 0, contestant, Drags::all).row; };
  const Row nothing = row_of({}), fem = row_of({Algorithm::linear_fem}), exact = row_of({Algorithm::exact});
  QVERIFY(std::abs(nothing[relative].value() - 1) < 1e-12 && std::abs(nothing[relative_turned].value() - 1) < 1e-12);
  QVERIFY2(fem[relative].value() < 0.01, qPrintable(QString::number(*fem[relative])));
  QVERIFY(std::abs(*fem[relative] - fem[relative_turned].value()) < 1e-5);
  QVERIFY(fem[factorize_ms].value() > 0 && fem[grab_ms].value() > 0 && fem[later_ms].value() > 0 && !fem[after_cut_ms]);
  QVERIFY(exact[violation_max].value() < 1e-4 && exact[factorize_ms].value() >= 0 && exact[grab_ms].value() >= 0);
}

void SuiteTest::a_handle_that_turns_has_a_reference() {
  const double degrees = 40;
  const Case object = twisted_bar(degrees);
  const Mesh& mesh = *object.mesh;
  const auto coarse = DragReferences(object, std::nullopt).at_end(object.drags.front());
  ConvergingOptions options;
  options.max_levels = 2;
  const auto fine = DragReferences(object, options).at_end(object.drags.front());
  QCOMPARE(fine.refined->levels.size(), std::size_t(2));
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Point::UnitX()));
  for (const ElementId element : grabbed_by(object.drags.front())) {
    const Point rest = mesh.rest_position(element), middle(rest.x(), 1, 1);
    const Point expected = middle + turn * (rest - middle) - rest;
    for (const auto* solution : {&coarse.solution, &fine.solution}) {
      const Point found = mesh.to_point(solution->displacements.data() + element * 3);
      QVERIFY((found - expected).norm() < 1e-9);
    }
  }
  // The first level is the answer on the object's own cells, which the refinement changes by its `change`.
  double apart = 0, all = 0;
  for (std::size_t i = 0; i < coarse.solution.displacements.size(); ++i) {
    apart += std::pow(fine.solution.displacements[i] - coarse.solution.displacements[i], 2);
    all += std::pow(fine.solution.displacements[i], 2);
  }
  QVERIFY(std::abs(std::sqrt(apart / all) - fine.refined->levels[1].change.value()) < 1e-6);
}

void SuiteTest::limited_iterations_count_unlimited_ones_must_converge() {
  Case object = twisted_bar(20);
  object.elastic.iterations = 2;
  const Contestant free{Algorithm::xpbd}, limited{.algorithm = Algorithm::xpbd, .limit = 2};
  ContestOptions options;
  options.only_errors = true;
  const auto rows = rows_of_contest(object, {free, limited}, object.drags.front(), options);
  QVERIFY(!rows[0].has_figures() && rows[0].refusal.find("did not converge") != std::string::npos);
  QVERIFY(rows[1].has_figures() && rows[1].refusal.empty());
  QCOMPARE(label(limited), std::string("XPBD, 2 iterations"));
}

void SuiteTest::iterations_end_at_the_own_limit_data() {
  QTest::addColumn<Contestant>("contestant");
  for (const Algorithm algorithm : {Algorithm::xpbd, Algorithm::projective, Algorithm::corotational}) {
    QTest::newRow(std::string(info(algorithm).name).c_str()) << Contestant{algorithm};
  }
  QTest::newRow("material") << Contestant{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true};
}

/// Each number of iterations per move runs alone here. The contest takes the least one whose answer is within the share
/// of the converged one.
void SuiteTest::iterations_end_at_the_own_limit() {
  QFETCH(const Contestant, contestant);
  Case object = twisted_bar(40);
  object.softness = softness_of(contestant, object.softness);
  const RecordedMoves& drag = object.drags.front();
  ContestOptions options;
  const auto ends_with = [&](int iterations) {
    Case limited = object;
    limited.elastic.iterations = std::uint32_t(iterations);
    Relaxing relaxing(0, contestant.equilibrium, iterations);
    relaxing.until = 1e-6;
    Runner runner(limited, *contestant.algorithm, Precision::double_precision, options);
    runner.run(drag, relaxing, Progress());
    std::vector<Point> ends;
    for (ElementId e = 0; e < object.mesh->element_count(); ++e) {
      const PositionView at = runner.simulation().body().positions();
      ends.emplace_back(at(e, 0), at(e, 1), at(e, 2));
    }
    return ends;
  };
  const auto converged = ends_with(2000);
  const auto apart_at = [&](int iterations) {
    const auto ends = ends_with(iterations);
    double apart = 0, way = 0;
    const auto held = grabbed_by(drag);
    for (ElementId e = 0; e < ends.size(); ++e) {
      if (std::ranges::count(held, e) + std::ranges::count(object.pins, e) == 0) {
        apart += (ends[e] - converged[e]).squaredNorm();
        way += (converged[e] - object.mesh->rest_position(e)).squaredNorm();
      }
    }
    return std::sqrt(apart / way);
  };
  options.own_limit = 0.01;
  options.repetitions = 1;
  const Row row = rows_of_contest(object, {contestant}, drag, options).at(0);
  QVERIFY2(row.has_figures(), row.refusal.c_str());
  const auto limits = limits_of(contestant);
  const auto chosen = std::ranges::find(limits, int(row[iterations].value()));
  QVERIFY2(apart_at(*chosen) <= 0.0101, qPrintable(QString::number(apart_at(*chosen))));
  QVERIFY(chosen == limits.begin() || apart_at(*(chosen - 1)) > 0.0099);
}

void SuiteTest::experiments_have_the_handles_that_they_say() {
  const MeshPointer organ = generate({MeshKind::tetra, {6, 4, 4}});
  int counted = 0;
  for (const SuiteExperiment& one : suite_experiments()) {
    const auto says = [&](std::string_view words) { return one.description.find(words) != std::string_view::npos; };
    if (const std::size_t said = says("one handle") ? 1 : says("three handles") ? 3 : 0; said > 0) {
      const std::vector<Case> cases = one.cases({organ, organ});
      QCOMPARE(cases.size(), std::size_t{1});
      QVERIFY2(handles_of(cases.front()).size() == said, std::string(one.name).c_str());
      ++counted;
    }
  }
  QVERIFY(counted > 0);
}

/// Neo-Hookean FEM on the object's own cells is what this reference starts from, so its error is that of these cells.
/// It is the sum of the changes up to the last level, and more than the last one alone.
void SuiteTest::the_coarse_organ_has_a_reference_of_three_levels() {
  SuiteOptions options;
  options.algorithms = {Algorithm::neo_hookean, Algorithm::natural_queue};
  options.repetitions = 1;
  options.organs.coarse = generate({MeshKind::tetra, {5, 4, 4}});
  const Results suite = run_suite({"organ-coarse"}, options);
  QVERIFY(suite.objects[0].drags.size() >= 4 && !suite.rows.empty());
  for (const Row& row : suite.rows) {
    const DragInfo& drag = *suite.drag_of(row);
    const auto& levels = drag.reference.value().levels;
    QCOMPARE(levels.size(), std::size_t{3});
    QVERIFY(levels[2].change.value() < levels[1].change.value());
    QVERIFY(!row[relative] || row[reference_change] == levels.back().change);
    if (row.contestant.algorithm == Algorithm::neo_hookean) {
      QVERIFY2(row[relative] > *levels[2].change && row[relative] < 2 * (*levels[1].change + *levels[2].change),
               drag.name.c_str());
    }
  }
}

/// A cube of a block is six tetrahedra.
void SuiteTest::bars_for_fronts_have_the_size_that_they_say() {
  const auto all = suite_experiments();
  for (const auto& [name, tetrahedra] : {std::pair{"fronts-2k", 3 * 5 * 5 * 5 * 6},
                                         {"fronts-10k", 3 * 8 * 8 * 8 * 6},
                                         {"fronts-50k", 3 * 14 * 14 * 14 * 6}}) {
    const SuiteExperiment& one = *std::ranges::find(all, name, &SuiteExperiment::name);
    QVERIFY(one.description.find(thousands(std::uint64_t(tetrahedra))) != std::string_view::npos);
    const Case object = one.cases({}).front();
    QCOMPARE(object.mesh->tetrahedra.size(), std::size_t(tetrahedra));
    QCOMPARE(object.drags.size(), std::size_t{3});
    const RecordedMoves &bend = object.drags[0], &fresh = object.drags[1], &cut = object.drags[2];
    QCOMPARE(count_moves(bend), 6);
    QCOMPARE(count_moves(fresh), 1);
    QCOMPARE(grabbed_by(fresh), grabbed_by(bend));
    QVERIFY(cuts_of(bend).empty() && !cuts_of(cut).empty() &&
            std::holds_alternative<commands::Drag>(cut.commands.back()));
    QCOMPARE(count_moves(cut), 7);
    // The bend ends where that of the bar does, 20 % of the length across.
    const Point way = std::get<commands::Drag>(bend.commands.back()).target;
    QCOMPARE(std::get<commands::Drag>(fresh.commands.back()).target, way);
    const auto [low, high] = bounds(*object.mesh);
    QVERIFY(std::abs(way.norm() - 0.2 * (high - low).maxCoeff()) < 1e-9);
    // No limit of a method refuses its reference.
    const DragReferences references(object, reference_of(one));
    const ConvergingReference converging(reference_problem(object), reference_of(one));
  }
}

void SuiteTest::long_experiments_run_only_where_they_are_named() {
  const auto usual = suite_names(), all = all_suite_names(), missing = missing_from(part({"bar"}));
  for (const SuiteExperiment& one : suite_experiments()) {
    QVERIFY(std::ranges::count(all, one.name) == 1);
    QCOMPARE(std::ranges::count(usual, one.name) == 1, !one.only_named);
    QCOMPARE(std::ranges::count(missing, one.name) == 1, !one.only_named && one.name != "bar");
  }
  QVERIFY(usual.size() < all.size());
}

void SuiteTest::times_grow_with_the_accuracy() {
  SuiteOptions options;
  options.algorithms = {Algorithm::exact, Algorithm::linear_fem, Algorithm::boundary_elements};
  options.repetitions = 1;
  const Results suite = run_suite({"time-sheet"}, options);
  QVERIFY(has_curves(suite, 0));
  const auto speeds = speeds_against_error();
  const auto later = standings(suite, 0, speeds[0]), fresh = standings(suite, 0, speeds[1]);
  const Contestant fem{Algorithm::linear_fem}, equilibrium{Algorithm::exact, 0, true};
  const auto ms_of = [&](const std::vector<Standing>& all) {
    return std::ranges::find(all, fem, &Standing::contestant)->ms.value().median;
  };
  QVERIFY(least_error(later, fem).value() < 0.1 && ms_of(fresh) > ms_of(later));
  QVERIFY(joined(suite, 0, fem, Drags::all).row[factorize_ms].value() > 0);
  QVERIFY(standings(suite, 0, speeds[2]).empty());  // no drag has a cut
  for (const double error : errors_reached) {
    QCOMPARE(shortest_ms(later, fem, error), std::optional(ms_of(later)));
    QCOMPARE(shortest_ms(later, equilibrium, error).has_value(), least_error(later, equilibrium).value() <= error);
  }
  std::vector<int> limits, of_fem;
  for (const Contestant& one : contestants_in(suite, std::size_t{0})) {
    if (curve_of(one) == equilibrium) {
      limits.push_back(one.limit);
    } else if (curve_of(one) == fem) {
      of_fem.push_back(one.limit);
    }
  }
  QCOMPARE(limits, (std::vector<int>{1, 2, 5, 10, 20, 50, 100, 200}));
  QCOMPARE(of_fem, std::vector<int>{0});  // it has no iterations to choose
  const Joined bem = joined(suite, 0, {Algorithm::boundary_elements}, Drags::all);
  QVERIFY(bem.of == 2 && bem.drags == 0 && !bem.row.refusal.empty());  // a sheet has no surface mesh
}

/// A user who takes hold of an object waits for both. On these clocks a grab takes 1000 seconds, and so does
/// relaxation. A move takes what its pass takes, because the time of a pass comes from the machine.
void SuiteTest::a_fresh_move_is_timed_with_its_grab() {
  Case object = twisted_bar(0);
  const RecordedMoves one_move{"pull", "", pull_by(object, {0.1})}, drag{"pull", "", pull_by(object, {0.05, 0.1})};
  object.drags = {drag, one_move};
  double now = 0;
  const auto tick = [&now] { return now += 1000; };
  ContestOptions options;
  options.clocks = {tick, tick};
  const Contestant fem{Algorithm::linear_fem},
      material{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true, .limit = 1};
  const auto later = rows_of_contest(object, {fem, material}, drag, options),
             fresh = rows_of_contest(object, {fem, material}, one_move, options);
  constexpr double tick_ms = 1e6, longest_pass_ms = 1e5;
  for (const std::size_t i : {0, 1}) {
    const double relaxing = i == 0 ? 0 : tick_ms;
    QVERIFY(std::abs(fresh[i][fresh_ms].value() - (tick_ms + relaxing)) < longest_pass_ms);
    QVERIFY(std::abs(later[i][later_ms].value() - relaxing) < longest_pass_ms);
    QVERIFY(!fresh[i][later_ms]);  // it has no later move
  }
}

/// A curve goes through the drag, the fresh grab and the cut; each has its own error and time.
void SuiteTest::a_curve_has_the_error_of_each_drag() {
  Case object = twisted_bar(0);
  RecordedMoves drag{"pull", "", pull_by(object, {0.5, 1})}, one_move{"pull", "", pull_by(object, {1})},
      with_cut = drag;
  with_cut.commands.insert(with_cut.commands.end() - 1, commands::Cut{{0, 1, 2}});
  object.drags = {drag, one_move, with_cut};
  const Contestant once{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true, .limit = 1};
  Contestant often = once;
  often.limit = 200;
  ContestOptions options;
  options.repetitions = 1;
  std::vector<double> errors;
  for (const auto& [moves, time] : {std::pair(&drag, &later_ms), {&one_move, &fresh_ms}, {&with_cut, &after_cut_ms}}) {
    const auto rows = rows_of_contest(object, {once, often}, *moves, options);
    // The reference has the same energy on the same cells, so the error ends where relaxation does.
    QVERIFY(rows[1][relative].value() < compared_residual && rows[0][relative].value() > 0.02);
    QVERIFY(rows[1][*time].value() > 0);
    errors.push_back(*rows[0][relative]);
  }
  QVERIFY(errors[0] < errors[1]);  // it had one iteration for half of the way
  QVERIFY(errors[2] != errors[0]);
}

void SuiteTest::parts_have_every_experiment_once() {
  for (int count = 1; count <= 20; ++count) {
    std::multiset<std::string> all;
    for (int index = 1; index <= count; ++index) {
      const auto names = part_of(suite_names(), {index, count});
      all.insert(names.begin(), names.end());
    }
    const auto names = suite_names();
    QVERIFY(all == std::multiset<std::string>(names.begin(), names.end()));
  }
}

/// Rows go with their objects, and all sizes of a refinement are one experiment.
void SuiteTest::parts_are_joined_in_the_order_of_experiments() {
  Results sizes = part({"coarse", "fine"}, 20);
  sizes.objects[0].series = sizes.objects[1].series = "refinement";
  const Results all = merged({part({"fronts-2k"}, 10), sizes, part({"sheet", "bar"})});
  QCOMPARE(all.runs.size(), std::size_t{3});
  const std::vector<std::pair<std::string, double>> expected{
      {"bar", 1}, {"sheet", 0}, {"coarse", 20}, {"fine", 21}, {"fronts-2k", 10}};
  QCOMPARE(all.objects.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    QCOMPARE(all.objects[i].name, expected[i].first);
    QVERIFY(all.rows[i].object == i && all.rows[i][relative] == expected[i].second);
  }
  QCOMPARE(std::ranges::count(missing_from(all), "refinement"), 0);
}

void SuiteTest::an_experiment_twice_is_refused() {
  try {
    merged({part({"sheet", "bar"}), part({"bar"})});
    QFAIL("not refused");
  } catch (const Error& error) {
    QCOMPARE(error.where(), std::string("bar"));
  }
}

CHAINMAIL_TEST(SuiteTest)

}  // namespace chainmail::test_suite

#include "test_suite.moc"
