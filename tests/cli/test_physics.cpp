#include <QXmlStreamReader>

#include "cli/chainmail_program.h"

using namespace chainmail::test;

/// `chainmail compare --against physics` and `chainmail calibrate`.
class PhysicsCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate cloth 5x5 -o cloth.obj").code, 0);
  }
  void the_report_is_written();
  void nothing_pins_it();
  void calibrates_and_saves_a_preset();
  void a_preset_is_compared();
  void wrong_usage_data();
  void wrong_usage();

 private:
  static constexpr const char* short_run =
      " --against physics --repetitions 1 --grow 0 --relax 0,5 --algorithms exact,fem,neo-hookean,ffd -o out";

  const QJsonObject report() const { return program_->json("out/report.json"); }

  std::unique_ptr<Program> program_;
};

void PhysicsCommandTest::the_report_is_written() {
  const auto outcome = program_->run("compare cloth.obj --pins top --young 7 --poisson 0.4" + QByteArray(short_run));
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  QCOMPARE(QDir(program_->path("out")).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
           (QStringList{"object-1.svg", "report.csv", "report.html", "report.json"}));
  for (const char* file : {"out/report.html", "out/object-1.svg"}) {
    QXmlStreamReader reader(program_->read(file));
    while (!reader.atEnd()) {
      reader.readNext();
    }
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  }
  QCOMPARE(rows_of(program_->read("out/report.csv")).size(), 3 * 5);
  const auto object = report()["objects"][0];
  QCOMPARE(object["pins"].toInt(), 5);
  const auto contestants = object["drags"][0]["contestants"].toArray();
  QCOMPARE(contestants.size(), 5);
  QCOMPARE(contestants[1]["sweeps"].toInt(), 5);
  QVERIFY(contestants[0]["error"]["rms"].toDouble() > 0.01);
  QVERIFY(contestants[3]["error"]["max"].toDouble(1) < 1e-5);  // neo-Hookean FEM itself, held in float
  QVERIFY(contestants[2]["prepare_ms"].toDouble() > 0);
  QCOMPARE(report()["options"]["young"].toDouble(), 7.0);
  QCOMPARE(report()["options"]["poisson"].toDouble(), 0.4);
  QVERIFY(outcome.out.contains("\ncloth.obj: as the file has it; 25 elements, 56 links, 5 pinned; "));
  QVERIFY(outcome.out.contains("\n  Exact ChainMail, 5 sweeps "));
}

void PhysicsCommandTest::nothing_pins_it() {
  for (const char* line : {"compare cloth.obj --against physics -o out", "calibrate cloth.obj"}) {
    const auto outcome = program_->run(line);
    QCOMPARE(outcome.code, 2);
    QCOMPARE(
        QString::fromUtf8(outcome.error),
        QString("chainmail: cloth.obj: nothing pins it, so physics has no static answer; add --pins bottom, --pins "
                "boundary, or --pins ID,ID,…\n"));
  }
  QVERIFY(!program_->files().contains("out"));
}

void PhysicsCommandTest::calibrates_and_saves_a_preset() {
  const char* line =
      "calibrate cloth.obj --pins 20,24,21,22,23 --drags 2 --evaluations 30 --name felt -o felt.json --json out.json";
  const auto outcome = program_->run(line);
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  QVERIFY(outcome.out.contains(" sweeps a move\n") && outcome.out.contains("\n  calibrated "));
  const auto preset = program_->json("felt.json")["presets"].toArray().at(0).toObject();
  const auto result = program_->json("out.json");
  QCOMPARE(preset["name"].toString(), QString("felt"));
  QCOMPARE(preset["stretch"].toDouble(), result["stretch"].toDouble(-1));
  QVERIFY(result["residual"].toObject()["rms"].toDouble(9) < result["residual_before"].toObject()["rms"].toDouble());
  QCOMPARE(result["drags"].toArray().size(), 2);
  // The same again, and with the pins by their name.
  const QByteArray first = program_->read("out.json");
  QCOMPARE(program_->run("calibrate cloth.obj --pins top --drags 2 --evaluations 30 --json out.json").code, 0);
  QCOMPARE(program_->read("out.json"), first);
  QCOMPARE(program_->run("calibrate cloth.obj --pins top --seed 9 --drags 2 --evaluations 30 --json out.json").code, 0);
  QVERIFY(program_->read("out.json") != first);
}

void PhysicsCommandTest::a_preset_is_compared() {
  program_->write("stiff.json",
                  R"({"version": 1, "presets": [{"name": "stiff", "compression": 1, "stretch": 1, "shear": 0}]})");
  const auto moved = [&](const char* softness) {
    const QByteArray line =
        "compare cloth.obj --algorithms exact --relax 0 --repetitions 1 -o out " + QByteArray(softness);
    const auto outcome = program_->run(line);
    if (outcome.code != 0) {
      qWarning("%s", outcome.error.constData());
    }
    return report()["objects"][0]["drags"][0]["contestants"][0]["moved"].toInt(-1);
  };
  QCOMPARE(moved("--preset stiff.json"), 24 * 24);
  const int soft = moved("--preset Rubber");
  QVERIFY(soft > 0 && soft < 24 * 24);
  QCOMPARE(moved("--preset Rubber --compression 1 --stretch 1 --shear 0"), 24 * 24);  // what is given goes before
}

void PhysicsCommandTest::wrong_usage_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("compare cloth.obj --against chance -o out", "--against: 'chance' is not known; use exact or physics");
  row("compare cloth.obj --pins top -o out", "--pins: it is for the comparison with physics; add --against physics");
  row("compare --against physics --pins top -o out", "--pins: the built-in objects are pinned as they are; ");
  row("compare cloth.obj --against physics --pins roof -o out", "--pins: 'roof' is no element's id; ");
  row("compare cloth.obj --against physics --pins 3,25 -o out", "--pins: cloth.obj has no element 25; ");
  row("compare cloth.obj --against physics --pins 3,3 -o out", "--pins: '3' stands there twice; ");
  row("compare cloth.obj --against physics --pins front -o out", "--pins: the object does not extend that way; ");
  row("compare cloth.obj --against physics --pins top --poisson 0.5 -o out", "--poisson: ");
  row("compare cloth.obj --against physics --pins top --young 0 -o out", "--young: ");
  row("compare cloth.obj --against physics --pins top --lattice 9 -o out", "--lattice: ");
  row("compare cloth.obj --against physics --pins top --grow -1 -o out", "--grow: -1 is below 0; ");
  row("compare cloth.obj --against physics --pins top --moves x.json -o out", "--moves: ");
  row("compare cloth.obj --preset none -o out", "--preset: 'none' is neither a preset nor a file; ");
  row("compare cloth.obj --preset cloth.obj -o out", "cloth.obj:1: ");
  row("calibrate", "MESH: it is missing; ");
  row("calibrate none.obj --pins top", "none.obj: ");
  row("calibrate cloth.obj --pins top --algorithm fem", "--algorithm: 'fem' is not known; ");
  row("calibrate cloth.obj --pins top --drags 0", "--drags: '0' ");
  row("calibrate cloth.obj --pins top --evaluations 0", "--evaluations: '0' ");
  row("calibrate cloth.obj --pins top --relaxation none", "--relaxation: 'none' is not known; ");
  row("calibrate cloth.obj --pins top --lattice 4", "--lattice: there is no such option; ");
  row("calibrate cloth.obj --pins top --evaluations 1 -o cloth.obj", "cloth.obj: ");
}

void PhysicsCommandTest::wrong_usage() {
  QFETCH(QString, where);
  check_refused(*program_, QTest::currentDataTag(), where);
}

QTEST_GUILESS_MAIN(PhysicsCommandTest)
#include "test_physics.moc"
