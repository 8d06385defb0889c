#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_ramp {

using namespace chainmail::test;

/// Tests `chainmail ramp`: its outputs and its errors. The grids are tiny and the budget is an hour, so that no machine
/// is too slow.
class RampCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { program_ = std::make_unique<Program>(); }
  void a_table_for_people();
  void json_csv_and_a_plot();
  void wrong_arguments_data();
  void wrong_arguments();

 private:
  Outcome ramp(const char* options) const {
    return program_->run("ramp --largest 36 --budget 3600 " + QByteArray(options));
  }

  std::unique_ptr<Program> program_;
};

void RampCommandTest::a_table_for_people() {
  const auto outcome = ramp("");
  QCOMPARE(outcome.code, 0);
  QVERIFY2(outcome.error.isEmpty(), outcome.error);
  for (const char* text : {"Generalized ChainMail", "Spiral", "Natural Queue ChainMail", "Enhanced ChainMail",
                           "3D ChainMail", "Exact ChainMail", "6x6 or more", "\n  4x4 ", "\n  6x6 "}) {
    QVERIFY2(outcome.out.contains(text), text);
  }
  QVERIFY(!outcome.out.contains("7x7"));
}

void RampCommandTest::json_csv_and_a_plot() {
  const auto outcome =
      ramp("--algorithms spiral,exact --seed 7 --precision double --stretch 1.5 --json a.json --csv a.csv --svg a.svg");
  QCOMPARE(outcome.code, 0);
  QVERIFY(outcome.out.contains("Exact ChainMail"));
  const auto json = program_->json("a.json");
  const auto options = json["options"].toObject();
  QCOMPARE(options["seed"].toInt(), 7);
  QCOMPARE(options["budget"].toDouble(), 3600.0);
  QCOMPARE(options["precision"].toString(), QString("double"));
  QCOMPARE(options["stretch"].toDouble(), 1.5);
  QCOMPARE(options["largest"].toInt(), 36);
  const auto origin = json["origin"].toObject();
  QVERIFY(origin["command_line"].toString().startsWith("chainmail ramp --largest 36 "));
  QVERIFY(!origin["processor"].toString().isEmpty() && origin["version"].toString().startsWith("chainmail "));
  const auto sizes = json["sizes"].toArray();
  QCOMPARE(sizes.size(), 6);
  QCOMPARE(sizes[1].toObject()["algorithm"].toString(), QString("exact"));
  QCOMPARE(sizes[5].toObject()["elements"].toInt(), 36);
  QVERIFY(sizes[5].toObject()["p99_ms"].toDouble() >= sizes[5].toObject()["median_ms"].toDouble());
  const auto algorithms = json["algorithms"].toArray();
  QCOMPARE(algorithms.size(), 2);
  QCOMPARE(algorithms[0].toObject()["largest_width"].toInt(), 6);
  QVERIFY(algorithms[0].toObject()["growth"].isNull());
  const auto rows = rows_of(program_->read("a.csv"));
  QCOMPARE(rows.size(), 6);
  QCOMPARE(rows[5][3], QByteArray("exact"));
  QCOMPARE(rows[5][0], QByteArray("6"));
  const QByteArray plot = program_->read("a.svg");
  QVERIFY(plot.startsWith("<svg") && plot.count("<polyline") == 2);
  QVERIFY(plot.contains("Exact ChainMail, 36 elements: ") && plot.contains("real time"));

  QVERIFY(
      ramp("--algorithms spiral --csv -")
          .out.startsWith("width,elements,links,algorithm,passes,median_ms,p99_ms,mean_moved,repeated,real_time\n"));
  QVERIFY(QJsonDocument::fromJson(ramp("--algorithms spiral --json -").out).isObject());
}

void RampCommandTest::wrong_arguments_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* options, const char* where) { QTest::newRow(options) << where; };
  row("--algorithms spiral,spiral", "--algorithms: 'spiral' is given twice; ");
  row("--algorithms best", "--algorithms: 'best' is not known; use generalized, ");
  row("--seed -1", "--seed: '-1' ");
  row("--budget 0", "--budget: Time of a pass 0 is out of range; use a number above 0");
  row("--largest 20000001", "--largest: Largest grid 20000001 is out of range; ");
  row("--json - --csv -", "standard output: ");
  row("grid.dat", "grid.dat: unexpected argument; ");
  row("--steps 3", "--steps: there is no such option; ");
}

void RampCommandTest::wrong_arguments() {
  QFETCH(QString, where);
  QElapsedTimer timer;
  timer.start();
  const auto outcome = program_->run(QStringList{"ramp"} + QString(QTest::currentDataTag()).split(' '));
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QVERIFY(program_->files().isEmpty());
  // The error must come before the ramp, which takes minutes.
  QVERIFY(timer.elapsed() < 5000);
}

CHAINMAIL_TEST(RampCommandTest)

}  // namespace chainmail::test_ramp

#include "test_ramp.moc"
