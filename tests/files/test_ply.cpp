#include <QtTest>

#include "files/formats/ply.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_ply {

using namespace chainmail::test;

namespace {

const std::string head =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n";

ImportedMesh ply(const std::string& text) { return read_ply(text, "a.ply"); }

}  // namespace

/// Tests reading of PLY. Files of other programs are tested in test_open_mesh, and our writer in test_writers.
class PlyTest : public QObject {
  Q_OBJECT

 private slots:
  void faces_and_edges_are_read();
  void elements_stand_in_any_order();
  void what_is_not_known_is_passed_over();
  void wrong_files_are_refused_data();
  void wrong_files_are_refused();
};

void PlyTest::faces_and_edges_are_read() {
  const auto mesh = ply(head +
                        "element face 1\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n"
                        "property int vertex2\nend_header\n0 0 0\n1 0 0\n0 1e-3 0\n0 0 10000000.001\n3 2 1 0\n0 3\n")
                        .parts;
  QVERIFY(mesh.triangles == (std::vector<std::array<ElementId, 3>>{{2, 1, 0}}));
  QVERIFY(mesh.links == (std::vector<std::array<ElementId, 2>>{{0, 3}}));
  QCOMPARE(mesh.rest[3].z(), 10000000.001);
}

void PlyTest::elements_stand_in_any_order() {
  const auto mesh = ply("ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uint8 uint32 vertex_index\r\n"
                        "element vertex 4\r\nproperty float z\r\nproperty float x\r\nproperty float y\r\nend_header\r\n"
                        "4 3 2 1 0\r\n1 2 3\r\n4 5 6\r\n7 8 9\r\n10 11 12\r\n")
                        .parts;
  QCOMPARE(mesh.polygons, (std::vector<ElementId>{4, 3, 2, 1, 0}));
  QCOMPARE(mesh.rest[1], Point(5, 6, 4));
}

void PlyTest::what_is_not_known_is_passed_over() {
  const auto mesh = ply(head +
                        "property float quality\nelement camera 1\nproperty list uchar float view\nelement edge 1\n"
                        "property int vertex1\nproperty int vertex2\nend_header\n0 0 0 nan\n1 0 0 1\n0 1 0 -inf\n"
                        "0 0 1 2\n3 1 2 3\n1 2\n")
                        .parts;
  QCOMPARE(mesh.rest.size(), std::size_t{4});
  QVERIFY(mesh.links == (std::vector<std::array<ElementId, 2>>{{1, 2}}));
  const auto skipped = [](const std::string& line) {
    return ply("ply\n" + line + "\n" + head.substr(4) + "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n").skipped;
  };
  QCOMPARE(skipped("comment by a scanner"), std::size_t{0});
  QCOMPARE(skipped("obj_info num_cols 512"), std::size_t{0});
  QCOMPARE(skipped("by a scanner"), std::size_t{1});
}

void PlyTest::wrong_files_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  const QByteArray vertices = QByteArray::fromStdString(head);
  const QByteArray face = vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const QByteArray points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const auto row = [](const char* name, const QByteArray& text, const char* sentence) {
    QTest::newRow(name) << text << QString(sentence);
  };
  row("no head", "plyx\n", "a.ply:1: it does not begin with 'ply'; ");
  row("head without end", vertices, "a.ply:7: its header does not end; ");
  row("no format", "ply\nend_header\n", "its header has no line 'format …'; ");
  row("format", "ply\nformat morse 1.0\n", "a.ply:2: the format 'morse' is not known; ");
  row("type", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "a.ply:4: numbers of type 'real' are");
  row("huge count",
      "ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n",
      "it ends before the last element that its header states; ");
  row("beyond any count", "ply\nformat ascii 1.0\nelement vertex 18446744073709551616\n",
      "its count is not a whole number; ");
  row("truncated", face + "0 0 0\n1 0", "a.ply:11: it ends before the last element");
  row("word", face + "0 0 0\n1 zero 0\n", "a.ply:11: 'zero' is not a number; ");
  row("not finite", face + "0 0 0\n1 nan 0\n", "vertex 1 has a coordinate that is not a number");
  row("dangling", face + points + "3 0 1 4\n", "a face or edge names the vertex 4, which does not exist; ");
  row("negative", face + points + "3 0 1 -1\n", "a face or edge names the vertex -1, which does not exist; ");
  row("count of a list", face + points + "-3 0 1 2\n", "the length of a list is not a whole number");
  row("no z", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
      "the PLY element 'vertex' has no property 'z'; ");
  row("binary", "ply\nformat binary_big_endian 1.0\nelement vertex 9\nproperty float x\nend_header\nabc",
      "a.ply: it ends before the last element");
}

void PlyTest::wrong_files_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString error = error_of([&] { ply(text.toStdString()); });
  QVERIFY2(error.contains(sentence), qPrintable(error));
}

CHAINMAIL_TEST(PlyTest)

}  // namespace chainmail::test_ply

#include "test_ply.moc"
