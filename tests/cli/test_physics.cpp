#include <QXmlStreamReader>
#include <algorithm>
#include <array>
#include <cmath>

#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_physics {

using namespace chainmail::test;

/// Tests `chainmail compare --against physics` and `chainmail calibrate`.
class PhysicsCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate cloth 5x5 -o cloth.obj").code, 0);
  }
  void the_report_is_written();
  void drags_and_growth_are_those_of_the_options_data();
  void drags_and_growth_are_those_of_the_options();
  void nothing_pins_it();
  void calibrates_and_saves_a_preset();
  void wrong_usage_data();
  void wrong_usage();

 private:
  static constexpr const char* short_run =
      " --against physics --repetitions 1 --grow 0 --relax 0,5,equilibrium --algorithms exact,fem,neo-hookean,ffd -o "
      "out";

  const QJsonObject report() const { return program_->json("out/report.json"); }

  std::unique_ptr<Program> program_;
};

void PhysicsCommandTest::the_report_is_written() {
  const auto outcome = program_->run(
      "compare cloth.obj --pins top --young 7 --poisson 0.4 --handles 3 --calibrated on" + QByteArray(short_run));
  QVERIFY2(outcome.code == 0 && !outcome.error.contains("note: "), outcome.error);
  QCOMPARE(QDir(program_->path("out")).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
           (QStringList{"after-cut.svg", "fresh-grab.svg", "object-1.svg", "overview.svg", "report.csv", "report.html",
                        "report.json"}));
  for (const char* file : {"out/report.html", "out/object-1.svg"}) {
    QXmlStreamReader reader(program_->read(file));
    while (!reader.atEnd()) {
      reader.readNext();
    }
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  }
  // Drags: four for each of three handles, and one with a cut. Contestants: the object that does not move, Exact
  // without sweeps, with sweeps, at equilibrium, also in open regions, calibrated with sweeps and calibrated at
  // equilibrium, and the three methods of elasticity.
  const auto rows = rows_of(program_->read("out/report.csv"));
  QCOMPARE(std::ranges::count_if(rows, [](const QList<QByteArray>& row) { return !row[5].isEmpty(); }), 13 * 10);
  const auto object = report()["objects"][0];
  QCOMPARE(object["pins"].toInt(), 5);
  const auto contestants = object["drags"][0]["contestants"].toArray();
  QCOMPARE(contestants.size(), 10);
  QCOMPARE(contestants[0]["algorithm"].toString(), QString("nothing"));
  QCOMPARE(contestants[0]["label"].toString(), QString("Nothing moves"));
  const double nothing = contestants[0]["relative"].toDouble();
  QVERIFY(nothing > 0.6 && nothing < 1);
  QCOMPARE(contestants[2]["sweeps"].toInt(), 5);
  QVERIFY(contestants[3]["equilibrium"].toBool() && !contestants[2]["equilibrium"].toBool());
  QCOMPARE(contestants[3]["label"].toString(), QString("Exact + equilibrium"));
  QVERIFY(contestants[3]["relative"].toDouble(9) < contestants[1]["relative"].toDouble());
  QVERIFY(contestants[1]["error_rms"].toDouble() > 0.01);
  QVERIFY(contestants[1]["relative"].toDouble() > contestants[1]["error_rms"].toDouble());
  QVERIFY(contestants[4]["open_regions"].toBool() && contestants[4]["equilibrium"].toBool());
  QCOMPARE(contestants[4]["label"].toString(), QString("Material, multigrid, after Exact ChainMail"));
  QVERIFY(contestants[4]["relative"].toDouble(9) < 0.01);  // the energy is that of the reference
  QVERIFY(contestants[5]["calibrated"]["stretch"].toDouble() >= 1 && !contestants[5]["equilibrium"].toBool());
  QVERIFY(contestants[6]["calibrated"]["lateral"].toDouble() > 0 && contestants[6]["equilibrium"].toBool());
  QCOMPARE(contestants[6]["label"].toString(), QString("Exact + equilibrium, calibrated"));
  QVERIFY(contestants[8]["error_max"].toDouble(1) < 1e-5);  // neo-Hookean FEM itself, with positions in float
  QVERIFY(contestants[8]["label"].toString().endsWith("on the same cells"));
  QVERIFY(contestants[7]["prepare_ms"].toDouble() > 0);
  QVERIFY(contestants[7]["factorize_ms"]["repetitions"].toInt() >= 1 &&
          contestants[7]["grab_ms"]["median"].toDouble() > 0);
  QVERIFY(contestants[7]["first_ms"]["median"].toDouble() > 0);
  const auto cut = object["drags"][12];
  QVERIFY(cut["has_cut"].toBool());
  QVERIFY(cut["contestants"][7]["after_cut_ms"]["median"].toDouble() > 0);
  QVERIFY(object["notes"][0].toString().startsWith("Exact ChainMail calibrated in "));
  QCOMPARE(object["contestants"].toArray().size(), 8);  // turned, without nothing and 5 sweeps
  QCOMPARE(report()["options"]["young"].toDouble(), 7.0);
  QCOMPARE(report()["options"]["poisson"].toDouble(), 0.4);
  QVERIFY(outcome.out.contains("\ncloth.obj: mesh from a file; 25 elements, 56 links, 5 pinned; "));
  QVERIFY(outcome.out.contains("\n  Exact ChainMail, 5 sweeps "));
  QVERIFY(outcome.out.contains("\n  Exact ChainMail, calibrated"));
  QVERIFY(outcome.out.contains("\n  Nothing moves "));
  QVERIFY(outcome.out.contains("\n  Linear FEM, on the same cells "));
  const auto plain = program_->run("compare cloth.obj --pins top --calibrated off" + QByteArray(short_run));
  QVERIFY2(plain.code == 0, plain.error);
  QVERIFY(!plain.out.contains("calibrated"));
}

void PhysicsCommandTest::drags_and_growth_are_those_of_the_options_data() {
  QTest::addColumn<QStringList>("drags");  // of the first object
  QTest::addColumn<bool>("is_full");       // nothing is left out beside drags
  QTest::addColumn<bool>("grows");
  const QStringList of_handle{"nudge", "pull", "bend", "far bend"}, cut{"cut, then move"};
  const auto row = [](const char* options, const QStringList& drags, bool is_full, bool grows) {
    QTest::newRow(options) << drags << is_full << grows;
  };
  row("--grow 0.01", of_handle + of_handle + of_handle + cut, true, true);
  row("--handles 1 --grow 0", of_handle + cut, true, false);
  row("--quick", QStringList{"bend"} + cut, false, false);
  row("--quick --handles 2 --grow 0.01", QStringList{"bend", "bend"} + cut, false, true);
  row("cloth.obj --pins top", of_handle + cut, true, false);
  row("cloth.obj --pins top --handles 2", of_handle + of_handle + cut, true, false);
  row("cloth.obj --pins top --grow 0.01", of_handle + cut, true, true);
  row("cloth.obj --pins top --quick", QStringList{"bend"} + cut, false, false);
  row("cloth.obj --pins top --quick --handles 3 --calibrated on", QStringList{"bend", "bend", "bend"} + cut, false,
      false);
}

/// --quick, --handles and a mesh change what their help says, and nothing else.
void PhysicsCommandTest::drags_and_growth_are_those_of_the_options() {
  QFETCH(const QStringList, drags);
  QFETCH(const bool, is_full);
  QFETCH(const bool, grows);
  const QByteArray options = QTest::currentDataTag();
  const auto outcome =
      program_->run("compare --against physics --repetitions 1 --relax 0 --algorithms exact,fem -o out " + options);
  QVERIFY2(outcome.code == 0 && !outcome.error.contains("note: "), outcome.error);
  const auto objects = report()["objects"].toArray();
  QStringList names;
  for (const QJsonValue drag : objects[0]["drags"].toArray()) {
    names.append(drag["name"].toString());
  }
  QCOMPARE(names, drags);
  QCOMPARE(objects[0].toObject().contains("contestants"), is_full);  // turned objects
  const bool is_calibrated = options.contains("--calibrated on") || (is_full && !options.contains("cloth"));
  QCOMPARE(objects[0]["notes"].toArray().size(), is_calibrated ? 1 : 0);
  const auto is_grown = [](const QJsonValue& object) { return object.toObject().contains("series"); };
  QCOMPARE(std::ranges::any_of(objects, is_grown), grows);
}

void PhysicsCommandTest::nothing_pins_it() {
  for (const char* line : {"compare cloth.obj --against physics -o out", "calibrate cloth.obj"}) {
    const auto outcome = program_->run(line);
    QCOMPARE(outcome.code, 2);
    QCOMPARE(QString::fromUtf8(outcome.error),
             QString("chainmail: cloth.obj: it has no pins, so physics has no solution; add --pins bottom, --pins "
                     "boundary, or --pins ID,ID,…\n"));
  }
  QVERIFY(!program_->files().contains("out"));
}

void PhysicsCommandTest::calibrates_and_saves_a_preset() {
  const char* line =
      "calibrate cloth.obj --pins 20,24,21,22,23 --drags 2 --evaluations 30 --name felt -o felt.json --json out.json";
  const auto outcome = program_->run(line);
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  QVERIFY(outcome.out.contains(" at equilibrium (corotated energy)\n") && outcome.out.contains(", calibrated "));
  const auto preset = program_->json("felt.json")["presets"].toArray().at(0).toObject();
  const QJsonObject result = program_->json("out.json");
  QCOMPARE(preset["name"].toString(), QString("felt"));
  QCOMPARE(preset["stretch"].toDouble(), result["stretch"].toDouble(-1));
  QVERIFY(result["residual"]["rms"].toDouble() > 0 && result["residual"]["max"].toDouble() > 0);
  QCOMPARE(result["drags"].toArray().size(), 2);
  QCOMPARE(result["drags"][0]["residual"].toObject().keys(), (QStringList{"max", "relative", "rms"}));
  // Nothing moves, the default softness, and the one that was found: means over the drags of this name.
  const auto drags = result["objects"][0]["drags"].toArray();
  const auto errors = [&](const char* name, int count) {
    std::array<double, 3> sums{};
    for (const QJsonValue drag : drags) {
      for (std::size_t i = 0; drag["name"] == name && i < sums.size(); ++i) {
        sums[i] += drag["contestants"][qsizetype(i)]["relative"].toDouble(9) / count;
      }
    }
    return sums;
  };
  QCOMPARE(drags.size(), 2 + 4);
  const auto [nothing, before, after] = errors("fitted", 2);
  QVERIFY(nothing > 0.6 && nothing < 1);
  QVERIFY(after < before);
  QVERIFY(std::abs(result["residual"]["relative"].toDouble() - after) < 1e-12);
  const auto held_out = errors("held out", 4);
  QVERIFY(held_out[0] > 0.6 && held_out[0] < 1);
  QVERIFY(held_out[2] > 0 && held_out[2] < 9);
  QVERIFY(outcome.out.contains("held out"));
  const auto swept =
      program_->run("calibrate cloth.obj --pins top --drags 1 --evaluations 5 --relaxation mean --json swept.json");
  QVERIFY2(swept.out.contains(" sweeps per move\n"), swept.error);
  // Runs the same again, and once with the pins by their name.
  const QByteArray first = program_->read("out.json");
  QCOMPARE(program_->run("calibrate cloth.obj --pins top --drags 2 --evaluations 30 --json out.json").code, 0);
  QCOMPARE(program_->read("out.json"), first);
  QCOMPARE(program_->run("calibrate cloth.obj --pins top --seed 9 --drags 2 --evaluations 30 --json out.json").code, 0);
  QVERIFY(program_->read("out.json") != first);
}

void PhysicsCommandTest::wrong_usage_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("compare cloth.obj --against chance -o out", "--against: 'chance' is not known; use exact or physics");
  row("compare cloth.obj --grow 3 -o out", "--grow: it works only with --against physics; add --against physics");
  row("compare cloth.obj --against physics --pins top --material rubber -o out",
      "--material: 'rubber' is not known; use neo-hookean, gent or fung");
  row("compare cloth.obj --preset none -o out", "--preset: 'none' is neither a preset nor a file; ");
  row("calibrate cloth.obj --pins top --algorithm fem", "--algorithm: 'fem' is not known; ");
  row("compare --against physics --handles 0 -o out", "--handles: '0' is not a whole number in range; use 1 to 3");
  row("compare --pins top -o out", "--pins: the built-in objects have their own pins; ");
  row("compare cloth.obj --against physics --pins 3,25 -o out", "--pins: cloth.obj has no element 25; ");
  row("compare --young 2 -o out", "--young: it works only with MESH or --against physics; ");
  row("compare cloth.obj --against physics --pins top --gent-limit 3 -o out",
      "--gent-limit: the material 'gent' does not take part; add --material gent");
  row("compare cloth.obj --against physics --pins top --material fung --fung-exponent 0.8 -o out",
      "--fung-exponent: 0.8 is too high for a Poisson's ratio of 0.3, for which it is at most 0.75; ");
  row("calibrate cloth.obj --pins top --evaluations 1 -o cloth.obj", "cloth.obj: ");
}

void PhysicsCommandTest::wrong_usage() {
  QFETCH(QString, where);
  check_refused(*program_, QTest::currentDataTag(), where);
}

CHAINMAIL_TEST(PhysicsCommandTest)

}  // namespace chainmail::test_physics

#include "test_physics.moc"
