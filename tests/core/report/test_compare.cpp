#include <QtTest>

#include "core/report/comparisons.h"
#include "mesh/error.h"
#include "program.h"
#include "report/run/drags.h"
#include "simulate/simulation.h"

namespace chainmail::test_compare {

using namespace chainmail::report;
using namespace chainmail::report::test;
using namespace chainmail::report::figures;
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
  const Results result = compare({jittered()}, quick({}, {0, 3}));
  QCOMPARE(result.rows.size(), 2 * algorithms().size());
  QCOMPARE(result.objects.at(0).drags.at(0).moves, 4);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Row& row = result.rows[i];
    QVERIFY((row.contestant == Contestant{algorithms()[i / 2].algorithm, i % 2 == 0 ? 0 : 3}));
    const bool fits = row.contestant.algorithm != Algorithm::chainmail_3d;
    QCOMPARE(row.has_figures(), fits);
    QCOMPARE(QString::fromStdString(row.refusal).contains("it works only on grids"), !fits);
  }
  QCOMPARE(label(result.rows[1].contestant), std::string("Generalized ChainMail, 3 sweeps"));
}

void CompareTest::exact_is_at_no_distance_from_itself() {
  const Row row = row_of(jittered(), Algorithm::exact);
  QCOMPARE(row[exact_distance_max].value(), 0.0);
  QCOMPARE(row[exact_distance_rms].value(), 0.0);
  QCOMPARE(row[energy_over_exact].value(), 1.0);
  QVERIFY(row[violation_max].value() < rounding);
  QVERIFY(row[largest_over_handle].value() <= 1 + rounding);
  // Float is close to double, but not equal.
  QVERIFY(row[float_double_max].value() > 0 && row[float_double_max].value() < 1e-5);
}

void CompareTest::errors_by_hand_on_a_chain() {
  // Element 0 moves to -1 in one move. 1 and 2 follow to 0.2 and 1.4, and 3 to 2.6.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const Row row = row_of(object(line, drag(*line, 0, {-1, 0, 0}, 1)), Algorithm::spiral);
  QCOMPARE(row[moved].value(), 3.0);
  QCOMPARE(row[checked].value(), 3.0);
  QCOMPARE(row[largest_over_handle].value(), 1.0);
  QVERIFY(row[exact_distance_max].value() < rounding);
}

void CompareTest::relaxation_is_made_and_counted() {
  // One sweep after 0 moved to -0.3: 1 moves to 0.85, 2 to 1.925, 3 to 2.925. Without it, only 1 moves, to 0.9.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const Case one = object(line, drag(*line, 0, {-0.3, 0, 0}, 1));
  const Row row = row_of(one, Algorithm::spiral, 1);
  QVERIFY(std::abs(row[exact_distance_max].value() - 0.075) < rounding);
  const double relaxed = 0.15 * 0.15 + 0.075 * 0.075, exact = 0.2 * 0.2 + 0.1 * 0.1;
  QVERIFY(std::abs(row[energy_over_exact].value() - relaxed / exact) < 1e-10);
  auto half = quick({Algorithm::spiral}, {1});
  half.relax_step = 0.5;
  QVERIFY(compare({one}, half).rows[0][exact_distance_max].value() < 0.07);
  auto by_links = quick({Algorithm::spiral}, {1});
  by_links.scheme = RelaxationScheme::link;
  QVERIFY(same_everywhere(compare({one}, by_links).rows[0]) != same_everywhere(row));
}

void CompareTest::cuts_pins_and_softness_are_taken() {
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  Case one = object(line, drag(*line, 0, {-1, 0, 0}));
  const auto moved_by_queue = [&] { return row_of(one, Algorithm::natural_queue)[moved].value(); };
  QVERIFY(moved_by_queue() > 0);
  one.cuts = {0, 0};
  QCOMPARE(moved_by_queue(), 0.0);
  QCOMPARE(compare({one}, quick()).objects[0].links, std::uint64_t{2});
  one.cuts = {};
  one.pins = {1};
  // Natural Queue does not stop at pins: 2 − 1.2.
  QVERIFY(row_of(one, Algorithm::natural_queue)[violation_max].value() > 0.7);
  one.pins = {};
  one.softness.links.set(0, {0, 3, 0});
  QCOMPARE(moved_by_queue(), 0.0);
}

void CompareTest::what_moves_change_is_undone_for_the_next_run() {
  const auto line = make_mesh(MeshKind::line, {6, 1, 1});
  RecordedMoves moves = drag(*line, 0, {-2, 0, 0});
  moves.commands.insert(moves.commands.end(),
                        {commands::Cut{{2}}, commands::Pin{{5}}, commands::SetSoftness{{{0.5, 1.3, 0}, {}}},
                         commands::Drag{Point(-3, 0, 0)}, commands::SetAlgorithm{Algorithm::exact},
                         commands::SetRelaxation{true, 1, RelaxationScheme::link}, commands::Release{}});
  auto options = quick({Algorithm::spiral}, {0, 0});  // two contestants, one solver
  options.repetitions = 3;
  const auto rows = compare({object(line, moves)}, options).rows;
  QVERIFY(same_everywhere(rows.at(0)) == same_everywhere(rows.at(1)));
  QVERIFY(rows[0][violation_max].value() < rounding);
}

void CompareTest::errors_are_the_same_each_time() {
  auto options = quick({}, {0, 10}, Precision::single_precision);
  const auto first = compare({jittered()}, options).rows;
  options.repetitions = 5;
  const auto second = compare({jittered()}, options).rows;
  QCOMPARE(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    QVERIFY(same_everywhere(first[i]) == same_everywhere(second[i]));
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
