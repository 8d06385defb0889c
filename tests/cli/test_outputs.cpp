#include <csignal>

#include "cli/chainmail_program.h"
#include "files/mesh/mesh_file.h"
#include "program.h"
#include "simulate/simulation.h"

namespace chainmail::test_outputs {

using namespace chainmail::test;

/// Tests the outputs of the subcommands: they are checked before any work, and all are written or none.
class OutputsCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate cloth 6x5 -o cloth.obj").code, 0);
  }
  void the_trace_has_a_row_for_each_candidate();
  void positions_read_back_bit_for_bit();
  void deformed_obj_holds_links_and_cuts();
  void a_dash_is_standard_output();
  void a_report_holds_the_command_as_typed();
  void one_failing_output_leaves_all();
  void what_was_read_is_not_replaced();
  void an_output_is_refused_before_any_work_data();
  void an_output_is_refused_before_any_work();
  void a_full_device_is_status_1();
  void a_signal_leaves_no_temporary_folder();

 private:
  std::unique_ptr<Program> program_;
};

void OutputsCommandTest::what_was_read_is_not_replaced() {
  program_->write("soft.csv", "0,1,0.5,2,0.5\n");
  const QByteArray mesh = program_->read("cloth.obj"), softness = program_->read("soft.csv");
  for (const char* output : {"--json ./cloth.obj", "--positions cloth.obj", "--trace cloth.obj", "--json soft.csv"}) {
    const auto outcome =
        program_->run("deform cloth.obj --algorithm exact --softness soft.csv --by 14:1 " + QByteArray(output));
    QCOMPARE(outcome.code, 2);
    QVERIFY2(outcome.error.contains("it is an input, and this output would replace it; "), outcome.error);
    QCOMPARE(program_->read("cloth.obj"), mesh);
    QCOMPARE(program_->read("soft.csv"), softness);
  }
  QCOMPARE(program_->run("info cloth.obj --json cloth.obj").code, 2);
  QCOMPARE(program_->read("cloth.obj"), mesh);
}

void OutputsCommandTest::the_trace_has_a_row_for_each_candidate() {
  const auto outcome = program_->run(
      "deform cloth.obj --algorithm generalized --by 14:2,1 --by 3:-4 --steps 2 --relax 3 --trace a.csv --json a.json");
  QCOMPARE(outcome.code, 0);
  QVERIFY(program_->read("a.csv").startsWith("pass,order,element,sponsor,moved\n"));
  const auto passes = program_->json("a.json")["passes"].toArray();
  QCOMPARE(passes.size(), 4);
  QList<int> checked(4, 0), moved(4, 0);
  for (const auto& row : rows_of(program_->read("a.csv"))) {
    const int pass = row[0].toInt();
    QCOMPARE(row[1].toInt(), checked[pass]);  // the order starts at 0
    ++checked[pass];
    moved[pass] += row[4].toInt();
    QVERIFY(row[2] != row[3]);
  }
  for (int i = 0; i < 4; ++i) {
    QCOMPARE(passes[i]["checked"].toInt(), checked[i]);
    QCOMPARE(passes[i]["moved"].toInt(), moved[i]);
  }
}

void OutputsCommandTest::positions_read_back_bit_for_bit() {
  QCOMPARE(program_->run("generate grid 6x5 --spacing 0.1 -o grid.dat").code, 0);
  const auto mesh = read_mesh(program_->path("grid.dat").toStdString());
  for (const auto precision : {Precision::double_precision, Precision::single_precision}) {
    const QByteArray option = precision == Precision::double_precision ? "double" : "float";
    const auto outcome = program_->run(
        "deform grid.dat --algorithm natural-queue --by 14:0.7,0.3 --relax 5 --positions a.csv --precision " + option);
    QCOMPARE(outcome.code, 0);
    // The same move with the library.
    Simulation simulation(mesh, Algorithm::natural_queue, precision);
    const auto at = simulation.body().positions();
    const Point target(at(14, 0) + 0.7, at(14, 1) + 0.3, 0);
    simulation.apply(Command(commands::Grab{14}));
    simulation.apply(Command(commands::Drag{target}));
    simulation.relax(5, {1, simulation.relaxation().scheme});
    const auto rows = rows_of(program_->read("a.csv"));
    QCOMPARE(rows.size(), 30);
    for (ElementId e = 0; e < 30; ++e) {
      QCOMPARE(rows[e][0].toUInt(), e);
      QVERIFY(rows[e][1].toDouble() == at(e, 0) && rows[e][2].toDouble() == at(e, 1));
      QCOMPARE(rows[e][3], QByteArray("0"));
    }
  }
}

void OutputsCommandTest::deformed_obj_holds_links_and_cuts() {
  QCOMPARE(program_->run("deform cloth.obj --algorithm spiral --cut 0-1 --by 14:2,1 --positions a.obj").code, 0);
  QCOMPARE(program_->run("deform cloth.obj --algorithm spiral --cut 0-1 --by 14:2,1 --positions a.csv").code, 0);
  program_->run("info a.obj --json a.json");
  const auto info = program_->json("a.json");
  QCOMPARE(info["links"].toInt(), 68);
  QCOMPARE(info["triangles"].toInt(), 39);  // 40 minus the one with the cut link
  const auto rows = rows_of(program_->read("a.csv"));
  const auto lines = program_->read("a.obj").split('\n');
  for (int i = 0; i < rows.size(); ++i) {
    QCOMPARE(lines[i], "v " + rows[i][1] + " " + rows[i][2] + " " + rows[i][3]);
  }
}

void OutputsCommandTest::a_dash_is_standard_output() {
  const auto trace = program_->run("deform cloth.obj --algorithm spiral --by 0:-1 --trace - --json a.json");
  QCOMPARE(trace.code, 0);
  QVERIFY(trace.out.startsWith("pass,order,element,sponsor,moved\n0,0,"));
  QVERIFY(program_->run("deform cloth.obj --algorithm spiral --positions -").out.startsWith("id,x,y,z\n0,0,0,0\n"));
  const auto json = program_->run("deform cloth.obj --algorithm spiral --json -");
  QCOMPARE(QJsonDocument::fromJson(json.out).object()["passes"].toArray().size(), 0);
  const auto twice = program_->run("deform cloth.obj --algorithm spiral --json - --trace -");
  QCOMPARE(twice.code, 2);
  QVERIFY2(is_one_sentence(twice), twice.error);
  const auto found = program_->run("calibrate cloth.obj --pins left --evaluations 1 --drags 1 --json - -o soft.json");
  QCOMPARE(found.code, 0);
  QVERIFY2(QJsonDocument::fromJson(found.out).isObject(), found.out);
}

/// The command in a report can be pasted into a shell.
void OutputsCommandTest::a_report_holds_the_command_as_typed() {
  QVERIFY(QFile::copy(program_->path("cloth.obj"), program_->path("the doctor's.obj")));
  const QString options = QStringLiteral("--algorithms generalized --relax 0 --repetitions 1 -o out");
  const auto outcome = program_->run(QStringList{"compare", "the doctor's.obj"} + options.split(u' '));
  QCOMPARE(outcome.code, 0);
  const QString typed = program_->json("out/report.json")["origin"].toObject()["command_line"].toString();
  QVERIFY2(typed.startsWith(R"(chainmail compare 'the doctor'\''s.obj' --algorithms generalized)"), qPrintable(typed));
}

void OutputsCommandTest::one_failing_output_leaves_all() {
  program_->write("a.csv", "old");
  const auto before = program_->files();
  for (const char* outputs : {"--positions a.csv --json none/a.json", "--trace none/a.csv --positions a.csv",
                              "--positions a.csv --trace ./a.csv", "--positions a.csv --json ."}) {
    const auto outcome = program_->run("deform cloth.obj --algorithm spiral --by 14:2,1 " + QByteArray(outputs));
    QCOMPARE(outcome.code, 2);
    QVERIFY2(is_one_sentence(outcome), outcome.error);
    QCOMPARE(program_->read("a.csv"), QByteArray("old"));
    QCOMPARE(program_->files(), before);
  }
}

void OutputsCommandTest::an_output_is_refused_before_any_work_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const QByteArray& line, const char* where) { QTest::newRow(line) << where; };
  constexpr const char* unknown = "a.xyz: the ending .xyz is not known; ";
  constexpr const char* no_folder = "none/a.obj: its folder does not exist; ";
  constexpr const char* is_input = "bad.obj: it is an input, and this output would replace it; ";
  for (const QByteArray command : {"convert", "fill", "repair", "simplify --elements 9"}) {
    row(command + " none.obj -o a.xyz", unknown);
    row(command + " none.obj -o none/a.obj", no_folder);
    row(command + " bad.obj -o bad.obj", is_input);
  }
  row("generate grid 100000x100000 -o a.xyz", unknown);  // more elements than a mesh may have
  row("generate grid 100000x100000 -o none/a.obj", no_folder);
  row("deform none.obj --algorithm exact --positions a.xyz", "--positions a.xyz: the ending .xyz is not known; ");
  for (const QByteArray line :
       {"repair none.obj -o a.obj --json", "info none.obj --json", "deform none.obj --algorithm exact --positions",
        "deform none.obj --algorithm exact --trace", "deform none.obj --algorithm exact --json",
        "calibrate none.obj -o", "calibrate none.obj --json", "ramp --json", "ramp --csv", "ramp --svg"}) {
    row(line + " none/a.obj", no_folder);
  }
  for (const QByteArray line :
       {"repair bad.obj -o a.obj --json", "info bad.obj --json", "deform bad.obj --algorithm exact --positions",
        "deform cloth.obj --algorithm exact --softness bad.obj --trace",
        "deform cloth.obj --algorithm exact --script bad.obj --json", "calibrate bad.obj -o"}) {
    row(line + " bad.obj", is_input);
  }
  for (const QByteArray line : {"compare", "compare none.obj", "compare --against physics", "compare --suite",
                                "compare --merge none.json", "compare --cases"}) {
    row(line + " -o bad.obj", "-o: bad.obj is not a folder; ");
    if (!line.endsWith("--cases")) {
      row(line + " -o report", "report/report.csv: it is a folder; ");
    }
  }
}

/// The input does not exist or is not what it should be, which is found by work.
void OutputsCommandTest::an_output_is_refused_before_any_work() {
  QFETCH(QString, where);
  program_->write("bad.obj", "0 2 1 3");
  QVERIFY(QDir(program_->path(".")).mkpath("report/report.csv"));
  check_refused(*program_, QTest::currentDataTag(), where);
}

void OutputsCommandTest::a_full_device_is_status_1() {
  if (!QFile::exists("/dev/full")) {
    QSKIP("there is no device that is full");
  }
  const auto before = program_->files();
  const auto outcome =
      program_->run("deform cloth.obj --algorithm spiral --by 14:2,1 --positions a.csv --json /dev/full");
  QCOMPARE(outcome.code, 1);
  QVERIFY2(is_one_sentence(outcome) && outcome.error.startsWith("chainmail: /dev/full: "), outcome.error);
  QCOMPARE(program_->files(), before);
}

/// Ends an import at different times after its folder is there.
void OutputsCommandTest::a_signal_leaves_no_temporary_folder() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    for (int wait = 0; wait < 5; ++wait) {
      QProcess process;
      auto environment = QProcessEnvironment::systemEnvironment();
      environment.insert("TMPDIR", program_->path("."));
      process.setProcessEnvironment(environment);
      process.start(builtFile("bin/chainmail"), {"info", source_file("meshes/organ.msh").c_str()});
      const QDir folder(program_->path("."));
      const auto folders = [&folder] { return folder.entryList({"chainmail-*"}, QDir::Dirs | QDir::NoDotAndDotDot); };
      QVERIFY(process.waitForStarted());
      while (folders().isEmpty() && process.state() != QProcess::NotRunning) {
        process.waitForFinished(1);
      }
      process.waitForFinished(2 * wait);
      ::kill(pid_t(process.processId()), signal);
      QVERIFY(process.waitForFinished());
      QVERIFY2(wait > 0 || process.exitStatus() == QProcess::CrashExit, "the signal came too late");
      QCOMPARE(folders(), QStringList());
    }
  }
}

CHAINMAIL_TEST(OutputsCommandTest)

}  // namespace chainmail::test_outputs

#include "test_outputs.moc"
