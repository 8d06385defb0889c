#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <numeric>
#include <random>

#include "elastic/simplices.h"
#include "files/mesh/fill.h"
#include "files/repair/repair.h"
#include "files/support.h"
#include "files/text/text.h"
#include "files/volume_of.h"
#include "folders.h"
#include "mesh/cells.h"
#include "mesh/sheet.h"
#include "program.h"

namespace chainmail::test_mesh_repair {

using namespace chainmail::test;

namespace {

/// A cube with edges of 2, as OBJ: its corners, and two triangles per side. The last two are its top.
const std::string corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n";
const std::string sides = "f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
const std::string top = "f 5 6 7\nf 5 7 8\n";

using Ids = std::vector<ElementId>;

/// Returns what is found in a mesh, in words.
QString found(const Mesh& mesh) { return QString::fromStdString(joined_words(in_words(find_defects(mesh)), ", ")); }

Ids sorted(Ids ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

Repaired closed(const Mesh& mesh, const Progress& progress = {}) {
  return close_holes(mesh, find_defects(mesh).holes, progress);
}

/// Returns a disc of triangles around its middle.
std::string disc(int count) {
  std::string text = "v 0 0 0\n";
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.141592653589793 * i / count;
    text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    text += "f 1 " + std::to_string(i + 2) + " " + std::to_string((i + 1) % count + 2) + "\n";
  }
  return text;
}

/// Returns a sheet with a picture, without the two triangles at its middle.
MeshPointer sheet_with_hole() {
  Texture picture;
  picture.size = {8, 8, 1};
  picture.texels.resize(picture.byte_count(), 200);
  const MeshPointer whole = make_sheet(picture, 9);
  MeshParts parts;
  for (ElementId e = 0; e < whole->element_count(); ++e) {
    parts.rest.push_back(whole->rest_position(e));
  }
  parts.links = whole->links;
  std::erase(parts.links, std::array<ElementId, 2>{40, 50});  // the diagonal
  for (const auto& t : whole->triangles) {
    if (t[0] != 40) {
      parts.triangles.push_back(t);
    }
  }
  parts.texture = whole->texture;
  return build_mesh(parts);
}

}  // namespace

/// Defects of a mesh are counted and repaired. The figures were counted by hand.
class MeshRepairTest : public QObject {
  Q_OBJECT

 private slots:
  void a_whole_mesh_has_no_defects();
  void a_missing_side_is_a_hole();
  void the_outline_of_an_open_surface_is_no_hole_data();
  void the_outline_of_an_open_surface_is_no_hole();
  void holes_that_meet_at_an_element_are_two();
  void duplicates_are_welded_and_a_seam_is_no_hole();
  void a_polygon_with_welded_corners_becomes_a_triangle();
  void a_polygon_that_becomes_a_point_is_left_out();
  void faces_that_become_equal_are_left_out();
  void loose_points_are_removed();
  void corners_of_faces_are_not_loose();
  void a_mesh_without_links_keeps_its_points();
  void rows_of_neighbours_keep_their_order();
  void a_fin_is_a_non_manifold_edge();
  void a_closed_hole_keeps_all_ids_and_can_be_filled();
  void a_large_hole_gets_triangles_as_large_as_those_around_it();
  void a_seam_that_is_not_welded_does_not_keep_a_hole_open();
  void a_hole_at_a_non_manifold_edge_is_closed();
  void a_border_is_judged_by_its_own_piece_data();
  void a_border_is_judged_by_its_own_piece();
  void cells_that_are_inside_out_are_turned_data();
  void cells_that_are_inside_out_are_turned();
  void a_picture_stays_on_its_sheet();
  void the_softness_of_links_stays();
  void what_cannot_be_closed_is_one_sentence();
  void random_triangles_are_repaired_or_refused();
  void it_can_be_cancelled();
};

void MeshRepairTest::a_whole_mesh_has_no_defects() {
  QVERIFY(find_defects(*obj(corners + sides + top)).empty());
  QVERIFY(find_defects(*made(MeshKind::tetra, {3, 3, 3})).empty());
  QVERIFY(find_defects(*made(MeshKind::grid, {3, 3, 1})).empty());
}

void MeshRepairTest::a_missing_side_is_a_hole() {
  const auto defects = find_defects(*obj(corners + sides));
  QCOMPARE(defects.holes.size(), std::size_t{1});
  QCOMPARE(sorted(defects.holes[0]), (Ids{4, 5, 6, 7}));
  QCOMPARE(defects.hole_edges(), std::size_t{4});
  QCOMPARE(defects.outlines, std::size_t{0});
  QCOMPARE(found(*obj(corners + sides)), QString("1 hole (4 edges)"));
}

void MeshRepairTest::the_outline_of_an_open_surface_is_no_hole_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<int>("holes");
  QTest::addColumn<int>("outlines");
  const auto row = [](const char* name, const std::string& text, int holes, int outlines) {
    QTest::newRow(name) << QByteArray::fromStdString(text) << holes << outlines;
  };
  row("cloth", obj_text(*made(MeshKind::cloth, {20, 20, 1})), 0, 1);
  row("disc", disc(40), 0, 1);
  row("one triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 0, 1);
  row("sheet with a hole", obj_text(*sheet_with_hole()), 1, 1);
  row("cube and a triangle", corners + sides + "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 9 10 11\n", 1, 1);
}

void MeshRepairTest::the_outline_of_an_open_surface_is_no_hole() {
  QFETCH(QByteArray, text);
  QFETCH(int, holes);
  QFETCH(int, outlines);
  const auto defects = find_defects(*obj(text.toStdString()));
  QCOMPARE(int(defects.holes.size()), holes);
  QCOMPARE(int(defects.outlines), outlines);
}

/// The top of the first octahedron and the bottom of the second are one element; a face at each side of it is missing.
void MeshRepairTest::holes_that_meet_at_an_element_are_two() {
  const std::string octahedron =
      "v 3 0 0\nv -3 0 0\nv 0 3 0\nv 0 -3 0\nv 0 0 3\nv 0 0 -3\nf 3 2 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  const auto defects = find_defects(*obj(octahedron));  // without two opposite faces at the top
  QCOMPARE(defects.holes.size(), std::size_t{2});
  QCOMPARE(sorted(defects.holes[0]).size(), std::size_t{3});
  QCOMPARE(sorted(defects.holes[1]).size(), std::size_t{3});
  const auto whole = closed(*obj(octahedron));
  QCOMPARE(whole.mesh->triangles.size(), std::size_t{8});
  QVERIFY(find_defects(*whole.mesh).empty());
}

void MeshRepairTest::duplicates_are_welded_and_a_seam_is_no_hole() {
  // Both triangles of the top have corners of their own.
  const auto mesh = obj(corners + sides + "v 0 0 2\nv 2 2 2\nf 9 6 10\nf 9 10 8\n");
  const auto defects = find_defects(*mesh);
  QCOMPARE(defects.duplicates, (Ids{8, 9}));
  QCOMPARE(found(*mesh), QString("2 duplicate vertices"));
  const auto welded = weld(*mesh);
  QCOMPARE(welded.new_ids, (Ids{0, 1, 2, 3, 4, 5, 6, 7, 4, 6}));
  QVERIFY(find_defects(*welded.mesh).empty());
  QCOMPARE(obj_text(*welded.mesh), obj_text(*obj(corners + sides + "f 5 6 7\nf 5 7 8\n")));
  QCOMPARE(welded.mesh->link_count(), LinkId{18});  // 12 edges and 6 diagonals
}

void MeshRepairTest::a_polygon_with_welded_corners_becomes_a_triangle() {
  const auto welded = weld(*obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 0\nv 5 0 0\nf 1 2 3 4\nf 2 5 4 3\n"));
  QVERIFY(welded.mesh->polygons.empty());
  QCOMPARE(welded.mesh->triangles, (std::vector<std::array<ElementId, 3>>{{0, 1, 2}, {1, 3, 2}}));
  QCOMPARE(welded.mesh->link_count(), LinkId{5});
}

void MeshRepairTest::a_polygon_that_becomes_a_point_is_left_out() {
  const auto welded = weld(*obj("v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 5 6\n"));
  QVERIFY(welded.mesh->polygons.empty());
  QCOMPARE(welded.mesh->triangles, (std::vector<std::array<ElementId, 3>>{{0, 1, 2}}));
  QCOMPARE(welded.mesh->link_count(), LinkId{3});
}

void MeshRepairTest::faces_that_become_equal_are_left_out() {
  const auto welded = weld(*obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 5 6 4\n"));
  QCOMPARE(welded.mesh->element_count(), 3U);
  QCOMPARE(welded.mesh->triangles.size(), std::size_t{1});
}

/// Files may contain faces and cells without links.
void MeshRepairTest::corners_of_faces_are_not_loose() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}, {3, 3, 0}, {0, 0, 1}, {1, 1, 1}};
  parts.triangles = {{0, 1, 2}};
  parts.tetrahedra = {{0, 1, 2, 5}};
  parts.links = {{3, 4}};
  const auto mesh = build_mesh(parts);
  QCOMPARE(find_defects(*mesh).loose, Ids{6});
  const auto kept = remove_loose(*mesh).mesh;
  QCOMPARE(kept->element_count(), 6U);
  QVERIFY(kept->triangles == mesh->triangles && kept->tetrahedra == mesh->tetrahedra);
}

void MeshRepairTest::loose_points_are_removed() {
  const auto mesh = obj("v 9 9 9\n" + corners + "v 8 8 8\nf 2 4 3\nf 2 5 4\nl 6 7\nl 8 9\n");
  QCOMPARE(find_defects(*mesh).loose, (Ids{0, 9}));
  const auto kept = remove_loose(*mesh);
  QCOMPARE(kept.mesh->element_count(), 8U);
  QCOMPARE(kept.new_ids, (Ids{Repaired::gone, 0, 1, 2, 3, 4, 5, 6, 7, Repaired::gone}));
  QCOMPARE(obj_text(*kept.mesh), obj_text(*obj(corners + "f 1 3 2\nf 1 4 3\nl 5 6\nl 7 8\n")));
}

void MeshRepairTest::a_mesh_without_links_keeps_its_points() {
  const auto mesh = dat("0 0\n1 0\n2 0\n", "3x1.dat");
  QVERIFY(find_defects(*mesh).empty());
  QCOMPARE(remove_loose(*mesh).mesh->element_count(), 3U);
}

void MeshRepairTest::rows_of_neighbours_keep_their_order() {
  const auto kept = remove_loose(*dat("0 0\n1 2 3 2\n2 1 1\n3 1 1\n", "4x1.dat")).mesh;
  const auto row = kept->neighbours_of(0);
  QCOMPARE(Ids(row.begin(), row.end()), (Ids{2, 1}));
}

void MeshRepairTest::a_fin_is_a_non_manifold_edge() {
  const auto mesh = obj(corners + sides + top + "v 3 0 3\nf 5 6 9\n");
  const auto defects = find_defects(*mesh);
  QCOMPARE(defects.non_manifold, (std::vector<std::array<ElementId, 2>>{{4, 5}}));
  QCOMPARE(found(*mesh), QString("1 non-manifold edge"));
  QCOMPARE(defects.outlines, std::size_t{0});  // the border of the fin is no closed loop
}

void MeshRepairTest::a_closed_hole_keeps_all_ids_and_can_be_filled() {
  const auto mesh = obj(corners + sides);
  QVERIFY(error_of([&] { fill(*mesh, 1); }).contains("1 hole"));
  const auto whole = closed(*mesh).mesh;
  QVERIFY(find_defects(*whole).empty());
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    QCOMPARE(whole->rest_position(e), mesh->rest_position(e));
  }
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    QCOMPARE(whole->triangles[t], mesh->triangles[t]);
  }
  for (const auto& [a, b] : mesh->links) {
    QVERIFY(find_link(*whole, a, b));
  }
  for (const auto& [a, b, c] : whole->triangles) {
    QVERIFY(find_link(*whole, a, b) && find_link(*whole, b, c) && find_link(*whole, c, a));
  }
  QVERIFY(fill(*whole, 1)->tetrahedra.size() > 1);
}

void MeshRepairTest::a_large_hole_gets_triangles_as_large_as_those_around_it() {
  MeshParts parts;  // an open box of 8 x 8 x 6 squares
  const auto block = made(MeshKind::block, {9, 9, 7});
  for (ElementId e = 0; e < block->element_count(); ++e) {
    parts.rest.push_back(block->rest_position(e));
  }
  const auto square = [&](ElementId a, ElementId b, ElementId c, ElementId d) {
    parts.triangles.push_back({a, b, c});
    parts.triangles.push_back({a, c, d});
  };
  const auto id = [](ElementId x, ElementId y, ElementId z) { return x + 9 * y + 81 * z; };
  for (ElementId i = 0; i < 8; ++i) {
    for (ElementId j = 0; j < 8; ++j) {
      square(id(i, j, 0), id(i, j + 1, 0), id(i + 1, j + 1, 0), id(i + 1, j, 0));
    }
    for (ElementId z = 0; z < 6; ++z) {
      for (const ElementId end : {0U, 8U}) {
        square(id(i, end, z), id(i + 1, end, z), id(i + 1, end, z + 1), id(i, end, z + 1));
        square(id(end, i, z), id(end, i + 1, z), id(end, i + 1, z + 1), id(end, i, z + 1));
      }
    }
  }
  add_links_along_edges(parts);
  const auto box = remove_loose(*build_mesh(parts)).mesh;
  QCOMPARE(found(*box), QString("1 hole (32 edges)"));
  const auto whole = closed(*box).mesh;
  QVERIFY(find_defects(*whole).empty());
  QVERIFY(whole->element_count() > box->element_count() + 20);
  for (LinkId link = 0; link < whole->link_count(); ++link) {
    QVERIFY(rest_length(*whole, link) < 2.5);  // the hole is 8 wide
  }
  for (ElementId e = box->element_count(); e < whole->element_count(); ++e) {
    QVERIFY(std::abs(whole->rest_position(e).z() - 6) < 1e-9);  // flat, as its border is
  }
}

/// The hole is found, and closed, although one of its corners has a duplicate.
void MeshRepairTest::a_seam_that_is_not_welded_does_not_keep_a_hole_open() {
  std::string text = corners + sides + "v 0 0 2\n";
  text.replace(text.find("f 1 6 5\n"), 8, "f 1 6 9\n");
  const auto mesh = obj(text);
  QCOMPARE(found(*mesh), QString("1 duplicate vertex, 1 hole (4 edges)"));
  const auto whole = closed(*mesh).mesh;
  QCOMPARE(found(*whole), QString("1 duplicate vertex"));
  QVERIFY(find_defects(*weld(*whole).mesh).empty());
}

/// A fin at an edge that ends at the hole, before or after the other faces. The patch has their orientation.
void MeshRepairTest::a_hole_at_a_non_manifold_edge_is_closed() {
  for (const char* fin : {"f 1 5 9\n", "f 2 6 9\n", "f 3 7 9\n", "f 4 8 9\n"}) {
    const std::string bottomless = sides.substr(16) + top;
    for (const std::string& faces : {sides + fin, fin + sides, bottomless + fin}) {
      const auto mesh = obj(corners + "v 4 -3 0\n" + faces);
      QCOMPARE(found(*mesh), QString("1 hole (4 edges), 1 non-manifold edge"));
      const auto whole = closed(*mesh).mesh;
      QCOMPARE(found(*whole), QString("1 non-manifold edge"));
      QCOMPARE(whole->element_count(), mesh->element_count());
      for (std::size_t t = mesh->triangles.size(); t < whole->triangles.size(); ++t) {
        const auto& [a, b, c] = whole->triangles[t];
        const Point from = whole->rest_position(a);
        const double up = (whole->rest_position(b) - from).cross(whole->rest_position(c) - from).z();
        QCOMPARE(up > 0, from.z() > 1);  // it faces outside
      }
    }
  }
}

void MeshRepairTest::a_border_is_judged_by_its_own_piece_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<int>("corner");
  QTest::addColumn<QString>("words");
  for (int corner = 0; corner < 4; ++corner) {
    QTest::addRow("large hole at corner %d", corner)
        << QByteArray::fromStdString(corners + sides) << corner << "1 hole (4 edges), 1 non-manifold edge";
  }
  // Two squares that share no edge: the outline of the small one is no hole, however large the piece beside it is.
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  for (int corner = 0; corner < 4; ++corner) {
    QTest::addRow("outline at corner %d", corner)
        << QByteArray::fromStdString(square) << corner << "1 non-manifold edge";
  }
}

/// A closed tetrahedron with a fin touches another piece at one corner of its border. The edges of the fin lead away
/// from the border and end there, so whoever walks along them comes back. Only the size of the border's own piece says
/// whether it is a hole.
void MeshRepairTest::a_border_is_judged_by_its_own_piece() {
  QFETCH(QByteArray, text);
  QFETCH(int, corner);
  QFETCH(QString, words);
  const bool is_small = words.startsWith("1 hole");
  const double size = is_small ? 0.01 : 50;
  const auto piece = obj(text.toStdString());
  const ElementId first = is_small ? 4 : 0, at = first + ElementId(corner), count = piece->element_count();
  const Point from = piece->rest_position(at);
  MeshParts parts;
  for (ElementId e = 0; e < count; ++e) {
    parts.rest.push_back(piece->rest_position(e));
  }
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 1.0}, {-1.0, -1.0, 1.0}}) {
    parts.rest.push_back(from + size * Point(x, y, z));
  }
  parts.triangles = piece->triangles;
  const ElementId a = count, b = count + 1, c = count + 2, tip = count + 3;
  for (const auto& face : {std::array{at, a, b}, {at, b, c}, {at, c, a}, {a, c, b}, {at, a, tip}}) {
    parts.triangles.push_back(face);
  }
  add_links_along_edges(parts);
  QCOMPARE(found(*build_mesh(parts)), words);
}

void MeshRepairTest::cells_that_are_inside_out_are_turned_data() {
  QTest::addColumn<bool>("of_tetrahedra");
  QTest::newRow("tetrahedra") << true;
  QTest::newRow("hexahedra") << false;
}

/// Methods for cells refuse some that are turned the other way, and name the repair. If all are, nothing is wrong.
void MeshRepairTest::cells_that_are_inside_out_are_turned() {
  QFETCH(bool, of_tetrahedra);
  const auto whole = of_tetrahedra ? made(MeshKind::tetra, {3, 3, 3})
                                   : read_mesh(source_file("tests/files/foreign/gmsh_hexahedra.vtk"));
  const auto with_turned = [&](std::size_t count) {
    MeshParts parts;
    for (ElementId e = 0; e < whole->element_count(); ++e) {
      parts.rest.push_back(whole->rest_position(e));
    }
    parts.links = whole->links;
    parts.tetrahedra = whole->tetrahedra;
    parts.hexahedra = whole->hexahedra;
    for (std::size_t i = 0; i < count; ++i) {
      if (of_tetrahedra) {
        std::swap(parts.tetrahedra[i][0], parts.tetrahedra[i][1]);
      } else {
        std::swap(parts.hexahedra[i][1], parts.hexahedra[i][3]);
        std::swap(parts.hexahedra[i][5], parts.hexahedra[i][7]);
      }
    }
    return build_mesh(parts);
  };
  const auto refusal = [](const Mesh& mesh) { return error_of([&] { build_simplices(mesh, {}, {}); }); };
  const auto mixed = with_turned(2);
  QVERIFY2(
      refusal(*mixed).endsWith("; turn such cells with 'chainmail repair', or with Object > Repair in the workbench"),
      qPrintable(refusal(*mixed)));
  const auto defects = find_defects(*mixed);
  QCOMPARE(defects.inverted, (std::vector<std::uint32_t>{0, 1}));
  QCOMPARE(found(*mixed), QString("2 cells inside out"));
  const auto repaired = turn_cells(*mixed, defects.inverted);
  QVERIFY(find_defects(*repaired.mesh).empty());
  QCOMPARE(refusal(*repaired.mesh), QString());
  QCOMPARE(volume_of(*repaired.mesh), volume_of(*whole));
  QCOMPARE(repaired.mesh->links, whole->links);
  QCOMPARE(repaired.new_ids.back(), whole->element_count() - 1);
  QVERIFY(find_defects(*with_turned(whole->tetrahedra.size() + whole->hexahedra.size())).empty());
}

void MeshRepairTest::a_picture_stays_on_its_sheet() {
  const auto sheet = sheet_with_hole();
  const auto whole = closed(*sheet).mesh;
  QVERIFY(is_sheet(*whole));
  QCOMPARE(whole->texture, sheet->texture);
  QCOMPARE(whole->space_dimension, 2);
  QCOMPARE(whole->triangles.size(), sheet->triangles.size() + 2);
  QCOMPARE(weld(*sheet).mesh->texture, sheet->texture);
  QCOMPARE(remove_loose(*sheet).mesh->texture, sheet->texture);
}

void MeshRepairTest::the_softness_of_links_stays() {
  const auto mesh = obj("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nl 2 3\nl 3 4\nl 4 5\n");
  OwnSoftness own;
  const LinkSoftness soft{0.5, 1.5, 0.2}, softer{0.4, 1.6, 0.3};
  own.set(*find_link(*mesh, 2, 3), soft);
  own.set(*find_link(*mesh, 3, 4), softer);
  const auto welded = weld(*mesh);
  const auto after = softness_after(own, *mesh, welded);
  QCOMPARE(after.size(), std::size_t{2});
  QVERIFY(*after.find(*find_link(*welded.mesh, 2, 3)) == soft);
  QVERIFY(*after.find(*find_link(*welded.mesh, 1, 3)) == softer);
  const auto kept = remove_loose(*mesh);
  QVERIFY(*softness_after(own, *mesh, kept).find(*find_link(*kept.mesh, 1, 2)) == soft);
}

void MeshRepairTest::what_cannot_be_closed_is_one_sentence() {
  QCOMPARE(error_of([] {
             close_holes(*made(MeshKind::tetra, {2, 2, 2}), {});
           }),
           QString("surface: the object has cells, and only surfaces have holes; use a surface"));
  const auto straight = made(MeshKind::line, {5, 1, 1});
  QCOMPARE(error_of([&] {
             close_holes(*straight, {{0, 1, 2, 3, 4}});
           }),
           QString("surface: none of its holes can be closed; close them in another program"));
  Ids large(20'000);
  std::iota(large.begin(), large.end(), ElementId{0});
  const auto line = made(MeshKind::line, {20'000, 1, 1});
  QVERIFY(error_of([&] {
            close_holes(*line, {large});
          }).startsWith("surface: a hole has 20000 edges, and at most 10000 can be closed; "));
}

/// Triangles between a few random points intersect themselves and have all defects at once. Each repair ends with a
/// mesh or with a sentence, and closing holes keeps what was there.
void MeshRepairTest::random_triangles_are_repaired_or_refused() {
  std::mt19937 random(7);
  int closings = 0;
  for (int round = 0; round < 40; ++round) {
    MeshParts parts;
    for (int e = 0; e < 12; ++e) {
      parts.rest.emplace_back(random() % 4, random() % 4, random() % 4);
    }
    for (int t = 0; t < 10 + round; ++t) {
      const ElementId a = random() % 12, b = (a + 1 + random() % 4) % 12, c = (a + 5 + random() % 7) % 12;
      if (a != b && b != c && c != a) {
        parts.triangles.push_back({a, b, c});
      }
    }
    add_links_along_edges(parts);
    const auto mesh = build_mesh(parts);
    const auto clean = remove_loose(*weld(*mesh).mesh).mesh;
    const auto defects = find_defects(*clean);
    QVERIFY(defects.duplicates.empty() && defects.loose.empty());
    const QString sentence = error_of([&] {
      const auto whole = closed(*clean).mesh;
      QVERIFY(whole->element_count() >= clean->element_count());
      QVERIFY(std::equal(clean->rest.begin(), clean->rest.end(), whole->rest.begin()));
      for (const auto& [a, b, c] : whole->triangles) {
        QVERIFY(a != b && b != c && c != a);
      }
      ++closings;
    });
    QVERIFY2(sentence.isEmpty() || sentence.startsWith("surface: none of its holes can be closed") ||
                 sentence.startsWith("surface: CGAL failed to close its holes"),
             qPrintable(sentence));
  }
  QVERIFY2(closings > 3, qPrintable(QString::number(closings)));
}

void MeshRepairTest::it_can_be_cancelled() {
  const Progress job = Progress::watched();
  job.cancel();
  const auto mesh = obj(corners + sides);
  QVERIFY_THROWS_EXCEPTION(Cancelled, closed(*mesh, job));
  QVERIFY_THROWS_EXCEPTION(Cancelled, weld(*mesh, 0, job));
  QVERIFY_THROWS_EXCEPTION(Cancelled, find_defects(*mesh, job));
}

CHAINMAIL_TEST(MeshRepairTest)

}  // namespace chainmail::test_mesh_repair

#include "test_mesh_repair.moc"
