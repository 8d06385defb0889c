#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "program.h"
#include "report/page/suite_table.h"
#include "report/run/beam.h"
#include "report/run/contest.h"
#include "report/run/drag_reference.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"
#include "report/run/suite.h"
#include "report/run/suite_experiments.h"
#include "report/run/time_to_error.h"

namespace chainmail::test_suite {

using namespace chainmail::report;

namespace {

const SuiteRow& row_of(const Suite& suite, std::string_view algorithm) {
  return *std::ranges::find(suite.results.front().rows, algorithm, &SuiteRow::algorithm);
}

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

Suite part(std::vector<std::string> names) {
  Suite suite;
  suite.runs = {{{}, "1/1", names}};
  for (const std::string& name : names) {
    suite.results.push_back({name, "", "", {}, 0, 0, 0, 0, {}, {}, {}, {}});
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
  void an_experiment_twice_is_refused();
  void means_leave_out_the_cut();
  void the_front_has_whom_no_one_beats();
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
  const Suite suite = run_suite({"refinement"}, options);
  const auto& orders = suite.results.front().orders;
  const auto fem = std::ranges::find(orders, "fem", &SuiteOrder::algorithm);
  QCOMPARE(fem->sizes.size(), std::size_t(4));
  QVERIFY2(std::abs(fem->order.value() - 2) < 0.1, qPrintable(QString::number(*fem->order)));
  QVERIFY(fem->sizes.back().relative < 1e-4);
  const auto chainmail = std::ranges::find(orders, "natural-queue", &SuiteOrder::algorithm);
  QVERIFY(std::abs(chainmail->order.value()) < 0.1);  // no figure of the mesh makes a pass come closer
}

void SuiteTest::linear_fem_meets_the_beam() {
  SuiteOptions options;
  options.algorithms = {Algorithm::linear_fem, Algorithm::exact};
  options.repetitions = 1;
  const Suite suite = run_suite({"cantilever"}, options);
  QCOMPARE(suite.results.front().reference, std::string("closed form"));
  const SuiteRow& nothing = row_of(suite, "nothing");
  QVERIFY(std::abs(nothing.relative.value() - 1) < 1e-12 && std::abs(nothing.relative_turned.value() - 1) < 1e-12);
  const SuiteRow& fem = row_of(suite, "fem");
  QVERIFY2(fem.relative.value() < 0.01, qPrintable(QString::number(*fem.relative)));
  QVERIFY(std::abs(*fem.relative - fem.relative_turned.value()) < 1e-5);
  QVERIFY(fem.factorize_ms.value() > 0 && fem.grab_ms.value() > 0 && fem.later_ms.value() > 0 && !fem.after_cut_ms);
  const SuiteRow& exact = row_of(suite, "exact");
  QVERIFY(exact.violation.value() < 1e-4 && exact.factorize_ms.value() >= 0 && exact.grab_ms.value() >= 0);
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
  PhysicsContestant free{Algorithm::xpbd}, limited{Algorithm::xpbd};
  limited.limit = 2;
  CompareOptions options;
  Contest contest(object, {free, limited}, options, Measured::errors);
  const auto reference = DragReferences(object, std::nullopt).at_end(object.drags.front());
  const auto entries = contest.run(object.drags.front(), reference.solution, {});
  QVERIFY(!entries[0].measurement && entries[0].refusal.find("did not converge") != std::string::npos);
  QVERIFY(entries[1].measurement && entries[1].refusal.empty());
  QCOMPARE(label(limited), std::string("XPBD, 2 iterations"));
}

void SuiteTest::iterations_end_at_the_own_limit_data() {
  QTest::addColumn<PhysicsContestant>("contestant");
  for (const Algorithm algorithm : {Algorithm::xpbd, Algorithm::projective, Algorithm::corotational}) {
    QTest::newRow(std::string(info(algorithm).name).c_str()) << PhysicsContestant{algorithm};
  }
  QTest::newRow("material") << PhysicsContestant{
      .algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true};
}

/// Each number of iterations per move runs alone here. The contest takes the least one whose answer is within the share
/// of the converged one.
void SuiteTest::iterations_end_at_the_own_limit() {
  QFETCH(const PhysicsContestant, contestant);
  Case object = twisted_bar(40);
  object.softness = softness_of(contestant, object.softness);
  const RecordedMoves& drag = object.drags.front();
  CompareOptions options;
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
  const auto relative = [&](const std::vector<Point>& ends) {
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
  Contest contest(object, {contestant}, options);
  const auto reference = DragReferences(object, std::nullopt).at_end(drag);
  const auto entries = contest.run(drag, reference.solution, {});
  QVERIFY2(entries[0].measurement.has_value(), entries[0].refusal.c_str());
  const auto limits = limits_of(contestant);
  const auto chosen = std::ranges::find(limits, entries[0].measurement->iterations.value());
  QVERIFY2(relative(ends_with(*chosen)) <= 0.0101, qPrintable(QString::number(relative(ends_with(*chosen)))));
  QVERIFY(chosen == limits.begin() || relative(ends_with(*(chosen - 1))) > 0.0099);
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
  const SuiteResult result = run_suite({"organ-coarse"}, options).results.front();
  QVERIFY(result.references.size() >= 4 && !result.rows.empty());
  for (const Convergence& reference : result.references) {
    QCOMPARE(reference.levels.size(), std::size_t{3});
    QVERIFY(reference.levels[2].change.value() < reference.levels[1].change.value());
  }
  std::size_t drag = 0;
  std::string last;
  for (const SuiteRow& row : result.rows) {
    drag += !last.empty() && row.drag != last ? 1 : 0;
    last = row.drag;
    const auto& levels = result.references.at(drag).levels;
    QVERIFY(!row.relative || row.reference_change == levels.back().change);
    if (row.algorithm == "neo-hookean") {
      QVERIFY2(*row.relative > *levels[2].change && *row.relative < 2 * (*levels[1].change + *levels[2].change),
               row.drag.c_str());
    }
  }
  QCOMPARE(drag + 1, result.references.size());
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
  QCOMPARE(merged({part({"fronts-2k"}), part({"bar"})}).results.front().name, std::string("bar"));
}

void SuiteTest::times_grow_with_the_accuracy() {
  SuiteOptions options;
  options.algorithms = {Algorithm::exact, Algorithm::linear_fem, Algorithm::boundary_elements};
  options.repetitions = 1;
  const Suite suite = run_suite({"time-sheet"}, options);
  const auto& times = suite.results.front().times;
  const auto named = [&](const char* name) { return *std::ranges::find(times, name, &SuiteTime::contestant); };
  const SuiteTime fem = named("Linear FEM, on the same cells"), equilibrium = named("Exact + equilibrium");
  QVERIFY(least_error(fem).value() < 0.1 && fem.factorize_ms.value() > 0);
  QCOMPARE(fem.curve.size(), std::size_t(1));  // it has no iterations to choose
  QVERIFY(fem.curve[0].fresh_ms.value() > fem.curve[0].later_ms.value() && !fem.curve[0].after_cut_ms);
  for (const double error : suite_errors) {
    QCOMPARE(shortest_ms(fem, suite_point_figures[0], error), fem.curve[0].later_ms);
    QCOMPARE(shortest_ms(equilibrium, suite_point_figures[0], error).has_value(),
             least_error(equilibrium).value() <= error);
  }
  std::vector<std::uint64_t> iterations;
  std::ranges::transform(equilibrium.curve, std::back_inserter(iterations), &SuitePoint::iterations);
  QCOMPARE(iterations, (std::vector<std::uint64_t>{1, 2, 5, 10, 20, 50, 100, 200}));
  QVERIFY(!named("BEM, on its surface mesh").refusal.empty());
}

/// A user who takes hold of an object waits for both. On these clocks a grab takes 1000 seconds, and so does
/// relaxation. A move takes what its pass takes, because the time of a pass comes from the machine.
void SuiteTest::a_fresh_move_is_timed_with_its_grab() {
  Case object = twisted_bar(0);
  const std::vector<ElementId> side = grabbed_by(object.drags.front());
  const auto drag_by = [](double x) { return commands::Drag{{x, 0, 0}, {}, true}; };
  const RecordedMoves one_move{"pull", "", {commands::Grab{side}, drag_by(0.1)}},
      drag{"pull", "", {commands::Grab{side}, drag_by(0.05), drag_by(0.1)}};
  object.drags = {drag, one_move};
  double now = 0;
  const auto tick = [&now] { return now += 1000; };
  CompareOptions options;
  options.clocks = {tick, tick};
  const auto reference = DragReferences(object, std::nullopt).at_end(drag);
  const PhysicsContestant fem{Algorithm::linear_fem},
      material{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true};
  const std::vector<TimedDrag> drags{{drag, reference.solution}, {one_move, reference.solution}};
  const auto times = times_to_error(object, {fem, material}, drags, options, {});
  constexpr double tick_ms = 1e6, longest_pass_ms = 1e5;
  for (const auto& [time, relaxing] : {std::pair{times[0], 0.0}, std::pair{times[1], tick_ms}}) {
    const double grab_and_move = tick_ms + relaxing;
    const SuitePoint& point = time.curve.at(0);
    QVERIFY(point.fresh_ms.value() > grab_and_move && *point.fresh_ms < grab_and_move + longest_pass_ms);
    QVERIFY(point.later_ms.value() < relaxing + longest_pass_ms);
  }
}

/// A curve goes through the drag, the fresh grab and the cut; each has its own error and time.
void SuiteTest::a_curve_has_the_error_of_each_drag() {
  Case object = twisted_bar(0);
  const std::vector<ElementId> side = grabbed_by(object.drags.front());
  const auto drag_by = [](double x) { return commands::Drag{{x, 0, 0}, {}, true}; };
  const RecordedMoves drag{"pull", "", {commands::Grab{side}, drag_by(0.5), drag_by(1)}},
      one_move{"pull", "", {commands::Grab{side}, drag_by(1)}},
      with_cut{"cut", "", {commands::Grab{side}, drag_by(0.5), commands::Cut{{0, 1, 2}}, drag_by(1)}};
  DragReferences references(object, std::nullopt);
  const ReferenceSolution whole = references.at_end(drag).solution, cut = references.at_end(with_cut).solution;
  const std::vector<TimedDrag> drags{{drag, whole}, {one_move, whole}, {with_cut, cut}};
  const PhysicsContestant material{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true};
  const auto curve = times_to_error(object, {material}, drags, {}, {}).at(0).curve;
  QCOMPARE(curve.size(), limits_of(material).size());
  const SuitePoint &first = curve.front(), &last = curve.back();
  QVERIFY(first.iterations == 1 && last.iterations == 200);
  for (const SuitePointFigures& figures : suite_point_figures) {
    // The reference has the same energy on the same cells, so the error
    // ends where relaxation does.
    QVERIFY((last.*figures.error).value() < compared_residual && (first.*figures.error).value() > 0.02);
    QVERIFY((last.*figures.ms).value() > 0);
  }
  QVERIFY(first.relative.value() < first.fresh_relative.value());  // it had one iteration for half of the way
  QVERIFY(*first.cut_relative != *first.relative);
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

void SuiteTest::an_experiment_twice_is_refused() {
  try {
    merged({part({"sheet", "bar"}), part({"bar"})});
    QFAIL("not refused");
  } catch (const Error& error) {
    QCOMPARE(error.where(), std::string("bar"));
  }
}

void SuiteTest::means_leave_out_the_cut() {
  SuiteResult result;
  SuiteRow row{"pull", 1, false, "Exact ChainMail", "exact", ""};
  row.relative = 0.2;
  row.later_ms = 2;
  result.rows.push_back(row);
  row.relative = 0.4;
  result.rows.push_back(row);
  row.has_cut = true;
  row.relative = 9;
  row.after_cut_ms = 5;
  result.rows.push_back(row);
  result.rows.push_back({"pull", 1, false, "XPBD", "xpbd", "it did not converge"});
  const auto means = means_of(result);
  QCOMPARE(means.size(), std::size_t(2));
  QCOMPARE(means[0].relative.value(), 0.3);
  QCOMPARE(means[0].after_cut_ms.value(), 5.0);
  QVERIFY(means[0].drags == 2 && means[0].of == 2);
  QVERIFY(!means[1].relative && means[1].refusal == "it did not converge");
}

void SuiteTest::the_front_has_whom_no_one_beats() {
  std::vector<SuiteMean> means;
  const auto add = [&](const char* who, const char* algorithm, double ms, double error) {
    SuiteMean& mean = means.emplace_back();
    mean.contestant = who;
    mean.algorithm = algorithm;
    mean.drags = mean.of = 4;
    mean.later_ms = ms;
    mean.relative = error;
  };
  add("slow and close", "fem", 9, 0.1);
  add("beaten in both", "fem", 9, 0.3);
  add("as slow, less close", "fem", 2, 0.25);
  add("middle", "arap", 2, 0.2);
  add("fast", "xpbd", 0.5, 0.9);
  add("slower and as close", "xpbd", 3, 0.2);
  add("the same as the fast one", "bem", 0.5, 0.9);
  add("Nothing moves", "nothing", 0, 1);
  add("of the reference", "neo-hookean", 0.1, 0.01);
  add("all but the hard drag", "fem", 0.1, 0.01);
  means.back().drags = 3;
  add("without a time", "fem", 0, 0.01);
  means.back().later_ms.reset();
  std::vector<std::string> names;
  for (const SuiteMean* one : front(means, speeds_against_error[0])) {
    names.push_back(one->contestant);
  }
  QCOMPARE(names, (std::vector<std::string>{"fast", "the same as the fast one", "middle", "slow and close"}));
  QVERIFY(front(means, speeds_against_error[1]).empty());  // nobody has a time of a fresh grab
}

CHAINMAIL_TEST(SuiteTest)

}  // namespace chainmail::test_suite

#include "test_suite.moc"
