#include <QtTest>

#include "program.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"

namespace chainmail::test_physics_table {

using namespace chainmail::report;

/// Each figure of a comparison with physics stands under its own name, in the tables and in the file.
class PhysicsTableTest : public QObject {
  Q_OBJECT

 private slots:
  void a_refusal_is_one_drag_s();
  void who_cannot_take_part_has_one_row();
};

namespace {

/// Returns a time whose figures differ from those of all other times.
TimeSpread time(double median, int count) {
  return {median, median - 0.25, median + 0.5, median - 0.375, median + 0.75, count};
}

/// A measurement of different numbers, so that each is found again.
PhysicsMeasurement measurement() {
  PhysicsMeasurement all;
  all.ms_per_move = time(2, 3);
  all.first_move = time(4, 5);
  all.prepare = {time(8, 6), time(16, 7)};
  all.error = {0.11, 0.12, 0.13, 0.14, 0.15, 9};
  all.shape = {0.21, 0.22, 23, 0.24, 0.25};
  all.residual = 0.0625;
  all.binds = true;
  all.iterations = 40;
  return all;
}

/// An object with two drags and one contestant. Only the second drag has a cut.
PhysicsObject object() {
  const PhysicsContestant contestant{.algorithm = Algorithm::linear_fem};
  PhysicsMeasurement cut = measurement();
  cut.move_after_cut = time(32, 8);
  cut.error.relative = 0.31;
  cut.first_move = cut.ms_per_move = time(64, 9);
  PhysicsObject result;
  result.name = "bar";
  result.elements = 50;
  result.pins = 60;
  for (const bool has_cut : {false, true}) {
    PhysicsDrag& drag = result.drags.emplace_back();
    drag.name = has_cut ? "tear" : "pull";
    drag.has_cut = has_cut;
    drag.handle = 70;
    drag.handle_displacement = 0.75;
    drag.entries = {{contestant, has_cut ? cut : measurement(), {}}};
  }
  return result;
}

/// Returns the cell of the first row under a heading; the heading itself if there is no such column.
QString cell(const FigureTable& table, const std::string& group, const std::string& name) {
  const auto column = std::ranges::find_if(
      table.columns, [&](const FigureTable::Column& one) { return one.group == group && one.name == name; });
  return QString::fromStdString(column == table.columns.end()
                                    ? "no column " + group + ": " + name
                                    : table.rows.at(0).cells.at(std::size_t(column - table.columns.begin())));
}

}  // namespace

/// A contestant that one drag refuses keeps its figures of the others. Its mean is not in the plot, where it would
/// stand for drags that it leaves out.
void PhysicsTableTest::a_refusal_is_one_drag_s() {
  PhysicsObject whole = object();
  whole.drags[1] = whole.drags[0];
  const auto marks = [&] {
    PhysicsReport report;
    report.objects = {whole};
    return physics_overview(report).panels.at(0).marks.size();
  };
  QCOMPARE(marks(), std::size_t{1});
  whole.drags[1].entries[0] = {whole.drags[0].entries[0].contestant, std::nullopt, "it did not converge"};
  for (const bool for_text : {false, true}) {
    QCOMPARE(cell(physics_table(whole, for_text), "relative error (ratio)", "pull"), QString("0.11 (without 1)"));
  }
  QCOMPARE(marks(), std::size_t{0});
  whole.drags[0].entries[0] = whole.drags[1].entries[0];
  QCOMPARE(physics_table(whole, true).rows.at(0).refusal, std::string("it did not converge"));
}

/// An algorithm that cannot take part has one row for all numbers of sweeps.
void PhysicsTableTest::who_cannot_take_part_has_one_row() {
  const GrowthSeries grown{PhysicsContestant{.algorithm = Algorithm::exact}, {{10, 1, 2, {}}}, "it takes too long", {}};
  const GrowthSeries refused{PhysicsContestant{.algorithm = Algorithm::chainmail_3d}, {}, "it is no grid", {}};
  GrowthSeries swept = refused;
  swept.contestant.sweeps = 1;
  QCOMPARE(growth_table({"bar", "a bar", {grown, refused, swept}}).rows.size(), std::size_t{2});
}

CHAINMAIL_TEST(PhysicsTableTest)

}  // namespace chainmail::test_physics_table

#include "test_physics_table.moc"
