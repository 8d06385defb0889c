#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "core/report/comparisons.h"
#include "mesh/error.h"
#include "mesh/layers.h"
#include "program.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_table.h"
#include "report/run/drag_times.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"

namespace chainmail::test_physics {

using namespace chainmail::report;
using chainmail::report::test::drag;
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
  void what_has_no_answer_is_refused_by_name();
  void objects_grow();
  void it_stops_at_once();
  void csv_and_text_have_a_row_for_each();
};

namespace {

PhysicsOptions quick(std::vector<Algorithm> algorithms, std::vector<int> sweeps) {
  PhysicsOptions options;
  options.contest = report::test::quick(std::move(algorithms), std::move(sweeps));
  options.contest.repetitions = 1;
  options.growth_seconds = 0;
  return options;
}

/// The whole report on a tiny bar and a tiny sheet, computed once for all tests.
const PhysicsReport& everything() {
  static const PhysicsReport report = [] {
    PhysicsOptions options = quick({}, {0, 1, 10});
    options.growth_seconds = 0.002;
    ElasticOptions elastic;
    elastic.iterations = 300;  // enough for all but both XPBDs, and a fifth of the time
    return compare_with_physics({pinned_bar(48, {}, elastic), pinned_sheet(25, {}, elastic)}, options);
  }();
  return report;
}

/// Returns the errors of all contestants at the end of a drag.
std::map<std::pair<Algorithm, int>, PhysicalError> errors_of(const PhysicsDrag& drag) {
  std::map<std::pair<Algorithm, int>, PhysicalError> errors;
  for (const PhysicsEntry& entry : drag.entries) {
    if (entry.measurement) {
      if (entry.contestant.algorithm) {
        errors[{*entry.contestant.algorithm, entry.contestant.sweeps}] = entry.measurement->error;
      }
    }
  }
  return errors;
}

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
  const auto report = compare_with_physics({bar}, quick({Algorithm::linear_fem}, {0}));
  const PhysicsMeasurement& pull = report.objects[0].drags[0].entries[1].measurement.value();
  const PhysicsMeasurement& cut = report.objects[0].drags[1].entries[1].measurement.value();
  const double factorize = pull.prepare.factorize.median, grab = pull.prepare.grab.median;
  // Also in the first run, which prepares everything.
  Runner runner(bar, Algorithm::linear_fem, Precision::double_precision, {});
  const auto moves = with_preparing_move(*bar.mesh, bar.drags[0]);
  const DragTimes cold = split(runner.run(moves, 0, Progress()).ms, true, false);
  const auto is_short = [&](double ms) { return ms > 0 && ms < 0.5 * factorize; };
  const std::array checks{
      std::pair{"both are measured", pull.prepare.factorize.count >= 1 && pull.prepare.grab.count >= 1},
      std::pair{"one move prepares", count_moves(moves) == count_moves(bar.drags[0]) + 1},
      std::pair{"factorizing takes longest", factorize > grab && grab > 0},
      std::pair{"the first run prepares", cold.preparing > 0.5 * (factorize + grab)},
      std::pair{"moves are short", is_short(pull.first_move.median) && is_short(pull.ms_per_move.median)},
      std::pair{"moves of the first run are short", is_short(cold.first) && is_short(cold.later)},
      // After a cut, a part of it is needed again, in one move: the factors are updated.
      std::pair{"a cut prepares again", cut.move_after_cut.median > 20 * cut.ms_per_move.median},
      std::pair{"not everything", cut.move_after_cut.median < factorize + grab},
      std::pair{"moves after a cut are short", is_short(cut.ms_per_move.median)}};
  const auto wrong = std::find_if(checks.begin(), checks.end(), [](const auto& check) { return !check.second; });
  return wrong == checks.end() ? QString()
                               : QStringLiteral("not true: %1; %2 %3 %4 %5")
                                     .arg(wrong->first)
                                     .arg(factorize)
                                     .arg(grab)
                                     .arg(cold.preparing)
                                     .arg(cut.move_after_cut.median);
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
  for (const PhysicsObject& object : everything().objects) {
    const PhysicsDrag& cut = object.drags.back();
    QCOMPARE(cut.name, std::string("cut, then move"));
    QVERIFY(cut.has_cut && cut.moves == 13);
    const auto errors = errors_of(cut);
    QVERIFY(errors.at({Algorithm::neo_hookean, 0}).max < converged);
    for (const PhysicsEntry& entry : cut.entries) {
      QCOMPARE(entry.measurement && entry.measurement->move_after_cut.median > 0,
               entry.measurement && entry.contestant.algorithm);
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
  const PhysicsReport calibrated = compare_with_physics({sheet}, options);
  QCOMPARE(avoided, physics_handles(sheet));
  QCOMPARE(calibrated.objects[0].calibrations.size(), std::size_t{1});  // of these two, only Exact is calibrated
  Case stiffer = sheet;
  stiffer.softness = {stiff, {}};
  const PhysicsReport by_hand = compare_with_physics({stiffer}, quick({Algorithm::exact}, {7}));
  for (std::size_t i = 0; i < sheet.drags.size(); ++i) {
    const PhysicsEntry& entry = calibrated.objects[0].drags[i].entries.back();
    QCOMPARE(label(entry.contestant), std::string("Exact ChainMail, calibrated (7 sweeps)"));
    const PhysicsEntry &expected = by_hand.objects[0].drags[i].entries.back(),
                       &usual = calibrated.objects[0].drags[i].entries[4];
    QVERIFY(entry.measurement.value().error == expected.measurement.value().error);
    QVERIFY(usual.contestant.sweeps == 7 && entry.measurement->error != usual.measurement.value().error);
  }
  options.calibrate = [](const Case&, Algorithm, bool, const auto&, const Progress&) -> Calibration {
    throw Error("object", "it does not converge", "use another");
  };
  const PhysicsReport refused = compare_with_physics({sheet}, options);
  QCOMPARE(refused.objects[0].drags[0].entries.size(), std::size_t{1 + 4});
  QVERIFY(refused.objects[0].calibrations.at(0).refusal.find("does not converge") != std::string::npos);
}

void PhysicsTest::calibrated_contestants_go_to_the_equilibrium() {
  const Case sheet = pinned_sheet(25, {}, {});
  LinkSoftness found{0, 3, 2};
  found.lateral = 0.4;
  PhysicsOptions options = quick({Algorithm::exact}, {});
  options.contest.equilibrium = true;
  options.calibrate = [&](const Case&, Algorithm algorithm, bool equilibrium, const auto&, const Progress&) {
    return Calibration{algorithm, equilibrium, found, 0, 3, 60, 1.5, {}};
  };
  const PhysicsReport calibrated = compare_with_physics({sheet}, options);
  QCOMPARE(calibrated.objects[0].calibrations.size(), std::size_t{1});  // no sweeps take part
  Case softer = sheet;
  softer.softness.global = found;
  softer.softness.energy = link_energy;
  options.calibrate = {};
  const PhysicsReport by_hand = compare_with_physics({softer}, options);
  for (std::size_t i = 0; i < sheet.drags.size(); ++i) {
    const auto &entries = calibrated.objects[0].drags[i].entries, &expected = by_hand.objects[0].drags[i].entries;
    QCOMPARE(label(entries.back().contestant), std::string("Exact + equilibrium, calibrated"));
    QVERIFY(entries.back().measurement.value().error == expected[1].measurement.value().error);
    QVERIFY(entries.back().measurement->error != entries[1].measurement.value().error);
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
  for (const PhysicsObject& object : everything().objects) {
    QCOMPARE(object.drags.size(), std::size_t{3 * 4 + 1});
    for (const PhysicsDrag& one : object.drags) {
      QVERIFY2(one.no_reference.empty(), one.no_reference.c_str());
      QCOMPARE(one.entries.size(), 1 + 3 * algorithms().size() + elastic_algorithms().size());
      for (const PhysicsEntry& entry : one.entries) {
        if (!entry.contestant.algorithm) {
          continue;
        }
        const Algorithm algorithm = *entry.contestant.algorithm;
        const bool fits =
            algorithm != Algorithm::chainmail_3d && (algorithm != Algorithm::boundary_elements || object.name == "bar");
        if ((algorithm == Algorithm::xpbd || algorithm == Algorithm::neo_hookean_xpbd) && !entry.measurement) {
          QVERIFY2(entry.refusal.find("converge") != std::string::npos, entry.refusal.c_str());
          continue;
        }
        QVERIFY2(entry.measurement.has_value() == fits, entry.refusal.c_str());
        if (fits) {
          QVERIFY(entry.measurement->ms_per_move.median > 0 && entry.measurement->first_move.median > 0);
          const Preparation& prepare = entry.measurement->prepare;
          QVERIFY(prepare.factorize.median > 0 && prepare.grab.median >= 0);
          QVERIFY(prepare.grab.median > 0 || !(info(algorithm).elastic || entry.contestant.equilibrium));
          const bool iterates = info(algorithm).obeys_iterations || entry.contestant.equilibrium;
          QCOMPARE(entry.measurement->iterations.has_value(), iterates);  // to its own limit
        }
      }
    }
  }
}

void PhysicsTest::the_truth_has_no_error_and_linear_elasticity_less_for_less() {
  Case bar = pinned_bar(24, {}, {});
  const ElementId handle = std::get<commands::Grab>(bar.drags[0].commands[0]).elements.front();
  bar.drags = {drag(*bar.mesh, handle, {0.4, 0.4, 0}), drag(*bar.mesh, handle, {0.04, 0.04, 0})};
  const auto report = compare_with_physics({bar}, quick({}, {0, 10}));
  const auto far = errors_of(report.objects[0].drags[0]), near = errors_of(report.objects[0].drags[1]);
  for (const auto& errors : {far, near}) {
    QVERIFY(errors.at({Algorithm::neo_hookean, 0}).max < converged);
    for (const auto& [contestant, error] : errors) {
      QVERIFY(contestant.first == Algorithm::neo_hookean || error.rms > 100 * converged);
      QVERIFY(error.max >= error.rms && error.moving_max <= error.max && error.moving_rms >= error.rms);
    }
  }
  // Linear elasticity neglects terms of second order: a tenth of the displacement has about a tenth of the error.
  const double ratio = near.at({Algorithm::linear_fem, 0}).rms / far.at({Algorithm::linear_fem, 0}).rms;
  QVERIFY2(ratio > 0.05 && ratio < 0.2, qPrintable(QString::number(ratio)));
  QVERIFY(far.at({Algorithm::exact, 0}) != far.at({Algorithm::exact, 10}));
  // Linear FEM is closer to the reference solution than Exact, which does not know the material.
  QVERIFY(far.at({Algorithm::linear_fem, 0}).rms < far.at({Algorithm::exact, 0}).rms);
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
  const auto differences = [&](const RegionAxes& frame) {
    std::map<std::pair<Algorithm, bool>, std::vector<TurnDifference>> result;
    const Case bar = pinned_bar(81, Softness{{}, {}, standard_energy, frame}, {});
    for (const Symmetry& one : symmetry_under_rotation(bar, contestants, CompareOptions(), {})) {
      result[{*one.contestant.algorithm, one.contestant.equilibrium}] = one.turns;
    }
    return result;
  };
  auto along_axes = differences({}), along_object = differences({AxesKind::object, Point::Zero()});
  auto given = differences({AxesKind::given, Point(0, 0, 0.3)});
  QCOMPARE(along_axes.size(), std::size_t{5});  // without sweeps, and at equilibrium
  for (auto* all : {&along_axes, &along_object, &given}) {
    const auto& fem = (*all)[{Algorithm::linear_fem, false}];
    QCOMPARE(fem.size(), std::size_t{2});
    QVERIFY(fem[0].degrees == 45 && fem[0].max < 1e-9 && fem[1].max < 1e-9);
  }
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
    QVERIFY(along_axes[std::pair(algorithm, false)][0].max > 0.05);
    QVERIFY(along_axes[std::pair(algorithm, false)][0].relative > 0.01);
    QVERIFY(along_axes[std::pair(algorithm, false)][1].max < 1e-9);  // axes turned by 90° are axes
    QVERIFY(std::abs(along_axes[std::pair(algorithm, true)][0].max / along_axes[std::pair(algorithm, false)][0].max -
                     1) > 0.01);  // relaxation leads to another answer
    for (auto* all : {&along_object, &given}) {
      QVERIFY((*all)[std::pair(algorithm, false)][0].max < 1e-4);
      QVERIFY((*all)[std::pair(algorithm, false)][1].max < 1e-4);
    }
  }
  QVERIFY(symmetry_under_rotation(Case{"line", "", make_mesh(MeshKind::line, {4, 1, 1}), {}, {0}, {}, {}}, contestants,
                                  CompareOptions(), {})
              .empty());
  const FigureTable table = symmetry_table(everything());
  QCOMPARE(table.columns.size(), std::size_t{4});
  QVERIFY(!table.rows.empty());
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
  QCOMPARE(everything().growths.size(), std::size_t{2});
  for (const PhysicsGrowth& growth : everything().growths) {
    std::set<Algorithm> seen;
    for (const GrowthSeries& series : growth.series) {
      seen.insert(series.contestant.algorithm.value());
      QVERIFY(!series.end.empty());
      for (std::size_t i = 0; i < series.points.size(); ++i) {
        QVERIFY(series.points[i].ms_per_move > 0);
        QVERIFY(i == 0 || series.points[i].elements > series.points[i - 1].elements);
      }
      if (series.contestant.algorithm == Algorithm::neo_hookean) {
        QVERIFY(series.points.at(0).error.value().max < converged);
      }
    }
    QCOMPARE(seen.size(), every_algorithm().size());
  }
  const PhysicsOptions without_time = quick({Algorithm::exact}, {0});
  QVERIFY(compare_with_physics({pinned_sheet(9, {}, {})}, without_time).growths.empty());
}

void PhysicsTest::it_stops_at_once() {
  const Progress job = Progress::watched();
  job.cancel();
  const auto report = compare_with_physics({pinned_sheet(25, {}, {})}, quick({}, {0}), job);
  QVERIFY(report.stopped);
  QVERIFY(report.objects.at(0).drags.empty());
}

void PhysicsTest::csv_and_text_have_a_row_for_each() {
  std::ostringstream csv, text;
  write_csv(csv, everything());
  write_text(text, everything());
  std::istringstream lines(csv.str());
  std::string line;
  std::getline(lines, line);
  const QStringList names = QString::fromStdString(line).split(',');
  for (const char* name : {"relative", "first_ms", "after_cut_ms", "factorize_ms", "grab_ms", "handle", "calibrated",
                           "equilibrium", "hausdorff", "volume_change", "inverted_cells", "largest_stretch",
                           "violation_max", "turned_45_max", "turned_90_relative"}) {
    QVERIFY2(names.contains(QLatin1String(name)), name);
  }
  const auto columns = std::ranges::count(line, ',');
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    if (line.find('"') == std::string::npos) {
      QCOMPARE(std::ranges::count(line, ','), columns);
    }
    if (line.starts_with("bar,") && line.find(",nudge,") != std::string::npos &&
        line.find(",nothing,") != std::string::npos) {
      const double relative = QString::fromStdString(line).split(',')[names.indexOf("relative")].toDouble();
      QVERIFY(relative > 0.6 && relative < 1);
    }
  }
  QVERIFY(rows >= 2 * 10 * (3 * algorithms().size() + elastic_algorithms().size()));
  const QString printed = QString::fromStdString(text.str());
  const FigureTable summary = physics_summary(everything());
  for (const FigureTable::Row& row : summary.rows) {
    QCOMPARE(row.cells.size(), summary.columns.size());
    QVERIFY2(!row.label.ends_with("sweeps"), row.label.c_str());
  }
  QVERIFY(printed.contains("\n  bar: Nothing moves ") && printed.contains("\n  sheet: Linear FEM, on the same cells "));
  QCOMPARE(printed.count("\n  3D ChainMail"), 2 + 2);  // refused, so once per table for any number of sweeps
  QVERIFY(printed.contains("\n  Exact ChainMail, 10 sweeps "));
  QCOMPARE(printed.count("\n  Nothing moves "), 2);
  QVERIFY(printed.contains("\n  BEM, on its surface mesh "));
  QVERIFY(printed.contains("\n  Linear FEM, on the same cells "));
}

CHAINMAIL_TEST(PhysicsTest)

}  // namespace chainmail::test_physics

#include "test_physics.moc"
