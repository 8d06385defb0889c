#include "cli/chainmail_program.h"
#include "folders.h"
#include "program.h"

namespace chainmail::test_info {

using namespace chainmail::test;

/// Tests `chainmail info`: its options.
class InfoCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void size_and_spacing_come_first();
  void an_option_that_cannot_be_is_named_itself_data();
  void an_option_that_cannot_be_is_named_itself();
  void a_lesson_is_checked();
};

void InfoCommandTest::size_and_spacing_come_first() {
  const Program program;
  program.write("2x2.dat", "# spacing 5\n0 0\n1 0\n2 0\n3 0\n");
  program.run("info 2x2.dat --json a.json");
  QCOMPARE(program.json("a.json")["bounds"][1].toArray(), (QJsonArray{5, 5, 0}));
  program.run("info --size 4x1 --spacing 2 2x2.dat --json a.json");
  QCOMPARE(program.json("a.json")["bounds"][1].toArray(), (QJsonArray{6, 0, 0}));
}

void InfoCommandTest::an_option_that_cannot_be_is_named_itself_data() {
  QTest::addColumn<QString>("arguments");
  QTest::addColumn<QString>("where");
  QTest::newRow("spacing") << "3x1.dat --spacing 1e100"
                           << "--spacing: the spacing is too large; use a smaller spacing\n";
  QTest::newRow("spacing and size") << "3x1.dat --spacing 1e100 --size 3x1"
                                    << "--spacing: the spacing is too large; ";
  QTest::newRow("size") << "3x1.dat --size 99999x99999"
                        << "--size: the size 99999x99999 is more than 20000000 elements; ";
  QTest::newRow("threshold") << "a.mha --threshold 200"
                             << "--threshold: no voxel has a density of 200 or more; ";
  QTest::newRow("spacing of the file") << "wide.dat --size 3x1"
                                       << "wide.dat:1: the spacing is too large; scale the mesh down\n";
}

/// The file is right, or its value does not count, so the sentence is not about the file.
void InfoCommandTest::an_option_that_cannot_be_is_named_itself() {
  QFETCH(QString, arguments);
  QFETCH(QString, where);
  const Program program;
  program.write("3x1.dat", "# spacing 5\n0 1 1\n1 2 0 2\n2 1 1\n");
  program.write("wide.dat", "# spacing 1e100\n0 1 1\n1 2 0 2\n2 1 1\n");
  program.write("a.mha",
                "ObjectType = Image\nNDims = 3\nDimSize = 4 1 1\nElementType = MET_UCHAR\nElementDataFile = "
                "LOCAL\n\x0a\x14\x1e\x28");
  check_refused(program, qPrintable("info " + arguments), where);
}

void InfoCommandTest::a_lesson_is_checked() {
  const Program program;
  QFile lesson(QString::fromStdString(source_file("resources/lessons/exact.chainmail").string()));
  QVERIFY(lesson.open(QIODevice::ReadOnly));
  QByteArray text = lesson.readAll();
  program.write("lesson.chainmail", text);
  program.run("info lesson.chainmail --json a.json");
  QVERIFY(program.json("a.json")["elements"].toInt() > 0);
  const QByteArray step = "\"until\": 1";
  QVERIFY(text.contains(step));
  text.replace(text.indexOf(step), step.size(), "\"until\": -1");
  program.write("wrong.chainmail", text);
  check_refused(program, "info wrong.chainmail", "wrong.chainmail: ");
}

CHAINMAIL_TEST(InfoCommandTest)

}  // namespace chainmail::test_info

#include "test_info.moc"
