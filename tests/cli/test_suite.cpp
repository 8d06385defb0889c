#include <QXmlStreamReader>
#include <algorithm>

#include "cli/chainmail_program.h"
#include "cli/json_schemas.h"
#include "program.h"

namespace chainmail::test_suite {

using namespace chainmail::test;

/// Tests `chainmail compare --suite` and `--merge`, with the experiments that take least time.
class SuiteCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { program_ = std::make_unique<Program>(); }
  void writes_a_report_of_the_schema();
  void the_whole_is_the_sum_of_its_parts();
  void damaged_parts_are_refused_data();
  void damaged_parts_are_refused();
  void wrong_usage_data();
  void wrong_usage();

 private:
  static constexpr const char* short_run =
      " --experiments refinement,cantilever --algorithms exact,fem --calibrated off --repetitions 1";

  Outcome run(const char* line) const { return program_->run("compare" + QByteArray(line)); }

  std::unique_ptr<Program> program_;
};

void SuiteCommandTest::writes_a_report_of_the_schema() {
  const auto outcome = run((" --suite -o out" + QByteArray(short_run)).constData());
  QVERIFY2(outcome.code == 0 && !outcome.error.contains("note: "), outcome.error);
  QCOMPARE(QDir(program_->path("out")).entryList(QDir::Files),
           (QStringList{"fresh-grab.svg", "overview.svg", "report.csv", "report.html", "report.json"}));
  const auto check = check_schemas({{"report", program_->path("out/report.json")}}).front();
  QCOMPARE(check.fault, QString());
  QCOMPARE(check.accepted, QStringList());
  for (const char* file : {"out/report.html", "out/overview.svg", "out/fresh-grab.svg"}) {
    QXmlStreamReader reader(program_->read(file));
    while (!reader.atEnd()) {
      reader.readNext();
    }
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  }
  const auto report = program_->json("out/report.json");
  QVERIFY(report["runs"][0]["version"].toString().startsWith("chainmail "));
  // The refinement has 4 meshes of nothing, Exact, Exact at equilibrium, also in open regions, and FEM; the cantilever
  // one drag of them.
  QCOMPARE(rows_of(program_->read("out/report.csv")).size(), 4 * 5 + 5);
  QVERIFY(outcome.out.contains("cantilever: Linear FEM, on the same cells ("));
  QVERIFY(outcome.out.contains("cantilever, later move: on the front are "));
  QVERIFY(outcome.out.contains("observed"));
}

void SuiteCommandTest::the_whole_is_the_sum_of_its_parts() {
  const auto whole = run((" --suite -o whole" + QByteArray(short_run)).constData());
  QVERIFY2(whole.code == 0, whole.error);
  for (const char* shard : {"1", "2"}) {
    const auto outcome =
        run((" --suite -o part" + QByteArray(shard) + " --shard " + shard + "/2" + short_run).constData());
    QVERIFY2(outcome.code == 0, outcome.error);
  }
  const auto merged = run(" --merge part2/report.json part1/report.json -o merged");
  QVERIFY2(merged.code == 0 && merged.error.isEmpty(), merged.error);
  const auto figures = [&](const QString& folder) {
    QJsonArray all;
    for (const QJsonValue object : program_->json(folder + "/report.json")["objects"].toArray()) {
      all.append(object["name"]);
      for (const QJsonValue drag : object["drags"].toArray()) {
        for (const QJsonValue contestant : drag["contestants"].toArray()) {
          all.append(contestant["label"]);
          all.append(contestant["relative"]);
        }
      }
    }
    return all;
  };
  QVERIFY(!figures("whole").isEmpty());
  QCOMPARE(figures("merged"), figures("whole"));
  QCOMPARE(program_->json("merged/report.json")["runs"].toArray().size(), 2);
  QCOMPARE(check_schemas({{"report", program_->path("merged/report.json")}}).front().fault, QString());
}

void SuiteCommandTest::damaged_parts_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("where");
  QTest::newRow("no JSON") << QByteArray("{\"kind\": ") << "bad.json:1: ";
  const auto row = [](const char* name, const QByteArray& text, const char* where) {
    QTest::newRow(name) << text << "bad.json: " + QString(where);
  };
  row("another file", "{\"origin\": {}}", "it is not a report; ");
  row("a list", "[1]", "it is not a report; ");
  row("version 1", "{\"kind\": \"chainmail suite\", \"schema_version\": 1}",
      "it is a report of version 1; run the comparison again with this program\n");
  row("a later version", "{\"kind\": \"chainmail report\", \"schema_version\": 9}", "its format has version 9");
  const auto report = [](const QByteArray& members) {
    return "{\"kind\": \"chainmail report\", \"schema_version\": 2, \"options\": {}, " + members + "}";
  };
  row("another report", report("\"report\": \"ramp\", \"objects\": []"),
      "it is not a report of compare --suite; give the report.json of each part of a suite\n");
  row("no objects", report("\"report\": \"suite\""), "'objects' is missing");
  row("a wrong object", report("\"report\": \"suite\", \"objects\": [7]"), "'name' is missing");
}

void SuiteCommandTest::damaged_parts_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, where);
  program_->write("bad.json", text);
  check_refused(*program_, "compare --merge bad.json -o out", where);
}

void SuiteCommandTest::wrong_usage_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("compare --suite", "-o: it is missing; ");
  row("compare --suite grid.dat -o out", "MESH: it does not work with --suite; ");
  row("compare --suite --against physics -o out", "--against: it does not work with --suite; ");
  row("compare --suite --experiments hammer -o out", "--experiments: ");
  row("compare --suite --experiments bar,bar -o out", "--experiments: ");
  row("compare --suite --shard 3/2 -o out", "--shard: '3/2' is not a part of a whole; ");
  row("compare --suite --shard 2/two -o out", "--shard: '2/two' is not a part of a whole; ");
  row("compare --suite --shard 2/2 --experiments bar -o out", "--shard: no experiment is in this part; ");
  row("compare --experiments bar -o out", "--experiments: it works only with --suite; ");
  row("compare --merge nothing.json -o out", "nothing.json: ");
  row("compare --merge a.json --suite -o out", "--suite: it does not work with --merge; ");
  row("compare --merge -o out", "--merge: the files are missing; ");
}

void SuiteCommandTest::wrong_usage() {
  QFETCH(QString, where);
  check_refused(*program_, QTest::currentDataTag(), where);
}

CHAINMAIL_TEST(SuiteCommandTest)

}  // namespace chainmail::test_suite

#include "test_suite.moc"
