#include <QXmlStreamReader>
#include <QtTest>
#include <sstream>

#include "core/support.h"
#include "program.h"
#include "report/page/compared_figures.h"
#include "report/table/format.h"
#include "report/page/html.h"
#include "report/page/plot.h"
#include "report/page/svg.h"
#include "report/page/table.h"

namespace chainmail::test_report {

using namespace chainmail::report;

/// The output of a comparison: page and tables.
class ReportTest : public QObject {
  Q_OBJECT

 private slots:
  void text_is_escaped();
  void an_axis_of_nothing_stands();
  void a_layout_keeps_all_parts_apart_and_inside();
  void a_drawing_names_what_it_shows();
  void a_page_is_well_formed_and_needs_nothing_else();
  void the_main_table_takes_the_worst();
  void csv_has_a_row_for_each();
};

namespace {

const std::string nasty = "a<b & \"c\" 'd' ]]> \x01\xff \xc3\xa9";

Measurement measured(double ms, double violation, double distance) {
  Measurement measurement;
  measurement.ms_per_move = {ms, ms / 2, 2 * ms, ms / 4, 4 * ms, 5};
  measurement.checked = 12;
  measurement.moved = 8;
  measurement.errors.violation = {violation, violation / 2, violation / 4, 100};
  measurement.errors.to_exact = Distance{distance, distance / 2};
  return measurement;
}

/// A comparison of two drags on one object: Natural Queue with and without sweeps, 3D ChainMail refused, Exact.
Comparison comparison() {
  const auto entries = [](double scale) {
    return std::vector<Entry>{
        {{Algorithm::natural_queue, 0}, measured(0.01 * scale, 0.5, 0.25 / scale), ""},
        {{Algorithm::natural_queue, 10}, measured(0.1 * scale, 0.25 * scale, 1), ""},
        {{Algorithm::chainmail_3d, 0}, std::nullopt, "it works, on grids, alone"},
        {{Algorithm::exact, 0}, measured(0.02 * scale, 0, 0), ""},
    };
  };
  return {{},
          {{nasty, "an object", 9, 12, {{"one", "first", 4, entries(1), ""}, {nasty, "second", 4, entries(2), ""}}}},
          false};
}

Origin origin() { return {{nasty, 2, "a compiler", "Release"}, "chainmail compare '" + nasty + "'", "today", "v"}; }

std::string page() {
  std::ostringstream out;
  write_html(out, comparison(), origin());
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

}  // namespace

void ReportTest::text_is_escaped() {
  QCOMPARE(escaped(nasty), std::string("a&lt;b &amp; &quot;c&quot; &#39;d&#39; ]]&gt; ?? \xc3\xa9"));
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
  const Plot plot = violation_plot(comparison().cases.front());
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
  const Plot plot = violation_plot(comparison().cases.front());
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
  const std::string text = page();
  QString words;
  const QStringList elements = elements_of(text, &words);
  QCOMPARE(elements.count("svg"), 2);
  QCOMPARE(elements.count("table"), 3);
  for (const char* foreign : {"script", "link", "img", "iframe", "object"}) {
    QVERIFY2(!elements.contains(foreign), foreign);
  }
  QString without_namespace = QString::fromStdString(text);
  without_namespace.remove("http://www.w3.org/2000/svg");
  QVERIFY(!without_namespace.contains("http") && !without_namespace.contains("url(") &&
          !without_namespace.contains("@import"));
  QVERIFY(words.contains("How to read it"));
}

void ReportTest::the_main_table_takes_the_worst() {
  const auto tables = main_tables(comparison());
  QCOMPARE(tables.size(), std::size_t{1});
  QCOMPARE(tables[0].drags.size(), std::size_t{2});
  QCOMPARE(tables[0].rows.size(), std::size_t{4});
  const MainRow& plain = tables[0].rows[0];
  QCOMPARE(plain.contestant, std::string("Natural Queue ChainMail"));
  QVERIFY(plain.ms_per_move == (std::vector<std::optional<double>>{0.01, 0.02}));
  QCOMPARE(plain.to_exact->max, 0.25);             // of the first drag
  QCOMPARE(tables[0].rows[1].violation.max, 0.5);  // of the second
  QCOMPARE(tables[0].rows[1].violation.fraction, 0.125);
}

void ReportTest::csv_has_a_row_for_each() {
  Comparison plain = comparison();
  plain.cases[0].name = "a \"b\", c";
  std::ostringstream out;
  write_csv(out, plain);
  const auto lines = QString::fromStdString(out.str()).trimmed().split('\n');
  QCOMPARE(lines.size(), 9);
  const auto columns = lines[0].split(',').size();
  for (int i = 1; i < lines.size(); ++i) {
    const QString start = "\"a \"\"b\"\", c\",9,12,";
    QVERIFY2(lines[i].startsWith(start), qPrintable(lines[i]));
    // The name contains one comma, and the refusal two.
    QCOMPARE(lines[i].split(',').size(), columns + 1 + (lines[i].contains("original") ? 2 : 0));
  }
  QVERIFY(lines[1].contains(",one,4,natural-queue,0,,5,0.01,0.005,0.02,0.0025,0.04,0,12,8,0.5,0.25,0.125,0.25,0.125,"));
  QVERIFY(lines[3].endsWith(",original,0,\"it works, on grids, alone\"" + QString(20, ',') + ",0,,,,"));
}

CHAINMAIL_TEST(ReportTest)

}  // namespace chainmail::test_report

#include "test_report.moc"
