#include "cli/chainmail_program.h"
#include "program.h"
#include "solver/algorithms.h"

namespace chainmail::test_deform_model {

using namespace chainmail::test;

/// Tests the options of `chainmail deform` that describe the model: frames, pins, softness of single links.
class DeformModelTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    program_ = std::make_unique<Program>();
    QCOMPARE(program_->run("generate line 4 -o line.dat").code, 0);
  }
  void regions_lie_along_a_frame();
  void a_large_object_is_fine_only_where_needed();
  void what_does_not_fit_is_refused_data();
  void what_does_not_fit_is_refused();

 private:
  std::unique_ptr<Program> program_;
};

void DeformModelTest::regions_lie_along_a_frame() {
  QCOMPARE(program_->run("generate grid 5x4 -o grid.obj").code, 0);
  const auto largest_difference = [this](const QByteArray& frame) {
    const auto positions = [&](const QByteArray& options) {
      const auto outcome = program_->run(
          "deform grid.obj --algorithm exact --move 19:6,5 --positions out.csv --json out.json " + options);
      return outcome.code == 0 ? rows_of(program_->read("out.csv")) : decltype(rows_of(QByteArray()))();
    };
    const auto world = positions(""), turned = positions(frame);
    double largest = world.size() == turned.size() ? 0 : 1e9;
    for (qsizetype i = 0; i < std::min(world.size(), turned.size()); ++i) {
      for (int k = 1; k <= 2; ++k) {
        largest = std::max(largest, std::abs(world[i][k].toDouble() - turned[i][k].toDouble()));
      }
    }
    return largest;
  };
  QCOMPARE(largest_difference("--frame axes"), 0.0);
  QCOMPARE(largest_difference("--frame object"), 0.0);  // its sides lie along the axes
  QVERIFY(largest_difference("--frame z:90") < 1e-12);
  QVERIFY(largest_difference("--frame z:45") > 0.1);
  const QJsonObject report = program_->json("out.json");
  QVERIFY(report["violation"]["max"].toDouble() < 1e-12);  // measured in the frame
  QVERIFY(program_->run("deform grid.obj --algorithm exact --move 19:6,5 --frame object").error.isEmpty());
  QCOMPARE(program_->run("generate grid 4x4 -o square.obj").code, 0);
  const auto square = program_->run("deform square.obj --algorithm exact --move 15:6,5 --frame object");
  QCOMPARE(square.code, 0);
  QVERIFY2(square.error.startsWith("chainmail: --frame object: the object has equal spreads"), square.error);
}

void DeformModelTest::a_large_object_is_fine_only_where_needed() {
  QCOMPARE(program_->run("generate tetra 17x17x17 -o solid.msh").code, 0);
  const QByteArray drag =
      "deform solid.msh --algorithm exact --compression 0 --stretch 3 --shear 2 --pin left --grab 4910-4912 --by 0,0,2 "
      "--steps 3 --relaxation equilibrium --positions a.csv --json a.json ";
  QCOMPARE(program_->run(drag + "--local on").code, 0);
  const QJsonObject local = program_->json("a.json");
  const auto at_local = rows_of(program_->read("a.csv"));
  QCOMPARE(local["relaxation"]["milliseconds"].toArray().size(), 3);
  QVERIFY(local["relaxation"]["nodes"].toInt() > 0 && local["relaxation"]["nodes"].toInt() < 17 * 17 * 17);
  QVERIFY(local["relaxation"]["estimate"].toDouble(1) < 0.2);
  QVERIFY(!local.contains("equilibrium"));  // it has no certificate
  QCOMPARE(program_->run(drag + "--local off").code, 0);
  const QJsonObject whole = program_->json("a.json");
  QVERIFY(!whole.contains("relaxation") && whole.contains("equilibrium"));
  const auto at_whole = rows_of(program_->read("a.csv"));
  QVERIFY(at_local != at_whole);
  QVERIFY(local["energy"].toDouble() < 1.3 * whole["energy"].toDouble());
  const auto sweeps = program_->run("deform solid.msh --algorithm exact --by 0:1 --local on");
  QVERIFY2(sweeps.code == 2 && sweeps.error.startsWith("chainmail: --local: "), sweeps.error);
}

void DeformModelTest::what_does_not_fit_is_refused_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* options, const char* where) { QTest::newRow(options) << where; };
  for (const char* act : {"--pin 4", "--pin -1", "--pin x", "--pin 1-2", "--pin 0.5", "--pin 0,1"}) {
    row(act, act);
  }
  row("--pin 2 --by 2:1", "--by 2:1: element 2 is already pinned");
  row("--frame z:45", "--frame: turned about z, its axes would leave the space of the object");  // a line
  row("--softness bad.csv", "bad.csv:2: ");
}

void DeformModelTest::what_does_not_fit_is_refused() {
  QFETCH(QString, where);
  program_->write("ok.csv", "0,1,1,1,0\n");
  program_->write("bad.csv", "0,1,1,1,0\n0,1,1,1,0\n");
  const auto before = program_->files();
  const auto outcome =
      program_->run(QStringList{"deform", "line.dat", "--algorithm", "exact", "--positions", "a.csv", "--by", "0:1"} +
                    QString(QTest::currentDataTag()).split(' '));
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QCOMPARE(program_->files(), before);
}

CHAINMAIL_TEST(DeformModelTest)

}  // namespace chainmail::test_deform_model

#include "test_deform_model.moc"
