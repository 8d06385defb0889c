#include <QJsonArray>
#include <csignal>

#include "cli/chainmail_program.h"
#include "folders.h"
#include "program.h"
#include "solver/algorithms.h"

namespace chainmail::test_deform {

using namespace chainmail::test;

/// Tests `chainmail deform`: order of acts, steps, relaxation, precision. Expected values are computed by hand for a
/// chain whose links have length 1 and may be 0.8 to 1.2 long.
class DeformCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate line 4 -o line.dat").code, 0);
    QCOMPARE(program_->run("generate grid 5x4 -o grid.dat").code, 0);
  }
  void a_chain_follows();
  void acts_are_carried_out_in_their_order();
  void a_handle_of_many_moves_and_rotates();
  void a_script_is_carried_out_before_the_acts();
  void sweeps_are_interrupted_at_once_data();
  void sweeps_are_interrupted_at_once();
  void acts_that_do_not_fit_are_refused_data();
  void acts_that_do_not_fit_are_refused();
  void a_split_divides_cells_where_they_are();
  void a_split_divides_a_surface();
  void cells_with_a_cut_link_do_not_count();
  void a_recorded_split_is_replayed();
  void splits_that_do_not_fit_are_refused_data();
  void splits_that_do_not_fit_are_refused();

 private:
  /// Returns the final positions of a deformation, in rows x, y, z.
  QList<QList<double>> deform(const QByteArray& options, const char* mesh = "line.dat") {
    const auto outcome =
        program_->run("deform " + options + " --positions out.csv --json out.json " + QByteArray(mesh));
    if (outcome.code != 0) {
      qWarning("%s", outcome.error.constData());
    }
    QList<QList<double>> positions;
    for (const auto& row : rows_of(program_->read("out.csv"))) {
      positions.append({row[1].toDouble(), row[2].toDouble(), row[3].toDouble()});
    }
    return positions;
  }
  QList<double> xs(const QByteArray& options, const char* mesh = "line.dat") {
    QList<double> result;
    for (const auto& position : deform("--algorithm natural-queue " + options, mesh)) {
      result.append(position[0]);
    }
    return result;
  }

  std::unique_ptr<Program> program_;
};

void DeformCommandTest::a_chain_follows() {
  // Element 0 moves to -1. Each of the others stays at most 1.2 behind the one before.
  QCOMPARE(xs("--move 0:-1"), (QList<double>{-1, -1 + 1.2, -1 + 1.2 + 1.2, -1 + 1.2 + 1.2 + 1.2}));
  QCOMPARE(xs("--by 3:-0.5"), (QList<double>{0, 2.5 - 0.8 - 0.8, 2.5 - 0.8, 2.5}));
  const auto json = program_->json("out.json");
  QCOMPARE(json["passes"][0]["element"].toInt(), 3);
  QCOMPARE(json["passes"][0]["moved"].toInt(), 2);
  QCOMPARE(json["passes"][0]["checked"].toInt(), 3);  // 0 is near enough to stay
  QVERIFY(json["violation"]["max"].toDouble() < 1e-12);
  // The links of rest length 1 are now 0.9, 0.8 and 0.8 long. On a line, energy is 1 + b times the isotropic one.
  const double isotropic = (0.1 * 0.1 + 0.2 * 0.2 + 0.2 * 0.2) / 2;
  QVERIFY(std::abs(json["energy"].toDouble() - 2 * isotropic) < 1e-12);
  const auto energy = [&](const QByteArray& options) {
    xs("--by 3:-0.5 " + options);
    return program_->json("out.json")["energy"].toDouble();
  };
  QVERIFY(std::abs(energy("--energy isotropic --stiffness 3") - isotropic) < 1e-12);
  QVERIFY(std::abs(energy("--energy axial --stiffness 3 --lateral 0.5") - 3 * 1.5 * isotropic) < 1e-12);
  QVERIFY(std::abs(energy("--energy corotated --lateral 0") - isotropic) < 1e-12);
}

void DeformCommandTest::acts_are_carried_out_in_their_order() {
  QCOMPARE(xs("--cut 0-1 --move 0:-5"), (QList<double>{-5, 1, 2, 3}));
  QCOMPARE(xs("--cut 1-0 --move 0:-5"), (QList<double>{-5, 1, 2, 3}));
  const double far = -5 + 1.2;
  QCOMPARE(xs("--move 0:-5 --cut 0-1"), (QList<double>{-5, far, far + 1.2, far + 1.2 + 1.2}));
  QCOMPARE(xs("--by 0:-5 --cut 0-1 --move 0:0 --by 0:1 --cut 2-3")[0], 1.0);
  QCOMPARE(xs("--by 0:-5 --cut 0-1 --move 0:0 --by 0:1 --cut 2-3")[1], far);
  QCOMPARE(xs("--by 0:1 --move 0:7")[0], 7.0);
  QCOMPARE(xs("--move 0:7 --by 0:1")[0], 8.0);
  QCOMPARE(program_->json("out.json")["passes"].toArray().size(), 2);
}

/// Elements 7 and 8 lie at (2, 1) and (3, 1).
void DeformCommandTest::a_handle_of_many_moves_and_rotates() {
  using Row = QList<double>;
  const auto near = [](const Row& a, const Row& b) {
    return std::abs(a[0] - b[0]) < 1e-12 && std::abs(a[1] - b[1]) < 1e-12;
  };
  auto rows = deform("--algorithm natural-queue --grab 7,8 --by 1,0.5", "grid.dat");
  QVERIFY(near(rows[7], {3, 1.5}) && near(rows[8], {4, 1.5}));
  rows = deform("--algorithm natural-queue --steps 3 --grab 7-8 --rotate z:90 --by 0.5 --by 0,1", "grid.dat");
  QVERIFY(near(rows[7], {3, 1.5}) && near(rows[8], {3, 2.5}));
  const QJsonValue json = program_->json("out.json")["passes"];
  QCOMPARE(json.toArray().size(), 9);
  QCOMPARE(json[8]["elements"], QJsonValue(QJsonArray({7, 8})));
  QVERIFY(std::abs(json[8]["target"][0].toDouble() - 3) < 1e-12);
  QCOMPARE(json[8]["rotate"]["degrees"].toDouble(), 90.0);
  QVERIFY(std::abs(json[0]["rotate"]["degrees"].toDouble() - 30) < 1e-12);
  // Rotations about different axes follow each other: x to y about z, then y to z about x.
  rows = deform("--algorithm spiral --space 3 --grab 7,8 --rotate 0,0,5:90 --rotate x:90", "grid.dat");
  QVERIFY(near(rows[7], {2.5, 1}) && std::abs(rows[7][2] + 0.5) < 1e-12 && std::abs(rows[8][2] - 0.5) < 1e-12);
  // A layer by its name.
  rows = deform("--algorithm natural-queue --grab top --by 0,1 --by 0,1", "grid.dat");
  QVERIFY(near(rows[15], {0, 5}) && near(rows[19], {4, 5}) && !near(rows[10], {0, 2}));
  // The same in a script.
  program_->write("moves.json", R"({"version": 1, "commands": [{"do": "grab", "elements": [7, 8]},
      {"do": "drag", "by": [1, 0, 0], "rotate": {"axis": [0, 0, 1], "degrees": 90}}]})");
  rows = deform("--algorithm natural-queue --script moves.json", "grid.dat");
  QVERIFY(near(rows[7], {3.5, 0.5}) && near(rows[8], {3.5, 1.5}));
  const auto text = program_->run("deform grid.dat --algorithm exact --grab 6-8,11-13 --rotate z:80").out;
  QVERIFY2(text.contains("pass 0: 6 elements to (2, 1.5, 0), rotated by 80 degrees about (0, 0, 1)"), text);
  QVERIFY2(text.contains("degrees by links outside the handle, or by pins"), text);
}

void DeformCommandTest::a_script_is_carried_out_before_the_acts() {
  program_->write("moves.json", R"({"version": 1, "commands": [{"do": "cut", "links": [[2, 3]]},
    {"do": "grab", "element": 0}, {"do": "drag", "target": [-1, 0, 0]}, {"do": "release"},
    {"do": "relax", "sweeps": 0}]})");
  // 1 and 2 follow 0, each 1.2 behind the one before. 3 is cut off, and only its own act moves it.
  QCOMPARE(xs("--script moves.json --by 3:5"), (QList<double>{-1, -1 + 1.2, -1 + 1.2 + 1.2, 8}));
  QCOMPARE(program_->json("out.json")["passes"].toArray().size(), 2);
  program_->write("bad.json", R"({"version": 1, "commands": [{"do": "relax", "sweeps": -1}]})");
  const auto outcome = program_->run("deform --algorithm exact --script bad.json line.dat");
  QCOMPARE(outcome.code, 2);
  QVERIFY(is_one_sentence(outcome) && outcome.error.contains("bad.json: command 0: 'sweeps'"));
}

void DeformCommandTest::sweeps_are_interrupted_at_once_data() {
  QTest::addColumn<QByteArray>("options");
  QTest::newRow("after each pass") << QByteArray("--by 0:-90,-70 --relax 1000000");
  QTest::newRow("of a script") << QByteArray("--script moves.json");
}

/// Ctrl+C ends a run that would take hours, and no output is written.
void DeformCommandTest::sweeps_are_interrupted_at_once() {
  QFETCH(QByteArray, options);
  QCOMPARE(program_->run("generate grid 300x300 -o large.obj").code, 0);
  program_->write("moves.json", R"({"version": 1, "commands": [{"do": "grab", "element": 0},
    {"do": "drag", "target": [-90, -70, 0]}, {"do": "relax", "sweeps": 1000000}]})");
  const auto before = program_->files();
  QProcess process;
  process.setWorkingDirectory(program_->path({}));
  process.start(builtFile("bin/chainmail"),
                QString::fromUtf8("deform large.obj --algorithm natural-queue --json out.json " + options).split(' '));
  QVERIFY(!process.waitForFinished(3000));  // by then it has read the mesh and relaxes
  QCOMPARE(::kill(pid_t(process.processId()), SIGINT), 0);
  QVERIFY(process.waitForFinished(2000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);  // by the signal, as shells expect
  QCOMPARE(program_->files(), before);
}

void DeformCommandTest::acts_that_do_not_fit_are_refused_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* options, const char* where) { QTest::newRow(options) << where; };
  for (const char* act :
       {"--move 20:1", "--move -1:1",  "--move 3",         "--move 3:",      "--move :1",    "--move x:1",
        "--move 3:1,", "--move 3:,1",  "--move 3:1,2,0,0", "--move 3:1,2,3", "--move 3:nan", "--by 3:1e999",
        "--by 3:1x",   "--by 3:0,0,1", "--cut 0",          "--cut 0-2",      "--cut 0-0",    "--cut 0-20",
        "--cut 0-1-2", "--cut -",      "--cut 0:1",        "--grab 20",      "--grab 3,3",   "--grab 5-3",
        "--grab x",    "--grab 1,,2",  "--grab 1-",        "--grab 1-99999", "--grab 0:1",   "--by 1,1",
        "--by 3",      "--rotate z:3"}) {
    row(act, act);
  }
  for (const char* rotation : {"--rotate z", "--rotate z:", "--rotate :5", "--rotate w:5", "--rotate 0,1:5",
                               "--rotate 0,0,0:5", "--rotate 1,0,0:5", "--rotate x:5", "--rotate z:nan"}) {
    row(("--grab 1,2 " + std::string(rotation)).c_str(), rotation);
  }
  row("--pin 2 --grab 1-3", "--grab 1-3");
  row("--grab 1-3 --cut 0-1 --by 1,1", "--by 1,1");
  row("--grab 1-3 --by 1e308,0 --by 1e308,0", "--by 1e308,0: element 1");
  row("--by 3:1e308 --by 3:1e308", "--by 3:1e308: element 3");
  row("--precision float --by 3:1e39", "--by 3:1e39: element 3");
  row("--space 1 --by 3:1", "--space 1");
}

void DeformCommandTest::acts_that_do_not_fit_are_refused() {
  QFETCH(QString, where);
  const auto options = QString(QTest::currentDataTag()).split(' ');
  const auto before = program_->files();
  const auto outcome = program_->run(
      QStringList{"deform", "grid.dat", "--algorithm", "spiral", "--positions", "a.csv", "--by", "0:1"} + options);
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where + ": "), outcome.error);
  QCOMPARE(program_->files(), before);
}

/// A blade through a block of 36 cubes, six cells each. Element 4 is in the other part than element 0.
void DeformCommandTest::a_split_divides_cells_where_they_are() {
  QCOMPARE(program_->run("generate tetra 5x4x4 -o block.vtu").code, 0);
  const QByteArray method = "--algorithm natural-queue ", pull = "--move 0:-9,0,0 ";
  const QByteArray split = "--split 1.3,-1,0;2.6,5,0 --along 0.1,0.2,-1 ";
  const auto rows = deform(method + split + pull, "block.vtu");
  const QJsonObject json = program_->json("out.json");
  const auto is_whole = [](const QJsonValue& volume) { return std::abs(volume.toDouble() / 36 - 1) < 1e-12; };
  QVERIFY(rows.size() > 80);
  QCOMPARE(json["elements"].toInt(), int(rows.size()));
  QVERIFY(json["cells"].toInt() > 216);
  QCOMPARE(json["parts"].toInt(), 2);
  QVERIFY(is_whole(json["volume"]["rest"]));
  QVERIFY(!is_whole(json["volume"]["now"]));  // the part of element 0 is stretched
  QVERIFY(json["worst_quality"].toDouble() >= 0.15 - 1e-12 && json["worst_quality"].toDouble() < 0.7);
  QCOMPARE(rows[4], (QList<double>{4, 0, 0}));
  QVERIFY(rows[1][0] < 0);
  // Before the split, element 0 pulls the whole block away from the line.
  QVERIFY(deform(method + pull, "block.vtu")[4][0] < 0);
  for (const char* far : {"1e300", "1e308"}) {
    const auto refused =
        program_->run("deform block.vtu " + method + "--split 1.3,-1,0;1.3," + far + ",0 --along 0,0,1");
    QCOMPARE(refused.code, 2);
    QVERIFY2(is_one_sentence(refused) && refused.error.contains("a coordinate is too large"), refused.error);
  }
  const auto outcome = program_->run("deform block.vtu " + method + pull + split);
  QCOMPARE(outcome.code, 2);
  QVERIFY2(outcome.error.startsWith("chainmail: --split 1.3,-1,0;2.6,5,0: nothing comes apart; "), outcome.error);
  const auto later = deform(method + "--grab 0-79 --by 10 --split 11.3,-1,0;12.6,5,0 --along 0.1,0.2,-1", "block.vtu");
  QCOMPARE(later.size(), rows.size());
  const QJsonObject moved = program_->json("out.json");
  QVERIFY(is_whole(moved["volume"]["now"]));
  // A second blade across the first, and a pin on what the first has made.
  deform(method + split + "--pin 80 --split -1,1.5,0;5,1.6,0 --along 0,0,1", "block.vtu");
  QCOMPARE(program_->json("out.json")["parts"].toInt(), 4);
}

void DeformCommandTest::a_split_divides_a_surface() {
  QCOMPARE(program_->run("generate cloth 5x4 -o cloth.obj").code, 0);
  const auto rows = deform("--algorithm spiral --split 1.3,-1;1.6,9 --move 0:-9,0", "cloth.obj");
  QVERIFY(rows.size() > 20);
  QCOMPARE(rows[4], (QList<double>{4, 0, 0}));
  QVERIFY(rows[1][0] < 0);
  QVERIFY(!program_->json("out.json").contains("cells"));
  // In space, a blade also cuts along a slope.
  const auto same =
      deform("--algorithm spiral --space 3 --split 1.3,-1,1;1.6,9,1 --along 0,0,-3 --move 0:-9,0", "cloth.obj");
  QCOMPARE(same.size(), rows.size());
  const auto slope =
      deform("--algorithm spiral --space 3 --split 0.3,-1,1;0.6,9,1 --along 1,0,-1 --move 0:-9,0", "cloth.obj");
  QCOMPARE(slope.size(), rows.size());
  QCOMPARE(slope[4], (QList<double>{4, 0, 0}));
}

/// Link 0-1 is an edge of two of the six cells of a cube.
void DeformCommandTest::cells_with_a_cut_link_do_not_count() {
  QCOMPARE(program_->run("generate tetra 2x2x2 -o cube.vtu").code, 0);
  deform("--algorithm spiral --cut 0-1", "cube.vtu");
  const QJsonObject json = program_->json("out.json");
  QCOMPARE(json["cells"].toInt(), 4);
  QCOMPARE(json["parts"].toInt(), 1);
  QVERIFY(std::abs(json["volume"]["rest"].toDouble() - 4.0 / 6) < 1e-12);
}

/// Two tetrahedra with a face in common, whose elements are doubled. Then an act names one of the new elements.
void DeformCommandTest::a_recorded_split_is_replayed() {
  program_->write("two.mesh",
                  "MeshVersionFormatted 2 Dimension 3 Vertices 5 0 0 0 1 1 0 0 1 0 1 0 1 0 0 1 1 1 1 1 1 Tetrahedra 2 "
                  "1 2 3 4 1 2 3 4 5 1 End");
  program_->write("moves.json", R"({"version": 4, "commands": [{"do": "split",
    "elements": [[1, 1, 1, 0, 0], [2, 2, 2, 0, 0], [3, 3, 3, 0, 0]],
    "removed_cells": [1], "tetrahedra": [[5, 6, 7, 4]]}]})");
  const auto rows = deform("--algorithm spiral --script moves.json --by 7:5", "two.mesh");
  QCOMPARE(rows.size(), qsizetype{8});
  QCOMPARE(rows[3], (QList<double>{0, 0, 1}));
  QCOMPARE(rows[7], (QList<double>{5, 0, 1}));
  QVERIFY(rows[4][0] > 1);
  QCOMPARE(program_->json("out.json")["parts"].toInt(), 2);
}

void DeformCommandTest::splits_that_do_not_fit_are_refused_data() {
  QTest::addColumn<QString>("mesh");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* mesh, const char* options, const char* sentence) {
    QTest::newRow(options) << mesh << sentence;
  };
  row("block.vtu", "--split 1,1,1 --along 0,0,1", "--split 1,1,1: its line has fewer than two points");
  row("block.vtu", "--split 1,-1;nan,9 --along 0,0,1", "--split 1,-1;nan,9: 'nan' is not a finite number");
  row("block.vtu", "--split 1,-1;1,9", "--split 1,-1;1,9: it has no direction");
  row("block.vtu", "--split 1,-1;1,9 --along 0,0,0", "--split 1,-1;1,9: its direction is not finite or has the length");
  row("block.vtu", "--split 9,-1;9,9 --along 0,0,1", "--split 9,-1;9,9: nothing comes apart");
  row("block.vtu", "--split 1,0,-1;1,0,9 --along 0,0,1", "--split 1,0,-1;1,0,9: nothing comes apart");
  row("block.vtu", "--along 0,0,1", "--along 0,0,1: there is no --split");
  row("block.vtu", "--split 1,-1;1,9 --along 0,0,1 --along 0,0,2", "--along 0,0,2: there is no --split");
  row("block.vtu", "--split 1,-1;1,9 --pin 0 --along 0,0,1", "--along 0,0,1: there is no --split");
  row("block.vtu", "--split 1.5,-1;1.5,9 --along 0,0,1 --cut 1-2", "--cut 1-2: these elements are not linked");
  row("block.vtu", "--split 1.5,-1;1.5,9 --along 0,0,1 --pin 999", "--pin 999: there is no element 999");
  row("large.vtu", "--split 1.5,-1;1.5,99 --along 0,0,1", "--split 1.5,-1;1.5,99: ");
  row("cloth.obj", "--split 1.5,-1;1.5,9 --along 1,0,0", "--split 1.5,-1;1.5,9: its direction lies in the plane");
  row("cloth.obj", "--split 1.5,-1,1;1.5,9,1", "--split 1.5,-1,1;1.5,9,1: the object does not extend along z");
  row("grid.dat", "--split 1.5,-1;1.5,9", "--split 1.5,-1;1.5,9: the object has neither cells nor faces");
}

void DeformCommandTest::splits_that_do_not_fit_are_refused() {
  QFETCH(QString, mesh);
  QFETCH(QString, sentence);
  for (const char* line : {"generate tetra 4x3x3 -o block.vtu", "generate cloth 4x4 -o cloth.obj",
                           "generate tetra 60x10x10 -o large.vtu"}) {
    QVERIFY(!QString(line).endsWith(mesh) || program_->run(line).code == 0);
  }
  const auto before = program_->files();
  // With its new elements, the large block is too large for the method.
  const char* const method = mesh == "large.vtu" ? "corotational" : "exact";
  const auto outcome = program_->run(QStringList{"deform", mesh, "--algorithm", method, "--positions", "a.csv"} +
                                     QString(QTest::currentDataTag()).split(' '));
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + sentence), outcome.error);
  QCOMPARE(program_->files(), before);
}

CHAINMAIL_TEST(DeformCommandTest)

}  // namespace chainmail::test_deform

#include "test_deform.moc"
