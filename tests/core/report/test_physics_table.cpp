#include <QtTest>
#include <sstream>

#include "program.h"
#include "report/page/physics_figures.h"
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
  void the_file_has_each_number_under_its_name_data();
  void the_file_has_each_number_under_its_name();
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

/// Returns the field under a name in a row of a CSV table; row 0 is the first one below the names.
QString field(const std::string& csv, int row, const QString& name) {
  const QStringList lines = QString::fromStdString(csv).split('\n');
  const qsizetype column = lines[0].split(',').indexOf(name);
  return column < 0 ? "no column " + name : lines.value(1 + row).split(',').value(column);
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

void PhysicsTableTest::the_file_has_each_number_under_its_name_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("number");
  const auto row = [](const char* name, const char* number) { QTest::newRow(name) << QString(name) << number; };
  const auto time_rows = [](const QString& name, double median, int count) {
    const auto add = [&](const QString& column, double number) {
      QTest::newRow(qPrintable(column)) << column << QString::number(number);
    };
    add(name + "_ms", median);
    add(name + "_lower_quartile", median - 0.25);
    add(name + "_upper_quartile", median + 0.5);
    add(name + "_repetitions", count);
  };
  row("object", "bar");
  row("elements", "50");
  row("pins", "60");
  row("drag", "tear");
  row("hand", "0.75");
  row("handle", "70");
  row("algorithm", "fem");
  row("refusal", "");
  row("repetitions", "9");
  row("ms", "64");
  row("ms_lower_quartile", "63.75");
  row("ms_upper_quartile", "64.5");
  row("ms_min", "63.625");
  row("ms_max", "64.75");
  row("prepare_ms", "24");
  time_rows("first", 64, 9);
  time_rows("after_cut", 32, 8);
  time_rows("factorize", 8, 6);
  time_rows("grab", 16, 7);
  row("relative", "0.31");
  row("error_rms", "0.12");
  row("error_max", "0.13");
  row("moving_rms", "0.14");
  row("moving_max", "0.15");
  row("moving_elements", "9");
  row("hausdorff", "0.21");
  row("volume_change", "0.22");
  row("inverted_cells", "23");
  row("largest_stretch", "0.24");
  row("violation_max", "0.25");
  row("residual", "0.0625");
  row("regions_bind", "1");
  row("iterations", "40");
}

void PhysicsTableTest::the_file_has_each_number_under_its_name() {
  QFETCH(QString, name);
  QFETCH(QString, number);
  PhysicsReport report;
  report.objects = {object()};
  std::ostringstream csv;
  write_csv(csv, report);
  QCOMPARE(field(csv.str(), 1, name), number);
}

CHAINMAIL_TEST(PhysicsTableTest)

}  // namespace chainmail::test_physics_table

#include "test_physics_table.moc"
