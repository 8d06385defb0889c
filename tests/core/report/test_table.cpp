#include <QtTest>
#include <cmath>
#include <set>

#include "core/report/made_results.h"
#include "program.h"
#include "report/page/tables.h"
#include "report/table/summary.h"

namespace chainmail::test_table {

using namespace chainmail::report;
using namespace chainmail::report::figures;
using namespace chainmail::report::test;

/// The table of results: its figures, and what is computed of its rows.
class TableTest : public QObject {
  Q_OBJECT

 private slots:
  void every_figure_is_found_by_its_key();
  void rows_that_are_added_keep_their_object();
  void drags_are_joined_as_each_figure_says();
  void means_leave_out_the_cut();
  void a_fresh_grab_is_a_drag_of_one_move_where_there_is_one();
  void the_front_has_whom_no_one_beats();
  void errors_below_the_change_of_the_reference_are_equal();
  void a_curve_has_its_shortest_times();
  void a_series_has_an_order_and_a_growth();
};

namespace {

const SpeedAgainstError& later = speeds_against_error()[0];
const Contestant fem{Algorithm::linear_fem}, exact{Algorithm::exact}, queue{Algorithm::natural_queue};

/// A contestant that is measured in all drags. `sweeps` tells contestants apart.
Standing standing(Algorithm algorithm, int sweeps, double median, double error) {
  return {.contestant = {algorithm, sweeps}, .error = error, .ms = ms(median), .is_complete = true};
}

std::vector<int> sweeps_of(const std::vector<const Standing*>& all) {
  std::vector<int> sweeps;
  for (const Standing* one : all) {
    sweeps.push_back(one->contestant.sweeps);
  }
  return sweeps;
}

}  // namespace

/// Scripts and the reader of files know figures by their keys.
void TableTest::every_figure_is_found_by_its_key() {
  std::set<std::string_view> keys;
  std::set<std::pair<std::string_view, std::string_view>> headings;
  for (const Figure* one : every_figure()) {
    QVERIFY2(find_figure(one->key) == one, std::string(one->key).c_str());
    keys.insert(one->key);
    headings.insert({one->group, one->heading});
  }
  QCOMPARE(keys.size(), every_figure().size());
  QCOMPARE(headings.size(), every_figure().size());
  QVERIFY(find_figure("") == nullptr && find_figure("relativ") == nullptr);
}

void TableTest::rows_that_are_added_keep_their_object() {
  Results all = results_of(ReportKind::suite, {"pull"}), other = all;
  add_row(all, 0, fem, {{&relative, 0.5}});
  add_row(other, 0, fem, {{&relative, 0.25}});
  other.objects[0].name = "sheet";
  other.stopped = true;
  all.add(other);
  QVERIFY(all.stopped && all.objects.size() == 2 && all.rows.size() == 2);
  QCOMPARE(all.object_of(all.rows[1]).name, std::string("sheet"));
  QCOMPARE(all.drag_of(all.rows[1]), &all.objects[1].drags[0]);
}

void TableTest::drags_are_joined_as_each_figure_says() {
  Results results = results_of(ReportKind::physics, {"nudge", "pull", "bend"});
  add_row(results, 0, fem, {{&relative, 0.1}, {&error_max, 0.5}, {&volume_change, 0.1}, {&later_ms, 2}});
  add_row(results, 1, fem, {{&relative, 0.3}, {&error_max, 0.25}, {&volume_change, -0.2}, {&later_ms, 4}});
  add_row(results, 1, exact, {{&relative, 9}});
  add_row(results, 2, fem, {}, "it did not converge");
  const Joined all = joined(results, 0, fem, Drags::all);
  QVERIFY(all.drags == 2 && all.of == 3 && !all.is_complete());
  QCOMPARE(all.row.refusal, std::string("it did not converge"));
  QCOMPARE(all.row[relative].value(), 0.2);
  QCOMPARE(all.row[error_max].value(), 0.5);
  QCOMPARE(all.row[volume_change].value(), -0.2);  // the worst, with its sign
  QVERIFY(all.row.find(later_ms)->spread == ms(3));
  QVERIFY(!all.row[first_ms]);
  const Joined one = joined(results, 0, fem, Drags::all, "pull");
  QVERIFY(one.is_complete() && one.row[relative] == 0.3);
  QVERIFY(!joined(results, 0, queue, Drags::all).is_complete());
}

void TableTest::means_leave_out_the_cut() {
  Results results = results_of(ReportKind::suite, {"pull", "bend", "cut"});
  results.objects[0].drags[2].has_cut = true;
  add_row(results, 0, exact, {{&relative, 0.2}, {&later_ms, 2}});
  add_row(results, 1, exact, {{&relative, 0.4}, {&later_ms, 2}});
  add_row(results, 2, exact, {{&relative, 9}, {&after_cut_ms, 5}});
  const auto of = [&](std::size_t speed) { return standings(results, 0, speeds_against_error()[speed]).at(0); };
  QVERIFY(std::abs(of(0).error - 0.3) < 1e-15 && of(0).is_complete);
  QCOMPARE(of(2).error, 9.0);
  QCOMPARE(of(2).ms->median, 5.0);
  QCOMPARE(joined(results, 0, exact, Drags::cut).row[after_cut_ms].value(), 5.0);
}

void TableTest::a_fresh_grab_is_a_drag_of_one_move_where_there_is_one() {
  Results results = results_of(ReportKind::suite, {"bend", "fresh grab"});
  add_row(results, 0, fem, {{&relative, 0.5}, {&fresh_ms, 7}, {&later_ms, 1}});
  add_row(results, 1, fem, {{&relative, 0.25}, {&fresh_ms, 9}});
  const auto fresh = [&] { return standings(results, 0, speeds_against_error()[1]).at(0); };
  QVERIFY(fresh().ms->median == 8 && fresh().error == 0.375);
  results.objects[0].drags[1].moves = 1;
  QVERIFY(fresh().ms->median == 9 && fresh().error == 0.25);
  QCOMPARE(standings(results, 0, later).at(0).error, 0.5);
}

void TableTest::the_front_has_whom_no_one_beats() {
  std::vector<Standing> all{standing(Algorithm::linear_fem, 1, 9, 0.1),      // slow and close
                            standing(Algorithm::linear_fem, 2, 9, 0.3),      // beaten in both
                            standing(Algorithm::linear_fem, 3, 2, 0.25),     // as slow as the middle, less close
                            standing(Algorithm::arap, 4, 2, 0.2),            // the middle
                            standing(Algorithm::xpbd, 5, 0.5, 0.9),          // fast
                            standing(Algorithm::xpbd, 6, 3, 0.2),            // slower than the middle and as close
                            standing(Algorithm::exact, 7, 0.5, 0.9),         // the same as the fast one
                            standing(Algorithm::neo_hookean, 8, 0.1, 0.01),  // that of the reference
                            standing(Algorithm::linear_fem, 9, 0.1, 0.01),   // all but the hard drag
                            standing(Algorithm::linear_fem, 10, 0, 0.05),    // without a time
                            standing(Algorithm::linear_fem, 11, 0, 1)};      // nothing moves
  all[8].is_complete = false;
  all[9].ms.reset();
  all[10].contestant.algorithm.reset();
  QCOMPARE(sweeps_of(front(all)), (std::vector<int>{5, 7, 4, 1}));
  QCOMPARE(sweeps_of(closest(all)), std::vector<int>{10});
  QVERIFY(front({}).empty() && closest({}).empty());
}

void TableTest::errors_below_the_change_of_the_reference_are_equal() {
  std::vector<Standing> all{standing(Algorithm::xpbd, 1, 1, 0.02), standing(Algorithm::linear_fem, 2, 2, 0.01),
                            standing(Algorithm::arap, 3, 0.5, 0.06)};
  QCOMPARE(sweeps_of(front(all)), (std::vector<int>{3, 1, 2}));
  QCOMPARE(sweeps_of(closest(all)), std::vector<int>{2});
  for (Standing& one : all) {
    one.change = 0.03;
  }
  QCOMPARE(sweeps_of(front(all)), (std::vector<int>{3, 1}));
  QCOMPARE(sweeps_of(closest(all)), (std::vector<int>{1, 2}));
}

void TableTest::a_curve_has_its_shortest_times() {
  Results results = results_of(ReportKind::suite, {"bend"});
  const auto limited = [](int limit) { return Contestant{.algorithm = Algorithm::xpbd, .limit = limit}; };
  for (const auto& [limit, median, error] : {std::tuple(1, 1.0, 0.4), {10, 3.0, 0.15}, {5, 4.0, 0.15}}) {
    add_row(results, 0, limited(limit), {{&relative, error}, {&later_ms, median}});
  }
  QVERIFY(!has_curves(results_of(ReportKind::suite, {}), 0) && has_curves(results, 0));
  const auto all = standings(results, 0, later);
  const Contestant curve = curve_of(limited(7));
  QCOMPARE(shortest_ms(all, curve, 0.5), std::optional(1.0));
  QCOMPARE(shortest_ms(all, curve, 0.2), std::optional(3.0));
  QVERIFY(!shortest_ms(all, curve, 0.1) && !shortest_ms(all, fem, 1));
  QCOMPARE(least_error(all, curve), std::optional(0.15));
  QVERIFY(!least_error(all, fem));
  const FigureTable table = time_table(results, 0);
  QCOMPARE(table.rows.size(), std::size_t{1});  // one for each curve
  QCOMPARE(table.rows[0].cells, (std::vector<std::string>{"0.15", "1", "3", "3", "-", "-", "-", "-", "-", "-"}));
}

void TableTest::a_series_has_an_order_and_a_growth() {
  Results results;
  for (const double elements : {10.0, 1000.0, 4000.0, 16'000.0}) {
    Results one = results_of(ReportKind::physics, {"pull"});
    one.objects[0].elements = std::uint64_t(elements);
    one.objects[0].series = "bars";
    add_row(one, 0, fem, {{&relative, 8 / elements}, {&later_ms, 0.01 * elements * std::sqrt(elements)}});
    add_row(one, 0, exact, {}, "it is no grid");
    results.add(one);
  }
  QCOMPARE(series_in(results), std::vector<std::string>{"bars"});
  QCOMPARE(contestants_in(results, "bars"), (std::vector<Contestant>{fem, exact}));
  const auto points = points_of(results, "bars", fem);
  QCOMPARE(points.size(), std::size_t{4});
  QVERIFY(std::abs(order_of(points).value() - 2) < 1e-12);  // a quarter of the error
  const Growth growth = growth_of(points, results, later_ms).value();
  QVERIFY(std::abs(growth.power - 1.5) < 1e-12);
  QVERIFY(growth.sizes == 3 && growth.from == 1000);  // small objects do not count
  const auto refused = points_of(results, "bars", exact);
  QVERIFY(!order_of(refused) && !growth_of(refused, results, later_ms));
  const FigureTable orders = order_table(results, "bars");
  QCOMPARE(orders.rows.at(0).cells.back(), std::string("2"));
  QCOMPARE(orders.rows.at(1).refusal, std::string("it is no grid"));
}

CHAINMAIL_TEST(TableTest)

}  // namespace chainmail::test_table

#include "test_table.moc"
