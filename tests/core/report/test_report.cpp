#include <QXmlStreamReader>
#include <QtTest>
#include <locale>
#include <sstream>

#include "core/report/made_results.h"
#include "program.h"
#include "report/page/plots.h"
#include "report/page/report.h"
#include "report/page/svg.h"
#include "report/page/tables.h"
#include "report/table/format.h"

namespace chainmail::test_report {

using namespace chainmail::report;
using namespace chainmail::report::figures;
using namespace chainmail::report::test;

/// What is written of results: pages, tables, plots and CSV.
class ReportTest : public QObject {
  Q_OBJECT

 private slots:
  void text_is_escaped();
  void an_axis_of_nothing_stands();
  void a_layout_keeps_all_parts_apart_and_inside();
  void a_drawing_names_what_it_shows();
  void a_page_is_well_formed_and_needs_nothing_else();
  void a_table_on_a_page_has_all_cells();
  void plots_are_well_formed_files();
  void the_main_table_takes_the_worst();
  void a_refusal_is_one_drag_s();
  void who_cannot_take_part_has_one_row();
  void a_growing_object_says_why_it_is_not_larger();
  void the_closest_has_a_star();
  void csv_has_a_row_for_each();
  void csv_has_all_digits_in_every_locale();
};

namespace {

/// A comparison of two drags on one object: Natural Queue with and without sweeps, 3D ChainMail refused, Exact.
Results comparison() {
  Results results = results_of(ReportKind::compare, {"one", nasty.c_str()});
  results.runs = {{{{nasty, 2, "a compiler", "Release"}, "chainmail compare '" + nasty + "'", "today", "v"}}};
  results.settings = {{"relaxation", nasty}, {"relax_step", 1.0}};
  results.objects[0].name = nasty;
  results.objects[0].notes = {nasty};
  for (const std::size_t drag : {0, 1}) {
    const double scale = drag == 0 ? 1 : 2;
    const auto add = [&](const Contestant& contestant, double time, double violation, double distance) {
      add_row(results, drag, contestant,
              {{&ms_per_move, time * scale},
               {&violation_max, violation},
               {&violation_fraction, violation / 4},
               {&exact_distance_max, distance},
               {&exact_distance_rms, distance / 2}});
    };
    add({Algorithm::natural_queue}, 0.01, 0.5, 0.25 / scale);
    add({Algorithm::natural_queue, 10}, 0.1, 0.25 * scale, 1);
    add_row(results, drag, {Algorithm::chainmail_3d}, {}, "it works, on grids, alone");
    add({Algorithm::exact}, 0.02, 0, 0);
  }
  return results;
}

template <class Write>
std::string written(const Results& results, Write write) {
  std::ostringstream out;
  write(out, results);
  return out.str();
}

/// Returns the names of the XML elements; empty if the text is not well-formed XML.
QStringList elements_of(const std::string& text, QString* all_text = nullptr) {
  QXmlStreamReader reader(QByteArray::fromStdString(text));
  QStringList names;
  while (!reader.atEnd()) {
    reader.readNext();
    if (reader.isStartElement()) {
      names << reader.name().toString();
    } else if (reader.isCharacters() && all_text != nullptr) {
      *all_text += reader.text();
    }
  }
  if (reader.hasError()) {
    qWarning("line %lld: %s", reader.lineNumber(), qPrintable(reader.errorString()));
    return {};
  }
  return names;
}

/// Returns the fields of a line of CSV.
QStringList fields_of(const QString& line) {
  QStringList fields{{}};
  bool is_quoted = false;
  for (qsizetype i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && line.mid(i + 1, 1) == "\"") {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields << QString();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

/// Returns a cell of a row by the heading of its column; that heading if there is no such column.
QString cell(const FigureTable& table, std::size_t row, const std::string& group, const std::string& name) {
  const auto column = std::ranges::find(table.columns, FigureTable::Column{group, name});
  return QString::fromStdString(column == table.columns.end()
                                    ? "no column " + group + ": " + name
                                    : table.rows.at(row).cells.at(std::size_t(column - table.columns.begin())));
}

/// A locale that writes 1.000,5.
class CommaLocale : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

void ReportTest::text_is_escaped() {
  QCOMPARE(escaped(nasty), std::string("a&lt;b &amp; &quot;c&quot; &#39;d&#39;, ]]&gt; ?? \xc3\xa9"));
  // A truncated character, a surrogate, an overlong form, and one beyond the last; then valid ones of each length.
  QCOMPARE(escaped("\xc3"), std::string("?"));
  QCOMPARE(escaped("\xed\xa0\x80|\xc0\xaf|\xf4\x90\x80\x80"), std::string("???|??|????"));
  QCOMPARE(escaped("é€𝄞"), std::string("é€𝄞"));
}

void ReportTest::an_axis_of_nothing_stands() {
  for (const auto& values : {std::vector<double>{}, {0.0}, {1.0}, {std::nan(""), HUGE_VAL}}) {
    const Axis axis = Axis::logarithmic(values, 1e-12);
    for (const double value : {0.0, 1.0, 1e9, HUGE_VAL, std::nan("")}) {
      QVERIFY(axis.position(value) >= 0 && axis.position(value) <= 1);
    }
    QVERIFY(axis.ticks().size() >= 2);
  }
}

void ReportTest::a_layout_keeps_all_parts_apart_and_inside() {
  const Plot plot = error_plot(comparison(), 0, {0, 1}, figures::violation_max);
  for (const double width : {0.0, 330.0, 700.0}) {
    for (const double height : {230.0, 600.0}) {
      const PlotLayout layout(plot, {.width = width, .height = height, .font_size = 13});
      const auto [right, bottom] = layout.size();
      QVERIFY(width == 0 || (std::abs(right - width) < 1e-9 && std::abs(bottom - height) < 1e-9));
      const PlotArea one = layout.area(0), other = layout.area(1);
      QVERIFY(one.width > 30 && one.height > 30);
      QVERIFY(one.left + one.width < other.left || one.top + one.height < other.top);
      QVERIFY(other.left + other.width < right && other.top + other.height < bottom);
      for (std::size_t panel = 0; panel < 2; ++panel) {
        const PlotArea area = layout.area(panel);
        for (const PlotMark& mark : plot.panels[panel].marks) {
          const auto [x, y] = layout.position(panel, mark.x, mark.y);
          QVERIFY(x >= area.left && x <= area.left + area.width && y >= area.top && y <= area.top + area.height);
        }
      }
    }
  }
}

void ReportTest::a_drawing_names_what_it_shows() {
  const Plot plot = error_plot(comparison(), 0, {0, 1}, figures::violation_max);
  QCOMPARE(QString::fromStdString(plot.good_label), QString("counts as valid"));  // no other error has this threshold
  QVERIFY(error_plot(comparison(), 0, {0, 1}, figures::exact_distance_max).good_label.empty());
  const auto words_of = [&](const SvgStyle& style) {
    std::ostringstream out;
    write_svg(out, plot, style);
    QString words;
    return elements_of(out.str(), &words).isEmpty() ? QString() : words;
  };
  const QString whole = words_of({}), paper = words_of({.width = 330, .height = 230});
  const QString panels = words_of({.width = 330, .height = 230, .parts = PlotParts::panels});
  const QString legend = words_of({.parts = PlotParts::legend});
  for (const PlotSeries& series : plot.series) {
    const QString label = QString::fromStdString(series.label);
    QVERIFY(whole.contains(label) && paper.contains(label) && legend.contains(label));
    QCOMPARE(panels.count("\n" + label + "\n"), 0);
  }
  for (const QString& words : {whole, paper, panels}) {
    QVERIFY(words.contains(QString::fromStdString(plot.x.title)) && words.contains("largest violation"));
  }
  // A small drawing has fewer labels.
  QVERIFY(words_of({.width = 90, .height = 90, .parts = PlotParts::panels}).count('\n') < panels.count('\n'));
}

void ReportTest::a_page_is_well_formed_and_needs_nothing_else() {
  std::ostringstream out;
  write_html(out, comparison());
  QString words;
  const QStringList elements = elements_of(out.str(), &words);
  QCOMPARE(elements.count("svg"), 2);
  QCOMPARE(elements.count("table"), 2);
  for (const char* foreign : {"script", "link", "img", "iframe", "object"}) {
    QVERIFY2(!elements.contains(foreign), foreign);
  }
  QString without_namespace = QString::fromStdString(out.str());
  without_namespace.remove("http://www.w3.org/2000/svg");
  QVERIFY(!without_namespace.contains("http") && !without_namespace.contains("url(") &&
          !without_namespace.contains("@import"));
  for (const char* part : {"How to read it", "Main figures", "All figures", "it works, on grids, alone",
                           "chainmail compare 'a<b", "today", "a compiler", "relax_step"}) {
    QVERIFY2(words.contains(part), part);
  }
}

void ReportTest::a_table_on_a_page_has_all_cells() {
  FigureTable table{.caption = "times", .corner = "method"};
  table.columns = {{"ms", "one"}, {"ms", "next"}};
  table.rows = {{"a", {"1.5", "20"}, ""}, {"b", {}, "it refuses"}, {"c", {"10", "3.25"}, ""}};
  std::ostringstream page;
  write_html(page, table);
  QXmlStreamReader reader(QString::fromStdString(page.str()));
  QStringList cells;
  while (!reader.atEnd()) {
    if (reader.readNext() == QXmlStreamReader::StartElement && (reader.name() == u"td" || reader.name() == u"th")) {
      cells << reader.readElementText().simplified();  // without what aligns them
    }
  }
  QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  cells = cells.mid(cells.indexOf(QStringLiteral("method")));
  QCOMPARE(cells.join(u'|'), QStringLiteral("method|one|next|a|1.5|20|b|it refuses|c|10|3.25"));
}

void ReportTest::plots_are_well_formed_files() {
  const auto files = plots_of(comparison());
  QCOMPARE(files.size(), std::size_t{2});
  QCOMPARE(files[0].name, std::string("violation-1.svg"));
  QCOMPARE(files[1].name, std::string("distance-1.svg"));
  for (const PlotFile& file : files) {
    std::ostringstream out;
    write_svg(out, file.plot, file_ink);
    QCOMPARE(elements_of(out.str()).value(0), QString("svg"));
  }
  const Plot& plot = files[1].plot;
  QCOMPARE(plot.panels.size(), std::size_t{2});
  QCOMPARE(plot.panels[1].title, nasty);
  const auto& marks = plot.panels[0].marks;
  QCOMPARE(marks.size(), std::size_t{3});
  QVERIFY(marks[1].hollow && !marks[0].hollow && !marks[2].hollow);  // with sweeps
  QVERIFY(marks[1].x == 0.1 && marks[1].x_low == 0.05 && marks[1].x_high == 0.2 && marks[1].y == 0.5);
  QVERIFY2(marks[1].title.find("(quartiles 50 µs and 0.2 ms)") != std::string::npos, marks[1].title.c_str());
  QVERIFY(marks[0].series == marks[1].series && marks[0].series != marks[2].series);
}

void ReportTest::the_main_table_takes_the_worst() {
  const FigureTable table = object_table(comparison(), 0, Medium::terminal);
  QCOMPARE(table.rows.size(), std::size_t{4});
  QCOMPARE(table.rows[0].label, std::string("Natural Queue ChainMail"));
  QCOMPARE(cell(table, 0, "time, per move (ms)", "one"), QString("0.01"));
  QCOMPARE(cell(table, 0, "time, per move (ms)", nasty), QString("0.02"));
  QCOMPARE(cell(table, 0, "distance to Exact (mean rest lengths)", "largest"), QString("0.25"));  // of the first drag
  QCOMPARE(cell(table, 1, "violation (rest lengths)", "largest"), QString("0.5"));                // of the second
  QCOMPARE(cell(table, 1, "violation", "links"), QString("12.5%"));
  QCOMPARE(table.rows[2].refusal, std::string("it works, on grids, alone"));
  const FigureTable page = object_table(comparison(), 0, Medium::page);
  QCOMPARE(cell(page, 0, "time, per move (ms)", "one"), QString("0.01 (0.005–0.02, 5)"));  // quartiles and repetitions
}

/// A contestant that one drag refuses keeps its figures of the others. Its mean is not in the plot, where it would
/// stand for drags that it leaves out.
void ReportTest::a_refusal_is_one_drag_s() {
  const Contestant fem{Algorithm::linear_fem};
  const auto with = [&](std::size_t drags_with_figures) {
    Results results = results_of(ReportKind::physics, {"pull", "pull"});
    for (const std::size_t drag : {0, 1}) {
      if (drag < drags_with_figures) {
        add_row(results, drag, fem, {{&relative, 0.11}, {&later_ms, 2}});
      } else {
        add_row(results, drag, fem, {}, "it did not converge");
      }
    }
    return results;
  };
  const auto marks = [&](const Results& results) {
    const auto files = plots_of(results);
    return files.empty() ? 0 : int(files[0].plot.panels.at(0).marks.size());
  };
  QCOMPARE(marks(with(2)), 1);
  QCOMPARE(marks(with(1)), 0);
  for (const Medium medium : {Medium::page, Medium::terminal}) {
    QCOMPARE(cell(object_table(with(1), 0, medium), 0, "relative error (ratio)", "pull"), QString("0.11 (1 of 2)"));
  }
  QCOMPARE(cell(summary_table(with(1)), 0, "relative error (ratio)", "bar"), QString("0.11 (not all drags)"));
  QCOMPARE(object_table(with(0), 0, Medium::page).rows.at(0).refusal, std::string("it did not converge"));
}

/// An algorithm that cannot take part has one row for all numbers of sweeps.
void ReportTest::who_cannot_take_part_has_one_row() {
  Results results = results_of(ReportKind::physics, {"pull"});
  for (const int sweeps : {0, 1}) {
    add_row(results, 0, {Algorithm::chainmail_3d, sweeps}, {}, "it is no grid");
    add_row(results, 0, {Algorithm::exact, sweeps}, {{&relative, 0.5}, {&later_ms, 2}});
  }
  std::ranges::stable_sort(results.rows, {}, [](const Row& row) { return row.contestant.algorithm; });
  QCOMPARE(object_table(results, 0, Medium::page).rows.size(), std::size_t{3});
  results.objects[0].series = "bars";
  const FigureTable grown = growth_table(results, "bars");
  QCOMPARE(grown.rows.size(), std::size_t{3});
  QCOMPARE(cell(grown, grown.rows[0].refusal.empty() ? 0 : 1, "why not larger", ""),
           QString("this is the largest object"));
}

void ReportTest::a_growing_object_says_why_it_is_not_larger() {
  Results results = results_of(ReportKind::physics, {"pull"});
  results.objects.resize(2, results.objects[0]);
  for (ObjectInfo& object : results.objects) {
    object.series = "bars";
  }
  const auto add = [&](const Contestant& contestant, std::size_t object, const std::string& refusal) {
    add_row(results, 0, contestant, {}, refusal).object = object;
    if (refusal.empty()) {
      results.rows.back().set(relative, 0.5);
      results.rows.back().set(later_ms, ms(2));
    }
  };
  add({Algorithm::exact}, 0, "");
  add({Algorithm::exact}, 1, "");
  add({Algorithm::linear_fem}, 0, "");
  add({Algorithm::linear_fem}, 1, "it needs 9 GB");
  add({Algorithm::natural_queue}, 0, "");
  QVERIFY(summary_table(results).columns.empty());  // objects of a series have a table of their own
  const FigureTable grown = growth_table(results, "bars");
  QCOMPARE(grown.rows.size(), std::size_t{3});
  for (std::size_t row = 0; row < 3; ++row) {
    const std::string expected = grown.rows[row].label == label({Algorithm::exact}) ? "this is the largest object"
                                 : grown.rows[row].label == label({Algorithm::linear_fem}) ? "it needs 9 GB"
                                                                                           : "its time is used up";
    QCOMPARE(cell(grown, row, "why not larger", ""), QString::fromStdString(expected));
  }
}

void ReportTest::the_closest_has_a_star() {
  Results results = results_of(ReportKind::physics, {"pull"});
  const auto add = [&](const Contestant& contestant, double error, double change) {
    add_row(results, 0, contestant, {{&relative, error}, {&reference_change, change}, {&later_ms, 2}});
  };
  add({}, 1, 0.02);
  add({Algorithm::neo_hookean}, 1e-9, 0.02);
  add({Algorithm::linear_fem}, 0.01, 0.02);
  add({Algorithm::exact}, 0.5, 0.02);
  const FigureTable table = summary_table(results);
  for (const auto& [row, expected] : {std::pair(0, "1"), {1, "below 0.02"}, {2, "below 0.02*"}, {3, "0.5"}}) {
    QCOMPARE(cell(table, std::size_t(row), "relative error (ratio)", "bar"), QString(expected));
  }
  const std::string text = written(results, [](auto& out, const Results& all) { write_text(out, all); });
  QVERIFY2(text.starts_with("bar: Linear FEM, on the same cells (below 0.02) is closest\n"), text.c_str());
}

void ReportTest::csv_has_a_row_for_each() {
  Results results = comparison();
  results.objects[0].name = "a \"b\", c";
  const std::string csv = written(results, write_csv);
  const auto lines = QString::fromStdString(csv).trimmed().split('\n');
  QCOMPARE(lines.size(), qsizetype(1 + results.rows.size()));
  const QStringList names = fields_of(lines[0]);
  QCOMPARE(QSet<QString>(names.begin(), names.end()).size(), names.size());
  for (int i = 1; i < lines.size(); ++i) {
    const QStringList fields = fields_of(lines[i]);
    QVERIFY2(fields.size() == names.size(), qPrintable(lines[i]));
    QCOMPARE(fields[names.indexOf("object")], QString("a \"b\", c"));
    QCOMPARE(fields[names.indexOf("drag")], i > 4 ? QString::fromStdString(nasty) : QString("one"));
  }
  const auto at = [&](int line, const char* name) { return fields_of(lines[line]).value(names.indexOf(name)); };
  const QList<std::pair<const char*, const char*>> expected{{"elements", "9"},
                                                            {"moves", "4"},
                                                            {"algorithm", "natural-queue"},
                                                            {"sweeps", "10"},
                                                            {"limit", "0"},
                                                            {"refusal", ""},
                                                            {"ms_per_move", "0.1"},
                                                            {"ms_per_move_lower_quartile", "0.05"},
                                                            {"ms_per_move_upper_quartile", "0.2"},
                                                            {"ms_per_move_repetitions", "5"},
                                                            {"violation_max", "0.25"},
                                                            {"exact_distance_rms", "0.5"}};
  for (const auto& [name, value] : expected) {
    QVERIFY2(at(2, name) == value, name);
  }
  QCOMPARE(at(3, "refusal"), QString("it works, on grids, alone"));
  for (const char* missing : {"ms_per_move", "ms_per_move_repetitions", "violation_max"}) {
    QVERIFY2(at(3, missing).isEmpty(), missing);
  }
  QVERIFY(!names.contains("relative"));  // nobody measured it
}

void ReportTest::csv_has_all_digits_in_every_locale() {
  Results results = results_of(ReportKind::compare, {"one"});
  results.objects[0].elements = 1'234'567;
  const double third = 1000.0 / 3;
  add_row(results, 0, {Algorithm::exact}, {{&violation_max, third}, {&ms_per_move, 1234.5}});
  const auto all = [&](const std::locale& locale) {
    std::ostringstream out;
    out.imbue(locale);
    write_csv(out, results);
    write_text(out, results);
    write_html(out, results);
    return out.str();
  };
  const std::string plain = all(std::locale::classic());
  QCOMPARE(all(std::locale(std::locale::classic(), new CommaLocale)), plain);
  const QStringList lines = QString::fromStdString(plain).split('\n');
  const QString number = fields_of(lines[1]).value(fields_of(lines[0]).indexOf("violation_max"));
  QVERIFY(number.toDouble() == third && lines[1].contains(",1234567,") && lines[1].contains(",1234.5,"));
}

CHAINMAIL_TEST(ReportTest)

}  // namespace chainmail::test_report

#include "test_report.moc"
