#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/results/report_json.h"
#include "files/results/suite_json.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_report_json {

using namespace chainmail::test;

using namespace chainmail::report;

/// Tests the JSON of comparisons.
class ReportJsonTest : public QObject {
  Q_OBJECT

 private slots:
  void has_every_figure();
  void holds_null_where_there_is_none();
  void names_from_outside_do_no_harm();
  void growth_is_described();
  void a_suite_comes_back();
  void a_point_without_iterations_is_refused();
};

namespace {

QJsonObject written(const Comparison& comparison, const Origin& origin = {}) {
  std::ostringstream out;
  write_json(out, comparison, origin);
  return QJsonDocument::fromJson(QByteArray::fromStdString(out.str())).object();
}

Comparison comparison() {
  Measurement measurement;
  measurement.ms_per_move = {0.5, 0.25, 1, 0.125, 2, 7};
  measurement.worst_move_ms = 3;
  measurement.checked = 12;
  measurement.moved = 8;
  measurement.errors.violation = {0.5, 0.25, 0.125, 100};
  measurement.errors.to_exact = Distance{4, 2};
  measurement.errors.float_to_double = {1e-6, 1e-7};
  measurement.errors.largest_over_handle = 1.5;
  return {{},
          {{"grid",
            "a grid",
            9,
            12,
            {{"local",
              "a drag",
              4,
              {{{Algorithm::enhanced, 10}, measurement, ""}, {{Algorithm::chainmail_3d, 0}, {}, "no grid"}},
              ""}}}},
          false};
}

/// A suite in which every text, list and figure has a value.
Suite suite() {
  SuiteResult result;
  result.name = "bar";
  result.description = "a bar that bends";
  result.reference = "FEM on refined cells";
  result.references = {{{{9, {}}, {25, 0.5}}, 1.5, true, "it has converged"}};
  result.elements = 12;
  result.links = 20;
  result.pins = 3;
  result.seconds = 1.5;
  result.notes = {"a note"};
  SuiteRow row{"bend", 4, true, "Exact", "exact", "no grid"};
  for (const SuiteFigure& figure : suite_figures) {
    row.*figure.value = double(&figure - suite_figures.data()) + 0.5;
  }
  result.rows = {row};
  result.orders = {{"FEM", "fem", "no mesh", {{9, 0.5}, {25, 0.25}}, 1.25}};
  result.times = {{"Exact", "exact", "no time", 7, {{1, 0.4, 1, 0.45, 2, 0.6, 3}, {20, 0.05, 8, {}, {}, {}, {}}}}};
  return {{{{{"a processor", 2, "a compiler", "Release"}, "a line", "today", "1"}, "1/4", {"bar"}}}, {result}};
}

std::string text_of(const Suite& suite) {
  std::ostringstream out;
  write_json(out, suite);
  return out.str();
}

/// Returns what the program reads from a file with this text.
Suite read_text_of_suite(const std::string& text) {
  const QTemporaryDir folder;
  const auto path = std::filesystem::path(folder.path().toStdString()) / "suite.json";
  put_file(path, text);
  return read_suite(path);
}

}  // namespace

void ReportJsonTest::has_every_figure() {
  const auto json = written(comparison(), {{"a processor", 2, "a compiler", "Release"}, "a line", "today", "1"});
  QCOMPARE(json["origin"]["processor"].toString(), QString("a processor"));
  QCOMPARE(json["origin"]["cores"].toInt(), 2);
  QCOMPARE(json["origin"]["command_line"].toString(), QString("a line"));
  QCOMPARE(json["options"]["precision"].toString(), QString("float"));
  const auto object = json["objects"][0];
  QCOMPARE(object["name"].toString(), QString("grid"));
  QCOMPARE(object["links"].toInt(), 12);
  const auto drag = object["drags"][0];
  QCOMPARE(drag["moves"].toInt(), 4);
  const auto one = drag["contestants"][0];
  QCOMPARE(one["algorithm"].toString(), QString("enhanced"));
  QCOMPARE(one["sweeps"].toInt(), 10);
  QCOMPARE(one["ms_per_move"]["median"].toDouble(), 0.5);
  QCOMPARE(one["ms_per_move"]["upper_quartile"].toDouble(), 1.0);
  QCOMPARE(one["ms_per_move"]["repetitions"].toInt(), 7);
  QCOMPARE(one["worst_move_ms"].toDouble(), 3.0);
  QCOMPARE(one["checked"].toInt(), 12);
  QCOMPARE(one["moved"].toInt(), 8);
  QCOMPARE(one["violation"]["fraction"].toDouble(), 0.125);
  QCOMPARE(one["distance_to_exact"]["rms"].toDouble(), 2.0);
  QCOMPARE(one["float_to_double"]["max"].toDouble(), 1e-6);
  QCOMPARE(one["largest_over_hand"].toDouble(), 1.5);
}

void ReportJsonTest::holds_null_where_there_is_none() {
  const auto drag = written(comparison())["objects"][0]["drags"][0];
  QVERIFY(drag["no_exact"].isNull());
  QVERIFY(drag["contestants"][0]["energy_over_exact"].isNull());
  QVERIFY(drag["contestants"][0]["distance_to_equilibrium"].isNull());
  const auto refused = drag["contestants"][1].toObject();
  QCOMPARE(refused["refusal"].toString(), QString("no grid"));
  QCOMPARE(refused.keys(), (QStringList{"algorithm", "equilibrium", "refusal", "sweeps"}));
}

void ReportJsonTest::names_from_outside_do_no_harm() {
  Comparison one = comparison();
  one.cases[0].name = "a\"b\n\xff";
  QCOMPARE(written(one)["objects"][0]["name"].toString(), QString("a\"b\n\ufffd"));
}

void ReportJsonTest::growth_is_described() {
  PhysicsReport report;
  report.growths = {{"bar", "bars of growing length", {}}};
  std::ostringstream out;
  write_json(out, report, Origin());
  const auto growth = QJsonDocument::fromJson(QByteArray::fromStdString(out.str())).object()["growths"][0];
  QCOMPARE(growth["name"].toString(), QString("bar"));
  QCOMPARE(growth["description"].toString(), QString("bars of growing length"));
}

/// Parts of a suite are read again to be merged. Nothing of them may get lost.
void ReportJsonTest::a_suite_comes_back() {
  const std::string text = text_of(suite());
  const Suite again = read_text_of_suite(text);
  QCOMPARE(again.results[0].reference, std::string("FEM on refined cells"));
  QCOMPARE(again.results[0].times[0].curve.at(1).later_ms, std::optional<double>(8));
  QCOMPARE(QString::fromStdString(text_of(again)), QString::fromStdString(text));
}

void ReportJsonTest::a_point_without_iterations_is_refused() {
  auto json = nlohmann::json::parse(text_of(suite()));
  json["experiments"][0]["times"][0]["curve"][1].erase("iterations");
  const QString error = error_of([&] { read_text_of_suite(json.dump()); });
  QVERIFY2(error.endsWith("suite.json: 'iterations' is missing; add it"), qPrintable(error));
}

CHAINMAIL_TEST(ReportJsonTest)

}  // namespace chainmail::test_report_json

#include "test_report_json.moc"
