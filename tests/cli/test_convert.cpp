#include <QtTest>
#include <filesystem>

#include "cli/chainmail_program.h"
#include "files/mesh/mesh_file.h"
#include "program.h"

namespace chainmail::test_convert {

using namespace chainmail::test;

/// Tests `chainmail convert`, which writes other formats, `chainmail fill`, which converts surfaces to volumes,
/// `chainmail simplify` and `chainmail repair`.
class ConvertCommandTest : public QObject {
  Q_OBJECT

 private slots:
  void a_mesh_goes_to_another_format();
  void a_volume_is_taken_as_asked();
  void a_surface_is_simplified();
  void a_mesh_is_repaired();
  void a_repair_alone_makes_no_other_data();
  void a_repair_alone_makes_no_other();
  void what_a_format_does_not_hold_is_said();
  void the_file_that_was_read_is_not_replaced_data();
  void the_file_that_was_read_is_not_replaced();
  void bad_usage_is_one_sentence_and_leaves_no_file_data();
  void bad_usage_is_one_sentence_and_leaves_no_file();
};

namespace {

const QByteArray tetrahedron = "OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

/// An open cube with a duplicate corner, a loose point, and a fin at one edge.
const QByteArray broken =
    "OFF\n11 11 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n0 0 0\n7 7 7\n3 3 0\n"
    "3 0 2 1\n3 8 3 2\n3 0 1 5\n3 8 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n3 1 2 10\n";

/// Two tetrahedra with a common side, whose three corners are duplicates, and a loose point. The lower one lies on the
/// wrong side of its first three corners.
const QByteArray broken_solid =
    "MeshVersionFormatted 2 Dimension 3 Vertices 9 0 0 0 1 1 0 0 1 0 1 0 1 0 0 1 1 0 0 0 1 0 0 -1 1 1 0 0 1 0 1 0 1 "
    "5 5 5 1 Tetrahedra 2 1 2 3 4 1 5 7 8 6 1 End";

const QByteArray volume =
    "ObjectType = Image\nNDims = 3\nDimSize = 4 1 1\nElementType = MET_UCHAR\nElementDataFile = "
    "LOCAL\n\x0a\x14\x1e\x28";

}  // namespace

void ConvertCommandTest::a_mesh_goes_to_another_format() {
  const Program program;
  program.write("a.off", tetrahedron);
  const auto outcome = program.run("convert a.off -o a.msh");
  QCOMPARE(outcome.code, 0);
  QCOMPARE(outcome.error, QByteArray());
  const auto mesh = read_mesh(program.path("a.msh").toStdString());
  QCOMPARE(mesh->triangles.size(), std::size_t{4});
  QCOMPARE(mesh->links.size(), std::size_t{6});
}

void ConvertCommandTest::a_volume_is_taken_as_asked() {
  const Program program;
  program.write("a.mha", volume);
  QCOMPARE(program.run("convert a.mha --threshold 20 --voxels 1 -o a.csv").code, 0);
  QVERIFY(program.run("info a.mha --threshold 20")
              .out.contains("read as"));  // the threshold, and the number of voxels per element
  QCOMPARE(program.read("a.csv"), QByteArray("id,x,y,z\n0,1,0,0\n1,2,0,0\n2,3,0,0\n"));
  const auto stiff = program.run("deform a.mha --threshold 20 --algorithm exact --by 2:1 --positions b.csv");
  QCOMPARE(stiff.code, 0);
  // The link between densities 30 and 40 is three quarters rigid (1.05), the one between 20 and 30 one quarter (1.15).
  const auto rows = program.read("b.csv").split('\n');
  for (const auto& [row, x] : {std::pair(1, 1.8), {2, 2.95}, {3, 4.0}}) {
    QVERIFY(std::abs(rows[row].split(',')[1].toDouble() - x) < 1e-12);  // rounding of sums of a few doubles
  }
}

/// 41 elements are left of 81, all 32 at the border among them.
void ConvertCommandTest::a_surface_is_simplified() {
  const Program program;
  QCOMPARE(program.run("generate cloth 9x9 -o cloth.obj").code, 0);
  const auto outcome = program.run("simplify cloth.obj --elements 41 -o a.obj");
  QVERIFY2(outcome.code == 0, outcome.error);
  QCOMPARE(outcome.out + outcome.error, QByteArray());
  const auto mesh = read_mesh(program.path("a.obj").toStdString());
  QCOMPARE(mesh->element_count(), 41U);
  QCOMPARE(mesh->box[1], Point(8, 8, 0));
  QCOMPARE(program.run("simplify cloth.obj --elements 41 --output b.obj").code, 0);
  QCOMPARE(program.read("b.obj"), program.read("a.obj"));
}

void ConvertCommandTest::a_mesh_is_repaired() {
  const Program program;
  program.write("a.off", broken);
  const auto outcome = program.run("repair a.off -o a.obj --json a.json");
  QVERIFY2(outcome.code == 0, outcome.error);
  QCOMPARE(outcome.out, QByteArray("repaired  1 duplicate vertex welded, 1 loose point removed, 1 hole closed with 2 "
                                   "triangles\nleft      1 non-manifold edge\n"));
  const auto mesh = read_mesh(program.path("a.obj").toStdString());
  QCOMPARE(mesh->element_count(), 9U);
  QCOMPARE(mesh->triangles.size(), std::size_t{13});
  const auto defects = [&](const char* when) { return program.json("a.json")[when].toObject()["defects"].toObject(); };
  QCOMPARE(defects("before"), (QJsonObject{{"duplicate_vertices", 1},
                                           {"loose_points", 1},
                                           {"holes", 1},
                                           {"hole_edges", 4},
                                           {"non_manifold_edges", 1},
                                           {"inverted_cells", 0}}));
  QCOMPARE(defects("after"), (QJsonObject{{"duplicate_vertices", 0},
                                          {"loose_points", 0},
                                          {"holes", 0},
                                          {"hole_edges", 0},
                                          {"non_manifold_edges", 1},
                                          {"inverted_cells", 0}}));
  QCOMPARE(program.json("a.json")["before"].toObject()["elements"].toInt(), 11);
  QCOMPARE(program.json("a.json")["after"].toObject()["elements"].toInt(), 9);
}

void ConvertCommandTest::a_repair_alone_makes_no_other_data() {
  QTest::addColumn<QStringList>("mended");  // keys of the defects that are gone
  QTest::addColumn<int>("elements");
  const auto row = [](const char* line, const QStringList& mended, int elements) {
    QTest::newRow(line) << mended << elements;
  };
  row("a.off --weld", {"duplicate_vertices"}, 10);
  row("a.off --loose", {"loose_points"}, 10);
  row("a.off --holes", {"holes", "hole_edges"}, 11);
  row("a.off --cells", {}, 11);
  row("a.off --weld --holes", {"duplicate_vertices", "holes", "hole_edges"}, 10);
  row("a.off --loose --cells", {"loose_points"}, 10);
  row("a.mesh --weld", {"duplicate_vertices"}, 6);
  row("a.mesh --loose", {"loose_points"}, 8);
  row("a.mesh --cells", {"inverted_cells"}, 9);
  row("a.mesh --loose --cells", {"loose_points", "inverted_cells"}, 8);
}

void ConvertCommandTest::a_repair_alone_makes_no_other() {
  QFETCH(QStringList, mended);
  QFETCH(int, elements);
  const Program program;
  program.write("a.off", broken);
  program.write("a.mesh", broken_solid);
  const auto outcome = program.run("repair -o b.vtu --json a.json " + QByteArray(QTest::currentDataTag()));
  QVERIFY2(outcome.code == 0, outcome.error);
  const QJsonObject json = program.json("a.json"), after = json["after"].toObject();
  QJsonObject expected = json["before"].toObject()["defects"].toObject();
  for (const QString& defect : mended) {
    QVERIFY(expected[defect].toInt() > 0);
    expected[defect] = 0;
  }
  QCOMPARE(after["defects"].toObject(), expected);
  QCOMPARE(after["elements"].toInt(), elements);
  QCOMPARE(int(read_mesh(program.path("b.vtu").toStdString())->element_count()), elements);
}

void ConvertCommandTest::what_a_format_does_not_hold_is_said() {
  const Program program;
  program.write(
      "a.mesh",
      "MeshVersionFormatted 2 Dimension 3 Vertices 4 0 0 0 1 1 0 0 1 0 1 0 1 0 0 1 1 Tetrahedra 1 1 2 3 4 1 End");
  QCOMPARE(program.run("convert a.mesh -o a.obj").error,
           QByteArray("chainmail: note: Wavefront OBJ has no cells: it gets their outer faces, and the links inside as "
                      "lines\n"));
  QCOMPARE(program.run("convert a.mesh -o a.vtu").error, QByteArray());
}

void ConvertCommandTest::the_file_that_was_read_is_not_replaced_data() {
  QTest::addColumn<QString>("input");
  QTest::addColumn<QString>("output");
  QTest::newRow("same name") << "a.obj"
                             << "a.obj";
  QTest::newRow("another spelling") << "a.obj"
                                    << "./a.obj";
  QTest::newRow("symbolic link") << "a.obj"
                                 << "symbolic.obj";
  QTest::newRow("through a symbolic link") << "symbolic.obj"
                                           << "a.obj";
  QTest::newRow("hard link") << "a.obj"
                             << "hard.obj";
}

/// The file may be the only copy.
void ConvertCommandTest::the_file_that_was_read_is_not_replaced() {
  QFETCH(QString, input);
  QFETCH(QString, output);
  const Program program;
  const QByteArray text =
      "# mine\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv 0.5 0.5 0\n"
      "f 1 3 5\nf 3 2 5\nf 2 1 5\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  program.write("a.obj", text);
  std::filesystem::create_symlink("a.obj", program.path("symbolic.obj").toStdString());
  std::filesystem::create_hard_link(program.path("a.obj").toStdString(), program.path("hard.obj").toStdString());
  for (const char* command : {"convert", "repair", "simplify --elements 4"}) {
    const auto outcome = program.run(QString(command).split(' ') + QStringList{input, "-o", output});
    QCOMPARE(outcome.code, 2);
    QVERIFY2(is_one_sentence(outcome), outcome.error);
    QVERIFY2(outcome.error.contains(": it is an input, and this output would replace it; "), outcome.error);
    for (const char* name : {"a.obj", "symbolic.obj", "hard.obj"}) {
      QCOMPARE(program.read(name), text);
    }
  }
}

void ConvertCommandTest::bad_usage_is_one_sentence_and_leaves_no_file_data() {
  QTest::addColumn<QString>("arguments");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("format") << "convert a.off -o a.xyz"
                          << "a.xyz: the ending .xyz is not known; ";
  QTest::newRow("read only") << "convert a.off -o a.node"
                             << "a.node: a .node file can be opened but not written; ";
  QTest::newRow("no volume") << "convert a.off --threshold 3 -o a.obj"
                             << "a.off: it is not a volume of voxels; ";
  QTest::newRow("nothing") << "convert a.mha --threshold 41 -o a.obj"
                           << "--threshold: no voxel has a density of 41 or more; ";
  QTest::newRow("open") << "fill open.off -o a.msh"
                        << "open.off: the surface is open: it has 1 hole, ";
  QTest::newRow("simplified to more") << "simplify a.off --elements 9 -o a.msh"
                                      << "--elements: the surface has 4, so 9 are not fewer; use a finer surface";
  QTest::newRow("border too long") << "simplify strip.off --elements 5 -o a.msh"
                                   << "strip.off: the 6 elements at its borders and non-manifold edges stay, so it "
                                      "cannot have 5; use a surface with more elements inside";
}

void ConvertCommandTest::bad_usage_is_one_sentence_and_leaves_no_file() {
  QFETCH(QString, arguments);
  QFETCH(QString, sentence);
  const Program program;
  program.write("a.off", tetrahedron);
  program.write("a.mha", volume);
  program.write("open.off", "OFF\n3 1 0\n0 0 0\n3 0 0\n0 3 0\n3 0 1 2\n");
  program.write("strip.off",
                "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n3 0 1 2\n3 1 3 2\n3 2 3 4\n3 3 5 4\n");
  const auto outcome = program.run(arguments.split(' '));
  QCOMPARE(outcome.code, 2);
  QVERIFY2(is_one_sentence(outcome), outcome.error);
  QVERIFY2(QString::fromUtf8(outcome.error).startsWith("chainmail: " + sentence), outcome.error);
  QCOMPARE(program.files(), (QStringList{"a.mha", "a.off", "open.off", "strip.off"}));
}

CHAINMAIL_TEST(ConvertCommandTest)

}  // namespace chainmail::test_convert

#include "test_convert.moc"
