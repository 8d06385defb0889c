#include <QXmlStreamReader>

#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_compare {

using namespace chainmail::test;

/// Tests `chainmail compare`: its three files and its output. It writes all of them or none.
class CompareCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate grid 6x5 -o grid.dat").code, 0);
    QCOMPARE(program_->run("generate cloth 6x5 -o cloth.obj").code, 0);
  }
  void writes_the_report();
  void options_are_taken();
  void a_quick_run_has_the_first_drag();
  void slow_contestants_are_left_out_by_name();
  void plots_of_an_older_report_are_named();
  void wrong_usage_data();
  void wrong_usage();
  void folders_that_cannot_be_are_refused();
  void nothing_is_left_where_a_file_cannot_be_written();

 private:
  static constexpr const char* short_run = " --repetitions 1 --algorithms natural-queue,original,exact -o out";

  QStringList report_files() const {
    return QDir(program_->path("out")).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }

  /// Content of report.json. It is constant, so that lookups by name can be chained.
  const QJsonObject report(const QString& folder = "out") const { return program_->json(folder + "/report.json"); }

  std::unique_ptr<Program> program_;
};

void CompareCommandTest::writes_the_report() {
  const auto outcome = program_->run("compare grid.dat cloth.obj" + QByteArray(short_run));
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  QCOMPARE(report_files(), (QStringList{"distance-1.svg", "distance-2.svg", "report.csv", "report.html", "report.json",
                                        "violation-1.svg", "violation-2.svg"}));
  // Two meshes, three drags each, three algorithms without and with sweeps, two of them at equilibrium too.
  QCOMPARE(program_->read("out/report.csv").count('\n'), 1 + 2 * 3 * (3 * 2 + 2));
  const auto objects = report()["objects"].toArray();
  QCOMPARE(objects.size(), 2);
  QCOMPARE(objects[1]["name"].toString(), QString("cloth.obj"));
  const auto contestants = objects[1]["drags"][0]["contestants"].toArray();
  QVERIFY(contestants[3]["refusal"].toString().contains("only on grids"));
  QVERIFY(contestants[5]["exact_distance_max"].toDouble(1) < 1e-5);  // Exact itself, in float
  QXmlStreamReader page(program_->read("out/report.html"));
  while (!page.atEnd()) {
    page.readNext();
  }
  QVERIFY2(!page.hasError(), qPrintable(page.errorString()));
}

void CompareCommandTest::options_are_taken() {
  const auto contestants = [&](const char* options) -> const QJsonArray {
    const auto outcome = program_->run("compare grid.dat --repetitions 3 -o out " + QByteArray(options));
    if (outcome.code != 0) {
      qWarning("%s", outcome.error.constData());
    }
    return report()["objects"][0]["drags"][1]["contestants"].toArray();
  };
  const auto two = contestants("--algorithms exact,spiral --relax 5 --precision double --relaxation link");
  QCOMPARE(two.size(), 2);
  QCOMPARE(two[1]["algorithm"].toString(), QString("spiral"));
  QCOMPARE(two[1]["sweeps"].toInt(), 5);
  QCOMPARE(two[1]["ms_per_move"]["repetitions"].toInt(), 3);
  const auto options = report()["options"];
  QCOMPARE(options["precision"].toString(), QString("double"));
  QCOMPARE(options["relaxation"].toString(), QString("link"));
  QCOMPARE(contestants("--algorithms exact --relax 0 --precision double")[0]["exact_distance_max"].toDouble(1), 0.0);
  // Links that cannot stretch move all elements at once.
  const auto soft = contestants("--algorithms exact --relax 0")[0]["moved_per_move"].toDouble();
  const auto stiff =
      contestants("--algorithms exact --relax 0 --stretch 1 --compression 1 --shear 0")[0]["moved_per_move"].toDouble();
  QCOMPARE(stiff, 29.0);
  QVERIFY(soft > 0 && soft < stiff);
}

/// Other options work as without it.
void CompareCommandTest::a_quick_run_has_the_first_drag() {
  const auto outcome = program_->run("compare grid.dat cloth.obj --quick" + QByteArray(short_run));
  QVERIFY2(outcome.code == 0 && outcome.error.isEmpty(), outcome.error);
  const auto objects = report()["objects"].toArray();
  QCOMPARE(objects.size(), 2);
  for (const QJsonValue object : objects) {
    QCOMPARE(object["drags"].toArray().size(), 1);
    QCOMPARE(object["drags"][0]["name"].toString(), QString("local"));
    QCOMPARE(object["drags"][0]["contestants"][0]["ms_per_move"]["repetitions"].toInt(), 1);
  }
  QCOMPARE(program_->run("compare grid.dat --algorithms exact --repetitions 1 -o out").code, 0);
  QCOMPARE(report()["objects"][0]["drags"].toArray().size(), 3);
}

/// A million sweeps of ten thousand elements after each move take minutes. Those who make them are in a note, and the
/// rows say why they have no figures.
void CompareCommandTest::slow_contestants_are_left_out_by_name() {
  QCOMPARE(program_->run("generate grid 100x100 -o large.dat").code, 0);
  const auto outcome = program_->run("compare large.dat --quick --relax 0,1000000 -o out");
  QCOMPARE(outcome.code, 0);
  QStringList left_out;
  for (const QJsonValue contestant : report()["objects"][0]["drags"][0]["contestants"].toArray()) {
    QCOMPARE(contestant.toObject().contains("refusal"), contestant["sweeps"].toInt() > 0);
    if (contestant["sweeps"].toInt() > 0) {
      QVERIFY(contestant["refusal"].toString().startsWith("left out after 2 s"));
      left_out.append(contestant["label"].toString());
    }
  }
  QVERIFY(!left_out.isEmpty());
  const QString note = "note: left out, because they take longer than 2 s: " + left_out.join("; ") + "\n";
  QVERIFY2(outcome.error.contains(note.toUtf8()), outcome.error);
}

/// A plot beside the new report looks as if it belonged to it. Files of others are not named, and all of them stay.
void CompareCommandTest::plots_of_an_older_report_are_named() {
  QVERIFY(QDir(program_->path(".")).mkdir("out"));
  const QStringList plots{"growth-time.svg", "object-1.svg", "object-2.svg", "overview.svg"};
  for (const QString& name : plots + QStringList{"mine.svg", "object-4.svg"}) {
    program_->write("out/" + name, "<svg/>");
  }
  const auto outcome = program_->run("compare grid.dat" + QByteArray(short_run));
  QCOMPARE(outcome.code, 0);
  QCOMPARE(QString::fromUtf8(outcome.error),
           "chainmail: note: out also has plots of an earlier report: " + plots.join(", ") + "\n");
  QCOMPARE(report_files().size(), 5 + plots.size() + 2);
}

void CompareCommandTest::wrong_usage_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("compare grid.dat", "-o: it is missing; ");
  row("compare grid.dat none.dat -o out", "none.dat: ");
  row("compare grid.dat -o grid.dat/out", "-o: grid.dat is not a folder; ");
  row("compare grid.dat --algorithms exact,exact -o out", "--algorithms: 'exact' is given twice; ");
  row("compare grid.dat --relax 0,-1 -o out", "--relax: '-1' ");
  row("compare grid.dat --moves grid.dat -o out", "grid.dat:1: it is not JSON; ");
  row("compare --moves grid.dat -o out", "--moves: the mesh of the recorded moves is missing; ");
}

void CompareCommandTest::wrong_usage() {
  QFETCH(QString, where);
  check_refused(*program_, QTest::currentDataTag(), where);
}

void CompareCommandTest::folders_that_cannot_be_are_refused() {
  const auto outcome = program_->run(QStringList{"compare", "grid.dat", "-o", ""});
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  if (!QFile::exists("/proc/version")) {
    QSKIP("there is no folder that nobody can write to");
  }
  const auto closed = program_->run("compare grid.dat -o /proc/none");
  QCOMPARE(closed.code, 2);
  QVERIFY2(is_one_sentence(closed) && closed.error.startsWith("chainmail: -o: "), closed.error);
}

void CompareCommandTest::nothing_is_left_where_a_file_cannot_be_written() {
  QVERIFY(QDir(program_->path("")).mkpath("out/report.csv"));  // a folder at the path of an output file
  const auto outcome = program_->run("compare grid.dat" + QByteArray(short_run));
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QCOMPARE(report_files(), QStringList{"report.csv"});
}

CHAINMAIL_TEST(CompareCommandTest)

}  // namespace chainmail::test_compare

#include "test_compare.moc"
