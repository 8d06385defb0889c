#include <QtTest>

#include "files/formats/medit.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_medit {

using namespace chainmail::test;

namespace {

const std::string tetrahedron = "Vertices 4 0 0 0 1 1 0 0 1 0 1 0 1 0 0 1 1 Tetrahedra 1 1 2 3 4 1 End";

ImportedMesh medit(const std::string& text) { return read_medit(text, "a.mesh"); }

}  // namespace

/// Tests reading of Medit's format. A file of Gmsh's is tested in test_open_mesh.
class MeditTest : public QObject {
  Q_OBJECT

 private slots:
  void lines_do_not_matter_data();
  void lines_do_not_matter();
  void each_kind_of_piece_is_read();
  void a_tetrahedron_of_second_order_is_divided_between_its_middles();
  void a_plane_mesh_has_two_coordinates();
  void other_lists_are_passed_over();
  void wrong_files_are_refused_data();
  void wrong_files_are_refused();
};

void MeditTest::lines_do_not_matter_data() {
  QTest::addColumn<QByteArray>("before");
  QTest::newRow("one line") << QByteArray("MeshVersionFormatted 1 Dimension 3 ");
  QTest::newRow("a number on the next line") << QByteArray("MeshVersionFormatted\n2\nDimension\n3\n");
  QTest::newRow("comments and blank lines")
      << QByteArray("# by hand\n\n# again\nMeshVersionFormatted 2\n Dimension 3 # of 3\n");
  QTest::newRow("version 4") << QByteArray("MeshVersionFormatted 4 Dimension 3 ");
  QTest::newRow("a byte order mark") << QByteArray("\xef\xbb\xbfMeshVersionFormatted 2\r\nDimension 3\r\n");
  QTest::newRow("carriage returns") << QByteArray("MeshVersionFormatted 2\r\rDimension\r3\r");
}

void MeditTest::lines_do_not_matter() {
  QFETCH(QByteArray, before);
  const MeshParts parts = medit(before.toStdString() + tetrahedron).parts;
  QVERIFY(parts.tetrahedra == (std::vector<std::array<ElementId, 4>>{{0, 1, 2, 3}}));
  QCOMPARE(parts.rest, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

void MeditTest::each_kind_of_piece_is_read() {
  const MeshParts parts =
      medit(
          "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n0 0 1 1\n1 0 1 1\n"
          "1 1 1 1\n0 1 1 1\nEdges\n1\n1 7 3\nTriangles\n1\n1 2 3 4\nQuadrilaterals\n1\n5 6 7 8 2\n"
          "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\nEnd\n")
          .parts;
  QVERIFY(parts.links == (std::vector<std::array<ElementId, 2>>{{0, 6}}));
  QVERIFY(parts.triangles == (std::vector<std::array<ElementId, 3>>{{0, 1, 2}}));
  QCOMPARE(parts.polygons, (std::vector<ElementId>{4, 4, 5, 6, 7}));
  QVERIFY(parts.hexahedra == (std::vector<std::array<ElementId, 8>>{{0, 1, 2, 3, 4, 5, 6, 7}}));
}

/// Middles stand in the order 12, 23, 31, 14, 24, 34 of the corners (libMeshb). Those on the right edges make eight
/// parts of one volume.
void MeditTest::a_tetrahedron_of_second_order_is_divided_between_its_middles() {
  const MeshParts parts =
      medit(
          "MeshVersionFormatted 2 Dimension 3 Vertices 10 0 0 0 1 2 0 0 1 0 2 0 1 0 0 2 1 1 0 0 1 1 1 0 1 0 1 0 1 "
          "0 0 1 1 1 0 1 1 0 1 1 1 TetrahedraP2 1 1 2 3 4 5 6 7 8 9 10 0 End")
          .parts;
  QCOMPARE(parts.tetrahedra.size(), std::size_t{8});
  for (const auto& [a, b, c, d] : parts.tetrahedra) {
    const Point at = parts.rest[a];
    const double volume = (parts.rest[b] - at).cross(parts.rest[c] - at).dot(parts.rest[d] - at) / 6;
    QVERIFY2(std::abs(volume - 1.0 / 6) < 1e-12, qPrintable(QString::number(volume)));
    for (const ElementId corner : {a, b, c, d}) {  // its part has the middles of its edges
      for (const ElementId middle : {a, b, c, d}) {
        const Point end = 2 * parts.rest[middle] - parts.rest[corner];
        QVERIFY(corner > 3 || middle == corner ||
                std::find(parts.rest.begin(), parts.rest.begin() + 4, end) != parts.rest.begin() + 4);
      }
    }
  }
}

void MeditTest::a_plane_mesh_has_two_coordinates() {
  const MeshParts parts =
      medit("MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 1\n1 0 1\n0 1 1\nTriangles\n1\n1 2 3 1\nEnd\n")
          .parts;
  QCOMPARE(parts.rest, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  QCOMPARE(parts.triangles.size(), std::size_t{1});
}

void MeditTest::other_lists_are_passed_over() {
  const MeshParts parts =
      medit("MeshVersionFormatted 2 Dimension 3 Corners 2 1 2 " + tetrahedron.substr(0, 42) +
            " Normals 1 0 0 1 NormalAtVertices 1 1 1 SubDomainFromGeom 1 3 1 1 0" + tetrahedron.substr(42))
          .parts;
  QCOMPARE(parts.rest.size(), std::size_t{4});
  QCOMPARE(parts.tetrahedra.size(), std::size_t{1});
}

void MeditTest::wrong_files_are_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  const QByteArray head = "MeshVersionFormatted 2\nDimension 3\n", two = head + "Vertices\n2\n0 0 0 1\n1 0 0 1\n";
  QTest::newRow("another format") << QByteArray("ply\n") << "a.mesh:1: it does not begin as a Medit mesh";
  QTest::newRow("version") << QByteArray("MeshVersionFormatted 9\n")
                           << "a.mesh:1: version 9 of Medit's format is not known; ";
  QTest::newRow("dimension") << QByteArray("MeshVersionFormatted 2\nDimension 4")
                             << "a.mesh:2: its vertices have 4 coordinates; ";
  QTest::newRow("no dimension") << QByteArray("MeshVersionFormatted 2\nVertices\n1\n0 0 1\n")
                                << "a.mesh:2: the dimension is missing; ";
  QTest::newRow("huge count") << head + "Vertices\n4000000000\n0 0 0 1\n"
                              << "a.mesh:4: 4000000000 rows are more than the file contains";
  QTest::newRow("short list") << head + "Vertices\n3\n0 0 0 1\n1 0 0 1\nEdges\n"
                              << "a.mesh:7: 'Edges' is not a valid coordinate; ";
  QTest::newRow("long list") << head + "Vertices\n1\n0 0 0 1\n1 0 0 1\nEnd\n"
                             << "a.mesh:6: '1' stands where a keyword is expected; ";
  QTest::newRow("not finite") << head + "Vertices\n1\n0 nan 0 1\n"
                              << "a.mesh:5: 'nan' is not a valid coordinate; ";
  QTest::newRow("decimal comma")
      << head + "Vertices\n1\n0,5 0 0 1\n"
      << "a.mesh:5: '0,5' is not a valid coordinate; write a decimal point instead of the comma";
  QTest::newRow("corner 0") << two + "Edges\n1\n0 1 1\n"
                            << "a.mesh:9: there is no vertex 0; ";
  QTest::newRow("corner too large")
      << two + "Edges\n1\n1 3 1\n"
      << "a.mesh:9: there is no vertex 3; use the numbers of the vertices before it, from 1 to 2";
  QTest::newRow("cut off") << two + "Edges\n1\n1 2"
                           << "a.mesh:9: it ends in the middle of a list; ";
  QTest::newRow("two lists") << two + "Vertices\n1\n0 0 0 1\n"
                             << "a.mesh:7: there are two lists of vertices; ";
}

void MeditTest::wrong_files_are_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString error = error_of([&] { medit(text.toStdString()); });
  QVERIFY2(error.startsWith(sentence) && !error.contains('\n'), qPrintable(error));
}

CHAINMAIL_TEST(MeditTest)

}  // namespace chainmail::test_medit

#include "test_medit.moc"
