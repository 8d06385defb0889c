#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_generate {

using namespace chainmail::test;

/// Tests `chainmail generate`: all kinds of meshes, both formats.
class GenerateCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void kinds_data();
  void kinds();
  void a_dash_is_standard_output();
  void refused_data();
  void refused();
};

void GenerateCommandTest::kinds_data() {
  QTest::addColumn<int>("elements");
  QTest::addColumn<int>("links");
  QTest::addColumn<int>("space");
  QTest::newRow("line 5") << 5 << 4 << 1;
  QTest::newRow("grid 4x3") << 12 << 17 << 2;
  QTest::newRow("cloth 4x3") << 12 << 23 << 2;    // 17 sides and 6 diagonals
  QTest::newRow("block 2x3x4") << 24 << 46 << 3;  // 12 + 16 + 18
  QTest::newRow("tetra 2x2x2") << 8 << 19 << 3;
}

void GenerateCommandTest::kinds() {
  QFETCH(int, elements);
  QFETCH(int, links);
  QFETCH(int, space);
  const Program program;
  for (const char* name : {"a.dat", "a.obj", "b.OBJ"}) {
    const QByteArray make = "generate " + QByteArray(QTest::currentDataTag()) + " -o " + name;
    const auto made = program.run(make);
    QVERIFY2(made.code == 0 && made.out.isEmpty() && made.error.isEmpty(), made.error);
    QCOMPARE(program.run(QStringList{"info", name, "--json", "info.json"}).code, 0);
    const auto info = program.json("info.json");
    QCOMPARE(info["elements"].toInt(), elements);
    QCOMPARE(info["links"].toInt(), links);
    QCOMPARE(info["space_dimension"].toInt(), space);
    QCOMPARE(info["components"].toInt(), 1);
  }
}

void GenerateCommandTest::a_dash_is_standard_output() {
  const Program program;
  const auto outcome = program.run("generate line 3 -o -");
  QCOMPARE(outcome.code, 0);
  QCOMPARE(outcome.out, QByteArray("# size 3\n# spacing 1\n0 1 1\n1 2 0 2\n2 1 1\n"));
  QVERIFY(program.files().isEmpty());
}

void GenerateCommandTest::refused_data() {
  QTest::addColumn<QString>("where");
  const auto row = [](const char* line, const char* where) { QTest::newRow(line) << where; };
  row("generate blob 3 -o a.dat", "KIND: ");
  row("generate grid 3 -o a.dat", "SIZE: ");
  row("generate grid 4294967296x1 -o a.dat", "SIZE: ");
  row("generate block 272x272x272 -o a.dat", "SIZE: ");
  row("generate grid 3x3 --space 1 -o a.dat", "--space 1: ");
  row("generate grid 3x3 -o a.stl", "a.stl: ");
  row("generate grid 3x3 -o none/a.dat", "none/a.dat: ");
}

void GenerateCommandTest::refused() {
  QFETCH(QString, where);
  const Program program;
  program.write("a.dat", "old");
  const auto outcome = program.run(QTest::currentDataTag());
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QCOMPARE(program.read("a.dat"), QByteArray("old"));
  QCOMPARE(program.files(), QStringList{"a.dat"});
}

CHAINMAIL_TEST(GenerateCommandTest)

}  // namespace chainmail::test_generate

#include "test_generate.moc"
