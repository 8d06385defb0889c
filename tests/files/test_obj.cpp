#include <QtTest>
#include <cmath>

#include "files/support.h"
#include "program.h"

namespace chainmail::test_obj {

using namespace chainmail::test;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

/// Tests reading and writing of Wavefront OBJ.
class ObjTest : public QObject {
  Q_OBJECT

 private slots:
  void faces_and_lines_give_links_each_once();
  void a_polygon_has_no_diagonal();
  void ids_are_the_vertices_order();
  void neighbours_stand_by_ascending_id();
  void numbers_are_read_in_double();
  void what_exporters_write_is_read();
  void indices_may_count_back_and_ahead();
  void the_space_dimension_is_the_extent_or_stated();
  void writing_and_reading_is_the_identity();
  void a_face_with_a_cut_link_becomes_lines();
  void deformed_positions_are_written();
};

void ObjTest::faces_and_lines_give_links_each_once() {
  const auto mesh = obj(square + "v 2 0 0\nf 1 2 3\nf 1 3 4\nl 2 5 2\nl 1 2\n");
  QCOMPARE(mesh->link_count(), 6U);  // 0-1 0-2 0-3 1-2 1-4 2-3
  QCOMPARE(mesh->triangles.size(), std::size_t{2});
  QCOMPARE(mesh->object_dimension, 2);
}

void ObjTest::a_polygon_has_no_diagonal() {
  const auto mesh = obj(square + "f 1 2 3 4\n");
  QCOMPARE(mesh->link_count(), 4U);
  QVERIFY(!find_link(*mesh, 0, 2) && !find_link(*mesh, 1, 3));
  QCOMPARE(mesh->own_triangles, std::size_t{0});
  QCOMPARE(mesh->triangles.size(), std::size_t{2});
  QCOMPARE(mesh->polygons, (std::vector<ElementId>{4, 0, 1, 2, 3}));
}

void ObjTest::ids_are_the_vertices_order() {
  const auto mesh = obj("v 9 0 0\nl 1 2\nv 7 0 0\nv 8 0 0\n");  // an element without links is kept
  QCOMPARE(mesh->element_count(), 3U);
  QCOMPARE(mesh->rest_position(0).x(), 9.0);
  QCOMPARE(mesh->rest_position(1).x(), 7.0);
  QCOMPARE(mesh->rest_position(2).x(), 8.0);
}

void ObjTest::neighbours_stand_by_ascending_id() {
  const auto mesh = obj(square + "l 1 4\nl 1 3\nl 1 2\n");
  const auto row = mesh->neighbours_of(0);
  QCOMPARE(std::vector<ElementId>(row.begin(), row.end()), (std::vector<ElementId>{1, 2, 3}));
}

void ObjTest::numbers_are_read_in_double() {
  const auto mesh = obj("v 0.1 123456789.123456789 1.0000000000000002\nv 3e-7 -2.2250738585072014e-308 0.3\n");
  QVERIFY(mesh->rest_position(0) == Point(0.1, 123456789.123456789, std::nextafter(1.0, 2.0)));
  QVERIFY(mesh->rest_position(1) == Point(3e-7, -2.2250738585072014e-308, 0.3));
}

void ObjTest::what_exporters_write_is_read() {
  const auto mesh =
      obj("\xef\xbb\xbf# exported\r\nmtllib a.mtl\r\no thing\r\ng a b\r\n"
          "v 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 +0.5\r\nv 1 1 0\r\nvt 0 0\r\nvn 0 0 1\r\nusemtl m\r\ns off\r\n"
          "f 1/1/1 2/1/1 3/1/1\r\n  f 2//1 4//1 3//1 \r\nf 1/1 2/1 4/1 # a comment\r\nl 1/1 4/1\r\np 1\r\n");
  QCOMPARE(mesh->triangles.size(), std::size_t{3});
  QCOMPARE(mesh->link_count(), 6U);
  QCOMPARE(mesh->rest_position(2).z(), 0.5);
}

void ObjTest::indices_may_count_back_and_ahead() {
  const auto mesh = obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 2 0\nl -1 -4\n");
  QCOMPARE(mesh->link_count(), 4U);
  QVERIFY(find_link(*mesh, 3, 0));
}

void ObjTest::the_space_dimension_is_the_extent_or_stated() {
  QCOMPARE(obj("v 0 5 0\nv 1 5 0\n")->space_dimension, 1);
  QCOMPARE(obj("v 0 0 1\nv 0 1 2\n")->axes[0], 1);
  QCOMPARE(obj("# space 3\nv 0 0 0\nv 1 0 0\n")->space_dimension, 3);
  QVERIFY(
      error_of([] { obj("v 0 0 0\n# space 1\nv 1 1 0\n"); }).startsWith("mesh.obj:2: the mesh extends along 2 axes"));
  QVERIFY(
      error_of([] { obj("# space 1\n# space 2\nv 1 1 0\n"); }).startsWith("mesh.obj:2: the space dimension differs"));
}

void ObjTest::writing_and_reading_is_the_identity() {
  const auto mixed = obj(square + "v 0.1 0.2 0.3\nf 1 2 3 4\nf 1 2 5\nl 4 5\n");
  for (const auto& mesh : {mixed, made(MeshKind::cloth, {5, 4, 1}, 0.1), made(MeshKind::grid, {4, 4, 1}, 1, 3),
                           made(MeshKind::line, {3, 1, 1})}) {
    const auto read = obj(obj_text(*mesh));
    QCOMPARE(read->links, mesh->links);
    QCOMPARE(read->rest, mesh->rest);
    QCOMPARE(read->triangles, mesh->triangles);
    QCOMPARE(read->polygons, mesh->polygons);
    QCOMPARE(read->space_dimension, mesh->space_dimension);
    QCOMPARE(obj_text(*read), obj_text(*mesh));
  }
  QCOMPARE(obj_text(*obj(square + "f 1 2 3 4\n")), square + "f 1 2 3 4\n");
}

void ObjTest::a_face_with_a_cut_link_becomes_lines() {
  const auto mesh = obj(square + "v 2 0 0\nf 1 2 3 4\nf 2 5 3\n");
  Cuts cuts(mesh);
  cuts.cut(*find_link(*mesh, 0, 1));
  QCOMPARE(obj_text(*mesh, cuts), square + "v 2 0 0\nf 2 5 3\nl 1 4\nl 3 4\n");
  const auto read = obj(obj_text(*mesh, cuts));
  QCOMPARE(read->link_count(), mesh->link_count() - 1);
}

void ObjTest::deformed_positions_are_written() {
  const auto mesh = made(MeshKind::line, {2, 1, 1}, 1, 2);
  const std::vector<double> moved{0.1, 0, 2, -0.5};
  std::ostringstream out;
  write_obj(out, {*mesh, {}, {moved.data(), 2 * sizeof(double), Precision::double_precision}, {}});
  QCOMPARE(out.str(), std::string("v 0.1 0 0\nv 2 -0.5 0\nl 1 2\n"));
}

CHAINMAIL_TEST(ObjTest)

}  // namespace chainmail::test_obj

#include "test_obj.moc"
