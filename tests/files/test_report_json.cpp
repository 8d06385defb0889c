#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <sstream>

#include "files/results/report_json.h"
#include "program.h"

namespace chainmail::test_report_json {

using namespace chainmail::report;

/// Tests the JSON of a comparison.
class ReportJsonTest : public QObject {
  Q_OBJECT

 private slots:
  void has_every_figure();
  void holds_null_where_there_is_none();
  void names_from_outside_do_no_harm();
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

CHAINMAIL_TEST(ReportJsonTest)

}  // namespace chainmail::test_report_json

#include "test_report_json.moc"
