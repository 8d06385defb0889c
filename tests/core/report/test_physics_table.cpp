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
  void figures_of_a_page_stand_under_their_names();
  void figures_of_a_terminal_stand_under_their_names();
  void what_was_not_measured_is_empty();
  void a_refusal_is_one_drag_s();
  void the_law_of_the_reference_is_named();
  void growth_stands_under_its_names();
  void who_cannot_take_part_has_one_row();
  void plots_of_growth_are_named_after_what_they_show();
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

void PhysicsTableTest::figures_of_a_page_stand_under_their_names() {
  const FigureTable table = physics_table(object(), false);
  const std::string time = "time: median (quartiles, repetitions), ms";
  QCOMPARE(cell(table, time, "first"), QString("4 (3.75–4.5, 5)"));
  QCOMPARE(cell(table, time, "later"), QString("2 (1.75–2.5, 3)"));
  QCOMPARE(cell(table, time, "after cut"), QString("32 (31.8–32.5, 8)"));
  const std::string prepare = "prepare: median (quartiles, repetitions), ms";
  QCOMPARE(cell(table, prepare, "factorize"), QString("8 (7.75–8.5, 6)"));
  QCOMPARE(cell(table, prepare, "grab"), QString("16 (15.8–16.5, 7)"));
  QCOMPARE(cell(table, "relative error (ratio)", "pull"), QString("0.11"));
  QCOMPARE(cell(table, "relative error (ratio)", "cut"), QString("0.31"));
  QCOMPARE(cell(table, "RMS error (%)", "pull"), QString("12%"));
  QCOMPARE(cell(table, "largest error (%)", "pull"), QString("13%"));
  QCOMPARE(cell(table, "RMS, what moves (%)", "pull"), QString("14%"));
  QCOMPARE(cell(table, "largest, what moves (%)", "pull"), QString("15%"));
  const std::string shape = "shape: worst of the drags";
  QCOMPARE(cell(table, shape, "Hausdorff (rest lengths)"), QString("0.21"));
  QCOMPARE(cell(table, shape, "volume change (%)"), QString("+22"));
  QCOMPARE(cell(table, shape, "inverted cells"), QString("23"));
  QCOMPARE(cell(table, shape, "stretch (ratio)"), QString("0.24"));
  QCOMPARE(cell(table, shape, "violation (rest lengths)"), QString("0.25"));
  const std::string equilibrium = "equilibrium: worst of the drags";
  QCOMPARE(cell(table, equilibrium, "residual (ratio)"), QString("0.0625"));
  QCOMPARE(cell(table, equilibrium, "regions bind"), QString("yes"));
  QCOMPARE(table.rows[0].cells.size(), table.columns.size());
}

void PhysicsTableTest::figures_of_a_terminal_stand_under_their_names() {
  const FigureTable table = physics_table(object(), true);
  QCOMPARE(cell(table, "relative error (ratio)", "pull"), QString("0.11"));
  QCOMPARE(cell(table, "relative error (ratio)", "cut"), QString("0.31"));
  QCOMPARE(cell(table, "time (ms)", "first"), QString("4"));
  QCOMPARE(cell(table, "time (ms)", "later"), QString("2"));
  QCOMPARE(cell(table, "time (ms)", "after cut"), QString("32"));
  QCOMPARE(cell(table, "prepare (ms)", "factorize"), QString("8"));
  QCOMPARE(cell(table, "prepare (ms)", "grab"), QString("16"));
  QCOMPARE(table.rows[0].cells.size(), table.columns.size());
}

void PhysicsTableTest::what_was_not_measured_is_empty() {
  PhysicsObject whole = object();
  whole.drags.pop_back();  // no drag has a cut
  const FigureTable text = physics_table(whole, true);
  QCOMPARE(cell(text, "time (ms)", "first"), QString("4"));
  QCOMPARE(cell(text, "time (ms)", "after cut"), QString("-"));
  whole.drags[0].entries[0].measurement->prepare.grab = {};
  const FigureTable page = physics_table(whole, false);
  QCOMPARE(cell(page, "prepare: median (quartiles, repetitions), ms", "factorize"), QString("8 (7.75–8.5, 6)"));
  QCOMPARE(cell(page, "prepare: median (quartiles, repetitions), ms", "grab"), QString());
}

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

void PhysicsTableTest::the_law_of_the_reference_is_named() {
  PhysicsObject bar = object();
  bar.law = {StrainLaw::Kind::gent, 3};
  const std::string about = physics_table(bar).about;
  QVERIFY2(about.find("reference: Gent (limit 3)") != std::string::npos, about.c_str());
}

void PhysicsTableTest::growth_stands_under_its_names() {
  const auto with = [](double relative) {
    PhysicalError error;
    error.relative = relative;
    return error;
  };
  const GrowthSeries series{PhysicsContestant{.algorithm = Algorithm::exact},
                            {{10, 1, 2, with(0.5)}, {20, 3, 4, with(0.25)}, {40, 5, 6, {}}},
                            "it takes too long",
                            Growth{1.5, 10, 40, 3}};
  const FigureTable table = growth_table({"bar", "a bar", {series}});
  QCOMPARE(cell(table, "the largest object", "elements"), QString("40"));
  QCOMPARE(cell(table, "the largest object", "ms per move"), QString("5"));
  QCOMPARE(cell(table, "the largest object", "prepare (ms)"), QString("6"));
  QCOMPARE(cell(table, "growth of time", "exponent"), QString("1.5"));
  QCOMPARE(cell(table, "relative error (ratio)", "first size"), QString("0.5"));
  QCOMPARE(cell(table, "relative error (ratio)", "last known"), QString("0.25"));
  QCOMPARE(cell(table, "why not larger", ""), QString("it takes too long"));
}

/// An algorithm that cannot take part has one row for all numbers of sweeps.
void PhysicsTableTest::who_cannot_take_part_has_one_row() {
  const GrowthSeries grown{PhysicsContestant{.algorithm = Algorithm::exact}, {{10, 1, 2, {}}}, "it takes too long", {}};
  const GrowthSeries refused{PhysicsContestant{.algorithm = Algorithm::chainmail_3d}, {}, "it is no grid", {}};
  GrowthSeries swept = refused;
  swept.contestant.sweeps = 1;
  QCOMPARE(growth_table({"bar", "a bar", {grown, refused, swept}}).rows.size(), std::size_t{2});
}

void PhysicsTableTest::plots_of_growth_are_named_after_what_they_show() {
  for (const Plot& plot : {growth_time_plot({}), growth_prepare_plot({}), growth_error_plot({})}) {
    QVERIFY(!plot.y.title.empty());
    QVERIFY2(plot.title.ends_with(plot.y.title), plot.title.c_str());
  }
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
