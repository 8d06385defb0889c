#include <QtTest>

#include "core/report/comparisons.h"
#include "mesh/error.h"
#include "program.h"
#include "report/run/drags.h"
#include "simulate/simulation.h"

namespace chainmail::test_compare {

using namespace chainmail::report;
using namespace chainmail::report::test;
using chainmail::test::make_mesh;

/// The experiment: its contestants and its measurements.
class CompareTest : public QObject {
  Q_OBJECT

 private slots:
  void everyone_takes_part_or_is_refused();
  void exact_is_at_no_distance_from_itself();
  void errors_by_hand_on_a_chain();
  void relaxation_is_made_and_counted();
  void cuts_pins_and_softness_are_taken();
  void what_moves_change_is_undone_for_the_next_run();
  void errors_are_the_same_each_time();
  void three_drags_reach_as_far_as_they_say();
};

void CompareTest::everyone_takes_part_or_is_refused() {
  const auto result = compare_one(jittered(), quick({}, {0, 3}));
  QCOMPARE(result.entries.size(), 2 * algorithms().size());
  QCOMPARE(result.moves, 4);
  for (std::size_t i = 0; i < result.entries.size(); ++i) {
    const Entry& entry = result.entries[i];
    QVERIFY(entry.contestant.algorithm == algorithms()[i / 2].algorithm);
    QCOMPARE(entry.contestant.sweeps, i % 2 == 0 ? 0 : 3);
    const bool fits = entry.contestant.algorithm != Algorithm::chainmail_3d;
    QCOMPARE(entry.measurement.has_value(), fits);
    QCOMPARE(QString::fromStdString(entry.refusal).contains("it works only on grids"), !fits);
  }
  QCOMPARE(label(result.entries[1].contestant), std::string("Generalized ChainMail, 3 sweeps"));
}

void CompareTest::exact_is_at_no_distance_from_itself() {
  const Errors errors = errors_of(jittered(), Algorithm::exact);
  QVERIFY(errors.to_exact == Distance{});
  QCOMPARE(errors.energy_over_exact.value(), 1.0);
  QVERIFY(errors.violation.max < rounding);
  QVERIFY(errors.largest_over_handle.value() <= 1 + rounding);
  // Float is close to double, but not equal.
  QVERIFY(errors.float_to_double.max > 0 && errors.float_to_double.max < 1e-5);
}

void CompareTest::errors_by_hand_on_a_chain() {
  // Element 0 moves to -1 in one move. 1 and 2 follow to 0.2 and 1.4, and 3 to 2.6.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const auto result = compare_one(object(line, drag(*line, 0, {-1, 0, 0}, 1)), quick({Algorithm::spiral}));
  const Measurement& measurement = result.entries[0].measurement.value();
  QCOMPARE(measurement.moved, std::uint64_t{3});
  QCOMPARE(measurement.checked, std::uint64_t{3});
  QCOMPARE(measurement.errors.violation.links, std::uint64_t{3});
  QCOMPARE(measurement.errors.largest_over_handle.value(), 1.0);
  QVERIFY(measurement.errors.to_exact->max < rounding);
}

void CompareTest::relaxation_is_made_and_counted() {
  // One sweep after 0 moved to -0.3: 1 moves to 0.85, 2 to 1.925, 3 to 2.925. Without it, only 1 moves, to 0.9.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const Case one = object(line, drag(*line, 0, {-0.3, 0, 0}, 1));
  const Errors errors = errors_of(one, Algorithm::spiral, 1);
  QVERIFY(std::abs(errors.to_exact->max - 0.075) < rounding);
  const double relaxed = 0.15 * 0.15 + 0.075 * 0.075, exact = 0.2 * 0.2 + 0.1 * 0.1;
  QVERIFY(std::abs(errors.energy_over_exact.value() - relaxed / exact) < 1e-10);
  auto half = quick({Algorithm::spiral}, {1});
  half.relax_step = 0.5;
  QVERIFY(compare_one(one, half).entries[0].measurement->errors.to_exact->max < 0.07);
  auto by_links = quick({Algorithm::spiral}, {1});
  by_links.scheme = RelaxationScheme::link;
  QVERIFY(!(compare_one(one, by_links).entries[0].measurement->errors == errors));
}

void CompareTest::cuts_pins_and_softness_are_taken() {
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  Case one = object(line, drag(*line, 0, {-1, 0, 0}));
  const auto moved = [&] { return compare_one(one, quick({Algorithm::natural_queue})).entries[0].measurement.value(); };
  QVERIFY(moved().moved > 0);
  one.cuts = {0, 0};
  QCOMPARE(moved().moved, std::uint64_t{0});
  QCOMPARE(compare({one}, quick()).cases[0].links, std::uint64_t{2});
  one.cuts = {};
  one.pins = {1};
  QVERIFY(moved().errors.violation.max > 0.7);  // Natural Queue does not stop at pins: 2 − 1.2
  one.pins = {};
  one.softness.links.set(0, {0, 3, 0});
  QCOMPARE(moved().moved, std::uint64_t{0});
}

void CompareTest::what_moves_change_is_undone_for_the_next_run() {
  const auto line = make_mesh(MeshKind::line, {6, 1, 1});
  RecordedMoves moves = drag(*line, 0, {-2, 0, 0});
  moves.commands.insert(moves.commands.end(),
                        {commands::Cut{{2}}, commands::Pin{{5}}, commands::SetSoftness{{{0.5, 1.3, 0}, {}}},
                         commands::Drag{Point(-3, 0, 0)}, commands::SetAlgorithm{Algorithm::exact},
                         commands::SetRelaxation{true, 1, RelaxationScheme::link}, commands::Release{}});
  const Case one = object(line, moves);
  auto options = quick({Algorithm::spiral}, {0, 0});  // two contestants, one solver
  options.repetitions = 3;
  const auto entries = compare_one(one, options).entries;
  QVERIFY(entries[0].measurement->errors == entries[1].measurement->errors);
  QCOMPARE(entries[0].measurement->moved, entries[1].measurement->moved);
  QCOMPARE(entries[0].measurement->errors.violation.links, std::uint64_t{4});
  QVERIFY(entries[0].measurement->errors.violation.max < rounding);
}

void CompareTest::errors_are_the_same_each_time() {
  auto options = quick({}, {0, 10}, Precision::single_precision);
  const auto first = compare_one(jittered(), options);
  options.repetitions = 5;
  const auto second = compare_one(jittered(), options);
  for (std::size_t i = 0; i < first.entries.size(); ++i) {
    const auto &one = first.entries[i].measurement, &other = second.entries[i].measurement;
    QCOMPARE(one.has_value(), other.has_value());
    if (one) {
      QVERIFY(one->errors == other->errors);
      QCOMPARE(one->checked, other->checked);
      QCOMPARE(one->moved, other->moved);
    }
  }
}

void CompareTest::three_drags_reach_as_far_as_they_say() {
  const auto grid = make_mesh(MeshKind::grid, {16, 16, 1});
  Case one{"grid", "", grid, {}, {}, {}, {}};
  one.drags = three_drags(one);
  const auto displaced = [&](const RecordedMoves& moves) {
    Simulation simulation(grid, Algorithm::exact, Precision::double_precision);
    for (const Command& command : moves.commands) {
      simulation.apply(command);
    }
    int count = 0;
    for (ElementId e = 0; e < grid->element_count(); ++e) {
      count += point_of(*grid, simulation.body().positions(), e) != grid->rest_position(e) ? 1 : 0;
    }
    return count;
  };
  // An eighth of 255 elements, and the handle. The steps between the distances allow more.
  QVERIFY(displaced(one.drags[0]) >= 32 && displaced(one.drags[0]) < 128);
  QCOMPARE(displaced(one.drags[1]), 256);
  const auto& back = one.drags[2].commands;
  const ElementId handle = std::get<commands::Grab>(back.front()).elements.front();
  QVERIFY(std::get<commands::Drag>(back.back()).target == grid->rest_position(handle));
  QVERIFY(displaced(one.drags[2]) > 128);  // the object does not spring back by itself
  for (const RecordedMoves& moves : one.drags) {
    const ElementId grabbed = std::get<commands::Grab>(moves.commands.front()).elements.front();
    QVERIFY2(moves.description.starts_with("element " + std::to_string(grabbed) + ", "), moves.name.c_str());
  }
}

CHAINMAIL_TEST(CompareTest)

}  // namespace chainmail::test_compare

#include "test_compare.moc"
