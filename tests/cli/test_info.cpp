#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_info {

using namespace chainmail::test;

/// Tests `chainmail info`: its output, and its errors for bad files.
class InfoCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void json_has_the_keys_of_the_contract();
  void size_and_spacing_come_first();
  void an_option_that_cannot_be_is_named_itself_data();
  void an_option_that_cannot_be_is_named_itself();
  void bad_files_are_refused_data();
  void bad_files_are_refused();
};

void InfoCommandTest::json_has_the_keys_of_the_contract() {
  const Program program;
  program.write("a.obj", "v 1 2 3\nv 4 2 3\nv 4 6 3\nv 1 6 3\nv 0 0 3\nf 1 2 3 4\n");
  const auto outcome = program.run("info a.obj --json -");
  QCOMPARE(outcome.code, 0);
  const auto info = QJsonDocument::fromJson(outcome.out).object();
  QStringList keys = info.keys();
  QCOMPARE(keys, (QStringList{"bounds", "components", "defects", "elements", "flaws", "hexahedra", "joined", "kind",
                              "left_out", "links", "mean_link_length", "object_dimension", "schema_version",
                              "space_dimension", "tetrahedra", "triangles"}));
  QCOMPARE(info["elements"].toInt(), 5);
  QCOMPARE(info["links"].toInt(), 4);
  QCOMPARE(info["triangles"].toInt(), 2);
  QCOMPARE(info["tetrahedra"].toInt(), 0);
  QCOMPARE(info["object_dimension"].toInt(), 2);
  QCOMPARE(info["space_dimension"].toInt(), 2);
  QCOMPARE(info["components"].toInt(), 2);
  QCOMPARE(info["bounds"].toArray(), (QJsonArray{QJsonArray{0, 0, 3}, QJsonArray{4, 6, 3}}));
  QCOMPARE(info["mean_link_length"].toDouble(), 3.5);
  QCOMPARE(info["defects"].toObject(), (QJsonObject{{"duplicate_vertices", 0},
                                                    {"loose_points", 1},
                                                    {"holes", 0},
                                                    {"hole_edges", 0},
                                                    {"non_manifold_edges", 0},
                                                    {"inverted_cells", 0}}));
  QVERIFY(program.run("info a.obj").out.contains("\ndefects           1 loose point\n"));
}

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

void InfoCommandTest::bad_files_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("where");
  const auto row = [](const char* name, const QByteArray& text, const char* where) {
    QTest::newRow(name) << text << where;
  };
  row("2x1.dat", "0 1 1\n1 0\n", "2x1.dat:1: element 0 lists 1, but 1 does not list 0; ");
  row("1x1.dat", "", "1x1.dat: it is empty; ");
  row("a.dat", "0 0\n", "a.dat: the size of its lattice is not known; ");
  row("a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2: there is no vertex 3; ");
  row("b.obj", QByteArray("\0\1\2", 3), "b.obj: it is not a text file; ");
  row("a.ply", "ply\n", "a.ply:2: its header does not end; ");
  row("c.obj", "v 0 0 0\nv 1 2 nan\n", "c.obj:2: 'nan' is not a valid coordinate");
}

void InfoCommandTest::bad_files_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, where);
  const Program program;
  const QString name = QTest::currentDataTag();
  program.write(name, text);
  const auto outcome = program.run(QStringList{"info", name, "--json", "out.json"});
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + where), outcome.error);
  QCOMPARE(program.files(), QStringList{name});
}

CHAINMAIL_TEST(InfoCommandTest)

}  // namespace chainmail::test_info

#include "test_info.moc"
