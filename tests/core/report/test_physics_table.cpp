#include <QtTest>

#include "program.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"

namespace chainmail::test_physics_table {

using namespace chainmail::report;

/// Who is refused by a drag, or by all, in the tables of a comparison with physics.
class PhysicsTableTest : public QObject {
  Q_OBJECT

 private slots:
  void a_refusal_is_one_drag_s();
  void who_cannot_take_part_has_one_row();
};

namespace {

/// An object with two drags and one contestant.
PhysicsObject object() {
  PhysicsMeasurement measurement;
  measurement.ms_per_move = measurement.first_move = {2, 1, 3, 1, 3, 3};
  measurement.error.relative = 0.11;
  PhysicsObject result;
  result.name = "bar";
  PhysicsDrag drag;
  drag.name = "pull";
  drag.entries = {{PhysicsContestant{.algorithm = Algorithm::linear_fem}, measurement, {}}};
  result.drags = {drag, drag};
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
