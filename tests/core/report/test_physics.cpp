#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>

#include "core/report/comparisons.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"
#include "report/run/drag_times.h"
#include "report/run/physics.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"
#include "report/table/summary.h"

namespace chainmail::test_physics {

using namespace chainmail::report;
using namespace chainmail::report::figures;
using chainmail::report::test::drag;
using chainmail::report::test::row_of;
using chainmail::test::make_mesh;

/// The comparison with physics: the metric, the contestants, and the report.
class PhysicsTest : public QObject {
  Q_OBJECT

 private slots:
  void errors_by_hand();
  void nothing_moving_on_a_stretched_bar();
  void half_the_way_is_half_the_relative_error();
  void times_of_a_drag_are_split();
  void preparation_is_no_part_of_a_move();
  void a_cut_in_the_middle_is_measured_against_the_same_cut();
  void calibrated_contestants_have_their_softness_and_sweeps();
  void calibrated_contestants_go_to_the_equilibrium();
  void the_reference_solution_knows_nothing_of_the_last_one();
  void everyone_takes_part();
  void the_truth_has_no_error_and_linear_elasticity_less_for_less();
  void drags_are_what_they_say();
  void turned_objects_show_what_depends_on_the_axes();
  void objects_are_named_after_their_laws();
  void what_has_no_answer_is_refused_by_name();
  void objects_grow();
  void a_growing_object_has_its_own_number_of_elements();
  void it_stops_at_once();
  void every_figure_of_physics_is_measured();
};

namespace {

PhysicsOptions quick(std::vector<Algorithm> algorithms, std::vector<int> sweeps) {
  PhysicsOptions options;
  options.algorithms = std::move(algorithms);
  options.sweeps = std::move(sweeps);
  options.precision = Precision::double_precision;
  options.repetitions = 1;
  options.growth_seconds = 0;
  return options;
}

/// The whole report on a tiny bar and a tiny sheet, computed once for all tests.
const Results& everything() {
  static const Results report = [] {
    PhysicsOptions options = quick({}, {0, 1, 10});
    options.growth_seconds = 0.002;
    ElasticOptions elastic;
    elastic.iterations = 300;  // enough for all but both XPBDs, and a fifth of the time
    return compare_with_physics({pinned_bar(48, {}, elastic), pinned_sheet(25, {}, elastic)}, options);
  }();
  return report;
}
constexpr std::size_t bar_and_sheet = 2;  // the first objects of it; those that grow follow

// Error of Newton's method, over the handle's displacement.
constexpr double converged = 1e-6;

}  // namespace

void PhysicsTest::errors_by_hand() {
  // The handle, element 0, moved by 2; the reference solution displaces 1 by 1, 2 by 0.01 and 3 not at all.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const ReferenceSolution reference{{-2, -1, -0.01, 0}, 2, {0}};
  const std::vector<double> at{-2, 0.4, 1.99, 3};
  const PhysicalError error =
      measure_physical_error(*line, PositionView(at.data(), sizeof(double), Precision::double_precision), reference);
  QVERIFY(std::abs(error.max - 0.4 / 2) < 1e-15);
  QVERIFY(std::abs(error.rms - 0.4 / std::sqrt(4.0) / 2) < 1e-15);
  QCOMPARE(error.moving, std::uint64_t{2});  // 0.01 is half a percent of the handle's displacement
  QVERIFY(std::abs(error.moving_rms - 0.4 / std::sqrt(2.0) / 2) < 1e-15);
  QCOMPARE(error.moving_max, error.max);
  QCOMPARE(rms_displacement(*line, reference), std::sqrt((4 + 1 + 0.0001) / 4));
  const ReferenceSolution along_a_diagonal{{3, 4, 3, 4}, 5, {0}};
  QCOMPARE(rms_displacement(*make_mesh(MeshKind::grid, {2, 1, 1}), along_a_diagonal), 5.0);  // not per coordinate
  QVERIFY(std::abs(error.relative - std::sqrt(0.4 * 0.4 / (2 * 2 + 1 * 1 + 0.01 * 0.01))) < 1e-15);
  // An element counts as moving if it moves by at least 1 % of the handle's displacement, here 0.02.
  for (const auto& [by, moving] : {std::pair(0.019, 2), {0.021, 3}}) {
    const ReferenceSolution other{{-2, -1, -by, 0}, 2, {0}};
    QCOMPARE(
        int(measure_physical_error(*line, PositionView(at.data(), sizeof(double), Precision::double_precision), other)
                .moving),
        moving);
  }
}

void PhysicsTest::nothing_moving_on_a_stretched_bar() {
  // A bar without lateral contraction: its left layer is pinned and its right layer moved along the bar. Each layer
  // moves in proportion to its position. Of n layers, the squares of the n - 2 between sum to (n - 2)(n - 1)(2n - 3) /
  // 6, and the squares of all to (n - 1) n (2n - 1) / 6.
  constexpr int n = 8;
  const auto bar = make_mesh(MeshKind::tetra, {n, 3, 3});
  const std::vector<ElementId> left = layer(*bar, *find_side("left")), right = layer(*bar, *find_side("right"));
  const ElementId handle = right.front();
  const Point way(0.5, 0, 0);
  ElasticProblem problem{bar, Cuts(bar), left, {}, {}};
  problem.options.material.poisson = 0;
  problem.pins.insert(problem.pins.end(), right.begin() + 1, right.end());
  std::ranges::sort(problem.pins);
  for (const ElementId pin : problem.pins) {
    const bool moved = std::ranges::find(right, pin) != right.end();
    problem.pinned.insert(problem.pinned.end(), {moved ? way.x() : 0, 0, 0});
  }
  const ReferenceSolution reference = ReferenceSolver(problem).at(handle, bar->rest_position(handle) + way);
  const PhysicalError error = error_of_nothing_moving(*bar, reference);
  QVERIFY(std::abs(error.relative - std::sqrt((n - 2.0) * (2 * n - 3) / (n * (2.0 * n - 1)))) < converged);
  // The error over the handle's displacement, which is the largest: the same sum over n layers.
  QVERIFY(std::abs(error.rms - std::sqrt((n - 2.0) * (2 * n - 3) / (6.0 * n * (n - 1)))) < converged);
  QVERIFY(std::abs(error.max - (n - 2.0) / (n - 1)) < converged);
}

void PhysicsTest::half_the_way_is_half_the_relative_error() {
  const auto sheet = make_mesh(MeshKind::cloth, {5, 4, 1});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  ReferenceSolution reference{std::vector<double>(sheet->rest.size()), 0.7, {}};
  std::ranges::generate(reference.displacements, [&] { return any(random); });
  const auto relative_at = [&](double share) {
    std::vector<double> at = sheet->rest;
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] += share * reference.displacements[i];
    }
    const PositionView positions(at.data(), 2 * sizeof(double), Precision::double_precision);
    return measure_physical_error(*sheet, positions, reference).relative;
  };
  for (const double share : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    QVERIFY(std::abs(relative_at(share) - std::abs(1 - share)) < 1e-12);
  }
}

void PhysicsTest::times_of_a_drag_are_split() {
  const std::vector<double> ms{100, 7, 1, 2, 3, 50};
  const DragTimes elastic = split(ms, true, true);
  QCOMPARE(elastic.preparing, 100.0);
  QCOMPARE(elastic.first, 7.0);
  QCOMPARE(elastic.later, 2.0);
  QCOMPARE(elastic.after_cut, 50.0);
  const DragTimes plain = split(ms, false, false);
  QCOMPARE(plain.preparing, 0.0);
  QCOMPARE(plain.first, 100.0);
  QCOMPARE(plain.later, (7.0 + 1 + 2 + 3 + 50) / 5);
  QCOMPARE(plain.after_cut, 0.0);
  QCOMPARE(split(std::vector{4.0}, false, false).first, 4.0);
}

namespace {

/// Measures a drag with linear FEM, and returns what is wrong with its times; empty if nothing is.
QString fault_of_preparation() {
  // Factorizing for some 2000 elements takes a thousand times as long as a move; a busy machine does not change which
  // of the two a move contains.
  Case bar = pinned_bar(2000, {}, {});
  bar.drags = {bar.drags[1], bar.drags.back()};
  const Results report = compare_with_physics({bar}, quick({Algorithm::linear_fem}, {0}));
  const Row &pull = row_of(report, 0, 0, {Algorithm::linear_fem}), &cut = row_of(report, 0, 1, {Algorithm::linear_fem});
  const double factorize = pull[factorize_ms].value(), grab = pull[grab_ms].value();
  const double repeated_work = cut[after_cut_ms].value(), later_of_cut = cut[later_ms].value();
  // Also in the first run, which prepares everything.
  Runner runner(bar, Algorithm::linear_fem, Precision::double_precision, {});
  const auto moves = with_preparing_move(*bar.mesh, bar.drags[0]);
  const DragTimes cold = split(runner.run(moves, 0, Progress()).ms, true, false);
  const auto is_short = [&](double ms) { return ms > 0 && ms < 0.5 * factorize; };
  const std::array checks{
      std::pair{"both are repeated", pull.find(factorize_ms)->spread.has_value() && pull.find(grab_ms)->spread},
      std::pair{"one move prepares", count_moves(moves) == count_moves(bar.drags[0]) + 1},
      std::pair{"factorizing takes longest", factorize > grab && grab > 0},
      std::pair{"the first run prepares", cold.preparing > 0.5 * (factorize + grab)},
      std::pair{"moves are short", is_short(*pull[first_ms]) && is_short(*pull[later_ms])},
      std::pair{"moves of the first run are short", is_short(cold.first) && is_short(cold.later)},
      // After a cut, a part of it is needed again, in one move: the factors are updated.
      std::pair{"a cut prepares again", repeated_work > 20 * later_of_cut},
      std::pair{"not everything", repeated_work < factorize + grab},
      std::pair{"moves after a cut are short", is_short(later_of_cut)}};
  const auto wrong = std::find_if(checks.begin(), checks.end(), [](const auto& check) { return !check.second; });
  return wrong == checks.end() ? QString()
                               : QStringLiteral("not true: %1; %2 %3 %4 %5")
                                     .arg(wrong->first)
                                     .arg(factorize)
                                     .arg(grab)
                                     .arg(cold.preparing)
                                     .arg(repeated_work);
}

}  // namespace

/// Times that are compared may be taken while other programs run, so three attempts.
void PhysicsTest::preparation_is_no_part_of_a_move() {
  QString fault = fault_of_preparation();
  for (int attempt = 2; attempt <= 3 && !fault.isEmpty(); ++attempt) {
    fault = fault_of_preparation();
  }
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

void PhysicsTest::a_cut_in_the_middle_is_measured_against_the_same_cut() {
  for (std::size_t i = 0; i < bar_and_sheet; ++i) {
    const std::size_t last = everything().objects[i].drags.size() - 1;
    const DragInfo& cut = everything().objects[i].drags[last];
    QCOMPARE(cut.name, std::string("cut, then move"));
    QVERIFY(cut.has_cut && cut.moves == 13);
    QVERIFY(row_of(everything(), i, last, {Algorithm::neo_hookean})[error_max].value() < converged);
    for (const Row* row : rows_of(everything(), i, [&](const Row& one) { return one.drag == last; })) {
      QCOMPARE((*row)[after_cut_ms].value_or(0) > 0, row->has_figures() && row->contestant.algorithm.has_value());
    }
  }
  // The cut matters: without it the object has another shape.
  const Case sheet = pinned_sheet(25, {}, {});
  Case whole = sheet;
  whole.drags = {sheet.drags.back()};
  std::erase_if(whole.drags[0].commands,
                [](const Command& command) { return std::holds_alternative<commands::Cut>(command); });
  const auto target = std::get<commands::Drag>(whole.drags[0].commands.back()).target;
  const ElementId handle = handle_of(whole.drags[0]);
  const auto answer = [&](const std::vector<LinkId>& links) {
    Cuts cuts(sheet.mesh);
    std::ranges::for_each(links, [&](LinkId link) { cuts.cut(link); });
    return ReferenceSolver({sheet.mesh, cuts, sheet.pins, std::vector<double>(2 * sheet.pins.size(), 0.0), {}})
        .at(handle, target);
  };
  const ReferenceSolution uncut = answer({}), cut = answer(cuts_of(sheet.drags.back()));
  std::vector<double> at = sheet.mesh->rest;
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] += uncut.displacements[i];
  }
  const PositionView positions(at.data(), 2 * sizeof(double), Precision::double_precision);
  QVERIFY(measure_physical_error(*sheet.mesh, positions, cut).relative > 0.01);
}

void PhysicsTest::calibrated_contestants_have_their_softness_and_sweeps() {
  const Case sheet = pinned_sheet(25, {}, {});
  const LinkSoftness stiff{0.95, 1.05, 0.02};
  PhysicsOptions options = quick({Algorithm::generalized, Algorithm::exact}, {0, 7});
  std::vector<ElementId> avoided;
  options.calibrate = [&](const Case&, Algorithm algorithm, bool equilibrium, const std::vector<ElementId>& handles,
                          const Progress&) {
    avoided = handles;
    return Calibration{algorithm, equilibrium, stiff, 7, 3, 60, 1.5, {}};
  };
  const Results calibrated = compare_with_physics({sheet}, options);
  QCOMPARE(avoided, physics_handles(sheet));
  QCOMPARE(calibrated.objects[0].notes.size(), std::size_t{1});  // of these two, only Exact is calibrated
  Case stiffer = sheet;
  stiffer.softness = {stiff, {}};
  const Results by_hand = compare_with_physics({stiffer}, quick({Algorithm::exact}, {7}));
  const Contestant usual{Algorithm::exact, 7}, own{Algorithm::exact, 7, false, stiff};
  QCOMPARE(label(own), std::string("Exact ChainMail, calibrated (7 sweeps)"));
  for (std::size_t i = 0; i < sheet.drags.size(); ++i) {
    const Row& row = row_of(calibrated, 0, i, own);
    QVERIFY(row.has_figures() && row[relative] == row_of(by_hand, 0, i, usual)[relative]);
    QVERIFY(row[relative] != row_of(calibrated, 0, i, usual)[relative]);
  }
  options.calibrate = [](const Case&, Algorithm, bool, const auto&, const Progress&) -> Calibration {
    throw Error("object", "it does not converge", "use another");
  };
  const Results refused = compare_with_physics({sheet}, options);
  QCOMPARE(contestants_in(refused, std::size_t{0}).size(), std::size_t{1 + 4});
  QVERIFY(refused.objects[0].notes.at(0).find("does not converge") != std::string::npos);
}

void PhysicsTest::calibrated_contestants_go_to_the_equilibrium() {
  const Case sheet = pinned_sheet(25, {}, {});
  LinkSoftness found{0, 3, 2};
  found.lateral = 0.4;
  PhysicsOptions options = quick({Algorithm::exact}, {});
  options.equilibrium = true;
  options.calibrate = [&](const Case&, Algorithm algorithm, bool equilibrium, const auto&, const Progress&) {
    return Calibration{algorithm, equilibrium, found, 0, 3, 60, 1.5, {}};
  };
  const Results calibrated = compare_with_physics({sheet}, options);
  QCOMPARE(calibrated.objects[0].notes.size(), std::size_t{1});  // no sweeps take part
  Case softer = sheet;
  softer.softness.global = found;
  softer.softness.energy = link_energy;
  options.calibrate = {};
  const Results by_hand = compare_with_physics({softer}, options);
  const Contestant usual{Algorithm::exact, 0, true}, own{Algorithm::exact, 0, true, found};
  QCOMPARE(label(own), std::string("Exact + equilibrium, calibrated"));
  for (std::size_t i = 0; i < sheet.drags.size(); ++i) {
    const Row& row = row_of(calibrated, 0, i, own);
    QVERIFY(row.has_figures() && row[relative] == row_of(by_hand, 0, i, usual)[relative]);
    QVERIFY(row[relative] != row_of(calibrated, 0, i, usual)[relative]);
  }
}

/// Newton's method starts from rest each time, so the answer is the same to the bit for any previous target.
void PhysicsTest::the_reference_solution_knows_nothing_of_the_last_one() {
  const Case sheet = pinned_sheet(25, {}, {});
  const std::vector<double> at_rest(2 * sheet.pins.size());
  ReferenceSolver solver({sheet.mesh, Cuts(sheet.mesh), sheet.pins, at_rest, {}});
  const ElementId handle = std::get<commands::Grab>(sheet.drags[0].commands[0]).elements.front();
  const Point near = sheet.mesh->rest_position(handle) + Point(0.1, -0.05, 0), far = near + Point(0.6, -0.6, 0);
  const ReferenceSolution first = solver.at(handle, near);
  QVERIFY(solver.at(handle, far).displacements != first.displacements);
  QVERIFY(chainmail::test::same_bits(solver.at(handle, near).displacements, first.displacements));
}

void PhysicsTest::everyone_takes_part() {
  for (std::size_t i = 0; i < bar_and_sheet; ++i) {
    const ObjectInfo& object = everything().objects[i];
    QCOMPARE(object.drags.size(), std::size_t{3 * 4 + 1});
    QCOMPARE(std::ranges::count(object.drags, "", &DragInfo::no_reference), std::ptrdiff_t{3 * 4 + 1});
    const auto rows = rows_of(everything(), i, [](const Row& row) { return row.drag.has_value(); });
    QCOMPARE(rows.size(), object.drags.size() * (1 + 3 * algorithms().size() + elastic_algorithms().size()));
    for (const Row* row : rows) {
      if (!row->contestant.algorithm) {
        continue;
      }
      const Algorithm algorithm = *row->contestant.algorithm;
      const bool fits =
          algorithm != Algorithm::chainmail_3d && (algorithm != Algorithm::boundary_elements || object.name == "bar");
      if ((algorithm == Algorithm::xpbd || algorithm == Algorithm::neo_hookean_xpbd) && !row->has_figures()) {
        QVERIFY2(row->refusal.find("converge") != std::string::npos, row->refusal.c_str());
        continue;
      }
      QVERIFY2(row->has_figures() == fits && row->refusal.empty() == fits, row->refusal.c_str());
      if (fits) {
        QVERIFY((*row)[ms_per_move].value() > 0 && (*row)[first_ms].value() > 0);
        QVERIFY((*row)[factorize_ms].value() > 0 && (*row)[grab_ms].value() >= 0);
        QVERIFY((*row)[grab_ms].value() > 0 || !info(algorithm).elastic);
        QCOMPARE((*row)[iterations].has_value(), info(algorithm).obeys_iterations);  // to its own limit
      }
    }
  }
}

void PhysicsTest::the_truth_has_no_error_and_linear_elasticity_less_for_less() {
  Case bar = pinned_bar(24, {}, {});
  const ElementId handle = std::get<commands::Grab>(bar.drags[0].commands[0]).elements.front();
  bar.drags = {drag(*bar.mesh, handle, {0.4, 0.4, 0}), drag(*bar.mesh, handle, {0.04, 0.04, 0})};
  const Results report = compare_with_physics({bar}, quick({}, {0, 10}));
  const auto error = [&](std::size_t drag, const Contestant& contestant) {
    return row_of(report, 0, drag, contestant)[error_rms].value();
  };
  for (const Row& row : report.rows) {
    if (row.drag && row.has_figures() && row.contestant.algorithm) {
      const bool is_truth = row.contestant.algorithm == Algorithm::neo_hookean;
      QVERIFY(is_truth ? *row[error_max] < converged : *row[error_rms] > 100 * converged);
      QVERIFY(row[error_max] >= row[error_rms] && row[moving_max] <= row[error_max]);
      QVERIFY(row[moving_rms] >= row[error_rms]);
    }
  }
  // Linear elasticity neglects terms of second order: a tenth of the displacement has about a tenth of the error.
  const double ratio = error(1, {Algorithm::linear_fem}) / error(0, {Algorithm::linear_fem});
  QVERIFY2(ratio > 0.05 && ratio < 0.2, qPrintable(QString::number(ratio)));
  QVERIFY(error(0, {Algorithm::exact}) != error(0, {Algorithm::exact, 10}));
  // Linear FEM is closer to the reference solution than Exact, which does not know the material.
  QVERIFY(error(0, {Algorithm::linear_fem}) < error(0, {Algorithm::exact}));
}

void PhysicsTest::drags_are_what_they_say() {
  for (const Case& object : physics_cases({}, {})) {
    QCOMPARE(object.drags.size(), std::size_t{3 * 4 + 1});
    const double size = (bounds(*object.mesh)[1] - bounds(*object.mesh)[0]).maxCoeff();
    std::vector<ElementId> handles;
    for (std::size_t first = 0; first < 12; first += 4) {
      const ElementId handle = handle_of(object.drags[first]);
      std::vector<Point> ways;
      for (std::size_t i = first; i < first + 4; ++i) {
        const RecordedMoves& one = object.drags[i];
        QCOMPARE(one.commands.size(), std::size_t{25});
        QCOMPARE(handle_of(one), handle);
        QVERIFY(one.description.starts_with("element " + std::to_string(handle) + ", "));
        ways.push_back(std::get<commands::Drag>(one.commands.back()).target - object.mesh->rest_position(handle));
      }
      QVERIFY(std::abs(ways[0].norm() - 0.05 * size) < 1e-12);
      QVERIFY(std::abs(ways[1].norm() - 0.2 * size) < 1e-12 && std::abs(ways[2].norm() - 0.2 * size) < 1e-12);
      QVERIFY(std::abs(ways[1].dot(ways[2])) < 1e-12);
      QVERIFY((ways[3] - 2.5 * ways[2]).norm() < 1e-12);
      // Well spread: at least a third of the object away from the pins and from each other.
      std::vector<ElementId> others = object.pins;
      others.insert(others.end(), handles.begin(), handles.end());
      for (const ElementId other : others) {
        QVERIFY((object.mesh->rest_position(handle) - object.mesh->rest_position(other)).norm() > size / 3);
      }
      handles.push_back(handle);
    }
  }
}

void PhysicsTest::turned_objects_show_what_depends_on_the_axes() {
  const auto contestants =
      contestants_of({Algorithm::natural_queue, Algorithm::exact, Algorithm::linear_fem}, {0, 3}, true, {});
  const auto differences = [&](const RegionAxes& axes) {
    const Case bar = pinned_bar(81, Softness{{}, {}, standard_energy, axes}, {});
    Results results{.objects = {info_of(bar)}};
    add_turned(results, bar, contestants, CompareOptions(), {});
    return results;
  };
  const auto of = [](const Results& results, const Contestant& contestant, const Figure& figure) {
    return row_of(results, 0, std::nullopt, contestant)[figure].value();
  };
  const Results along_axes = differences({}), along_object = differences({AxesKind::object, Point::Zero()}),
                given = differences({AxesKind::given, Point(0, 0, 0.3)});
  QCOMPARE(along_axes.rows.size(), std::size_t{7});  // without sweeps, with both equilibria, and linear FEM
  for (const Results* all : {&along_axes, &along_object, &given}) {
    QVERIFY(of(*all, {Algorithm::linear_fem}, turned_45_max) < 1e-9);
    QVERIFY(of(*all, {Algorithm::linear_fem}, turned_90_max) < 1e-9);
  }
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
    QVERIFY(of(along_axes, {algorithm}, turned_45_max) > 0.05);
    QVERIFY(of(along_axes, {algorithm}, turned_45_relative) > 0.01);
    QVERIFY(of(along_axes, {algorithm}, turned_90_max) < 1e-9);  // axes turned by 90° are axes
    const Contestant material{.algorithm = algorithm, .equilibrium = true, .open_regions = true};
    QVERIFY(std::abs(of(along_axes, material, turned_45_max) / of(along_axes, {algorithm}, turned_45_max) - 1) >
            0.01);  // relaxation leads to another answer
    for (const Results* all : {&along_object, &given}) {
      QVERIFY(of(*all, {algorithm}, turned_45_max) < 1e-4 && of(*all, {algorithm}, turned_90_max) < 1e-4);
    }
  }
  // A contestant with open regions or calibrated softness has it on the turned object too, whatever the object's own.
  const Contestant open{.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true};
  const auto of_own = [&](const LinkSoftness& own) {
    const Case bar = pinned_bar(81, Softness{own, {}, standard_energy, {}}, {});
    Results results{.objects = {info_of(bar)}};
    add_turned(results, bar, {open}, CompareOptions(), {});
    return of(results, open, turned_45_max);
  };
  QCOMPARE(of_own({0.9, 1.1, 0.05}), of_own({0.5, 2, 0.5}));
  const Case line{"line", "", make_mesh(MeshKind::line, {4, 1, 1}), {}, {0}, {}, {}};
  Results nothing{.objects = {info_of(line)}};
  add_turned(nothing, line, contestants, CompareOptions(), {});
  QVERIFY(nothing.rows.empty());
}

void PhysicsTest::objects_are_named_after_their_laws() {
  const std::vector<Case> bar{{"bar", "", make_mesh(MeshKind::line, {4, 1, 1}), {}, {0}, {}, {}}};
  const StrainLaw plain, gent{.kind = StrainLaw::Kind::gent};
  const auto names = [&](const std::vector<StrainLaw>& laws) {
    QStringList all;
    for (const Case& one : with_laws(bar, laws)) {
      all << QString::fromStdString(one.name);
    }
    return all;
  };
  QCOMPARE(names({plain}), QStringList{"bar"});
  QVERIFY2(names({gent})[0].startsWith("bar, Gent"), qPrintable(names({gent})[0]));
  QVERIFY(names({plain, gent})[0].startsWith("bar, ") && names({plain, gent})[1] == names({gent})[0]);
}

void PhysicsTest::what_has_no_answer_is_refused_by_name() {
  const auto sentence_of = [](const Case& object) -> QString {
    try {
      compare_with_physics({object}, quick({Algorithm::exact}, {0}));
    } catch (const Error& error) {
      return QString::fromUtf8(error.what());
    }
    return {};
  };
  Case loose = pinned_sheet(25, {}, {});
  loose.pins.clear();
  QVERIFY(sentence_of(loose).startsWith("sheet: nothing pins it, so physics has no solution; "));
  Case open = pinned_bar(24, {}, {});
  open.mesh = make_mesh(MeshKind::cloth, {4, 4, 1}, 3);  // it has no inside
  open.name = "hull";
  open.pins = {0};
  QVERIFY2(sentence_of(open).startsWith("hull: "), qPrintable(sentence_of(open)));
  Case flat = pinned_sheet(25, {}, {});
  flat.elastic.material.poisson = 0.5;
  QVERIFY(sentence_of(flat).contains("Poisson"));
  QVERIFY_EXCEPTION_THROWN(physics_drags(loose), Error);
}

void PhysicsTest::objects_grow() {
  const auto all = series_in(everything());
  QCOMPARE(all, (std::vector<std::string>{"growing bar", "growing sheet"}));
  for (const std::string& series : all) {
    std::set<Algorithm> seen;
    for (const Contestant& contestant : contestants_in(everything(), series)) {
      seen.insert(contestant.algorithm.value());
      std::uint64_t elements = 0;
      for (const auto& [object, found] : points_of(everything(), series, contestant)) {
        QVERIFY(!found.row.has_figures() || found.row[ms_per_move].value() > 0);
        QVERIFY(everything().objects[object].elements > elements);
        elements = everything().objects[object].elements;
      }
    }
    QCOMPARE(seen.size(), every_algorithm().size());
    const auto truth = points_of(everything(), series, {Algorithm::neo_hookean});
    QVERIFY(truth.at(0).figures.row[error_max].value() < converged);
  }
  const Results without_time = compare_with_physics({pinned_sheet(9, {}, {})}, quick({Algorithm::exact}, {0}));
  QVERIFY(series_in(without_time).empty());
}

void PhysicsTest::a_growing_object_has_its_own_number_of_elements() {
  PhysicsOptions options = quick({Algorithm::exact}, {0});
  options.growth_seconds = 1e-9;  // the first size only
  const Results grown = grow("sheet", "", [](std::uint64_t) { return pinned_sheet(25, {}, {}); }, options, {});
  QCOMPARE(grown.objects.size(), std::size_t{1});
  QCOMPARE(grown.objects[0].name, std::string("sheet, 25 elements"));
}

void PhysicsTest::it_stops_at_once() {
  const Progress job = Progress::watched();
  job.cancel();
  const Results report = compare_with_physics({pinned_sheet(25, {}, {})}, quick({}, {0}), job);
  QVERIFY(report.stopped);
  QVERIFY(report.objects.at(0).drags.empty() && report.rows.empty());
}

void PhysicsTest::every_figure_of_physics_is_measured() {
  const auto measured = figures_in(everything());
  for (const Figure* one :
       {&relative, &first_ms, &later_ms, &after_cut_ms, &factorize_ms, &grab_ms, &hausdorff, &figures::volume_change,
        &figures::inverted_cells, &stretch, &violation_max, &turned_45_max, &turned_90_relative}) {
    QVERIFY2(std::ranges::count(measured, one) == 1, std::string(one->key).c_str());
  }
  const double nothing = joined(everything(), 0, {}, Drags::all, "nudge").row[relative].value();
  QVERIFY2(nothing > 0.6 && nothing < 1, qPrintable(QString::number(nothing)));
}

CHAINMAIL_TEST(PhysicsTest)

}  // namespace chainmail::test_physics

#include "test_physics.moc"
