#include <Eigen/Geometry>
#include <QtTest>
#include <numeric>

#include "files/mesh/input_file.h"
#include "files/support.h"
#include "files/volume_of.h"
#include "folders.h"
#include "mesh/cells.h"
#include "program.h"

namespace chainmail::test_open_mesh {

using namespace chainmail::test;

/// Tests files of other programs: the mesh has their content with ids in their order, and nothing is lost without a
/// message.
class OpenMeshTest : public QObject {
  Q_OBJECT

 private slots:
  void files_of_other_programs_data();
  void files_of_other_programs();
  void ids_are_the_files_order_data();
  void ids_are_the_files_order();
  void content_goes_before_the_name();
  void each_format_is_known_by_its_signs();
  void sessions_and_pictures_are_no_meshes();
  void what_we_write_comes_back_data();
  void what_we_write_comes_back();
  void a_grid_without_its_points_is_refused();
  void voxels_and_pixels_have_corners_in_an_order_of_their_own();
  void flaws_are_told();
  void polygons_that_come_twice_are_left_out();
  void cells_inside_out_are_counted();
  void flat_cells_are_flat_in_any_unit();
  void a_strip_is_triangles_in_a_row();
  void what_others_hold_and_we_do_not_is_refused_data();
  void what_others_hold_and_we_do_not_is_refused();
  void damaged_files_give_one_sentence();
  void halves_of_a_pair_are_missed();
  void cancelling_ends_the_import_at_once();

 private:
  std::filesystem::path path(const std::string& name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }
  QString refusal(const std::string& name, const std::string& text) {
    put_file(path(name), text);
    return error_of([&] { open_mesh(path(name)); });
  }

  QTemporaryDir folder_;
};

void OpenMeshTest::files_of_other_programs_data() {
  QTest::addColumn<unsigned>("elements");
  QTest::addColumn<unsigned>("links");
  QTest::addColumn<unsigned>("triangles");
  QTest::addColumn<unsigned>("tetrahedra");
  QTest::addColumn<unsigned>("hexahedra");
  QTest::addColumn<double>("volume");
  const auto row = [](const char* name, unsigned elements, unsigned links, unsigned triangles, unsigned tetrahedra,
                      unsigned hexahedra, double volume) {
    QTest::newRow(name) << elements << links << triangles << tetrahedra << hexahedra << volume;
  };
  // For a ball, elements - links + sides - cells is 1. Each cell has four sides, and each side inside belongs to two
  // cells.
  const unsigned sides = (4 * 91 + 84) / 2;
  for (const char* name :
       {"gmsh22.msh", "gmsh41.msh", "gmsh41_binary.msh", "gmsh.mesh", "gmsh_binary.vtk", "meshio_51.vtk"}) {
    row(name, 44, 44 + sides - 91 - 1, 84, 91, 0, 2);
  }
  // For its surface, elements - links + triangles is 2.
  for (const char* name : {"gmsh_binary.stl", "assimp.obj", "meshio.off"}) {
    row(name, 44, 44 + 84 - 2, 84, 0, 0, 0);
  }
  row("assimp_binary.ply", 3 * 84, 3 * 84, 84, 0, 0, 0);
  row("vtk.ply", 20, 20 + 36 - 2, 36, 0, 0, 0);
  row("vtk_sphere.vtk", 20, 20 + 36 - 2, 36, 0, 0, 0);
  row("vtk_line.vtk", 4, 3, 0, 0, 0, 0);
  // 4 x 3 x 2 points; each of the 22 outer quadrangles is drawn as two triangles.
  const unsigned grid = 3 * 3 * 2 + 4 * 2 * 2 + 4 * 3;
  row("gmsh_hexahedra.msh", 24, grid, 2 * 22, 0, 6, 6);
  row("gmsh_hexahedra.vtk", 24, grid, 2 * 22, 0, 6, 6);
  row("tetgen.node", 28, 87, 0, 34, 0, 2);  // 28 - 87 + (4·34 + 52)/2 - 34 = 1
  row("tetgen.ele", 28, 87, 0, 34, 0, 2);
  for (const char* name : {"vtk.mha", "vtk.mhd", "teem.nrrd", "teem.nhdr"}) {
    row(name, 24, grid, 0, 0, 6, 12);  // 4 x 3 x 2 voxels, two units apart along z
  }
}

void OpenMeshTest::files_of_other_programs() {
  const auto opened = open_mesh(source_file("tests/files/foreign") / QTest::currentDataTag());
  const Mesh& mesh = *opened.mesh;
  QTEST(unsigned(mesh.element_count()), "elements");
  QTEST(unsigned(mesh.link_count()), "links");
  QTEST(unsigned(mesh.triangles.size()), "triangles");
  QTEST(unsigned(mesh.tetrahedra.size()), "tetrahedra");
  QTEST(unsigned(mesh.hexahedra.size()), "hexahedra");
  QFETCH(double, volume);
  QVERIFY(std::abs(volume_of(mesh) - volume) < 1e-6);  // some of the files have only seven digits
  QCOMPARE(opened.flaws.coincident, std::uint64_t(mesh.element_count() == 3 * 84 ? 3 * 84 - 44 : 0));
  QCOMPARE(opened.flaws.collapsed + opened.flaws.doubled + opened.flaws.flat + opened.flaws.inverted, std::uint64_t{0});
}

void OpenMeshTest::ids_are_the_files_order_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::newRow("a.off") << QByteArray(
      "OFF\n# c\n5 1 0\n5 5 5\n0 0 0\n2 0 0\n1 1.0000000000000002 0\n7 7 10000000.001\n3 1 2 3\n");
  QTest::newRow("a.ply") << QByteArray(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "5 5 5\n0 0 0\n2 0 0\n1 1.0000000000000002 0\n7 7 10000000.001\n3 1 2 3\n");
  QTest::newRow("a.vtk") << QByteArray(
      "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n5 5 5\n0 0 0\n2 0 0\n"
      "1 1.0000000000000002 0\n7 7 10000000.001\nPOLYGONS 1 4\n3 1 2 3\n");
}

/// Unused points are elements too, and all digits of a double are read.
void OpenMeshTest::ids_are_the_files_order() {
  QFETCH(QByteArray, text);
  put_file(path(QTest::currentDataTag()), text.toStdString());
  const auto mesh = open_mesh(path(QTest::currentDataTag())).mesh;
  QCOMPARE(mesh->element_count(), 5U);
  QCOMPARE(mesh->rest_position(0), Point(5, 5, 5));
  QCOMPARE(mesh->rest_position(3), Point(1, 1.0000000000000002, 0));
  QCOMPARE(mesh->rest_position(4), Point(7, 7, 10000000.001));
  QCOMPARE(mesh->links, (std::vector<std::array<ElementId, 2>>{{1, 2}, {1, 3}, {2, 3}}));
}

void OpenMeshTest::content_goes_before_the_name() {
  const std::filesystem::path folder = source_file("tests/files/foreign");
  std::filesystem::copy(folder / "gmsh22.msh", path("box.obj"));
  std::filesystem::copy(folder / "meshio.off", path("box"));
  std::filesystem::copy(folder / "gmsh.mesh", path("box.vtk"));
  QCOMPARE(open_mesh(path("box.obj")).mesh->tetrahedra.size(), std::size_t{91});
  QCOMPARE(open_mesh(path("box")).mesh->triangles.size(), std::size_t{84});
  QCOMPARE(open_mesh(path("box.vtk")).mesh->tetrahedra.size(), std::size_t{91});
}

/// The content identifies the format, also after a comment and whatever the file's name.
void OpenMeshTest::each_format_is_known_by_its_signs() {
  int signs = 0;
  for (const MeshFormat& format : mesh_formats()) {
    for (const std::string_view sign : format.signs) {
      const std::string begin = (signs % 2 == 0 || sign.starts_with('#') ? "" : "# a comment\n\n") + std::string(sign);
      put_file(path("unnamed"), begin + " and more");
      QVERIFY2(sign.empty() || open_file(path("unnamed")).format == &format, begin.c_str());
      signs += sign.empty() ? 0 : 1;
    }
    QVERIFY(format.reads() || format.signs.front().empty());
  }
  QVERIFY(signs > 10);
}

/// A session is known by its name in any case, a picture by its name or its content.
void OpenMeshTest::sessions_and_pictures_are_no_meshes() {
  const std::string line = "v 0 0 0\nv 1 0 0\nl 1 2\n", png = "\x89PNG\r\n\x1a\n";
  const auto kind = [&](const char* name, const std::string& text) {
    put_file(path(name), text);
    return open_file(path(name)).kind;
  };
  QVERIFY(kind("a.chainmail", line) == FileKind::session && kind("A.ChainMail", "") == FileKind::session);
  QVERIFY(kind("a.png", line) == FileKind::picture && kind("a.JPEG", "") == FileKind::picture);
  QVERIFY(kind("png.dat", png) == FileKind::picture);
  QVERIFY(kind("chainmail", line) == FileKind::mesh && kind("a.chainmail.obj", "# none") == FileKind::mesh);
  QVERIFY(open_file(source_file("meshes/scan.mha")).kind == FileKind::volume);
  QVERIFY(refusal("a.chainmail", "{}").contains("a.chainmail: the ending .chainmail is not known; open a mesh in "));
  QVERIFY(refusal("png.obj", png)
              .endsWith("png.obj: it is a picture; use a mesh; the workbench opens PNG and JPEG "
                        "pictures as sheets"));
}

void OpenMeshTest::what_we_write_comes_back_data() {
  QTest::addColumn<QString>("source");
  QTest::newRow("a.msh") << "gmsh22.msh";
  QTest::newRow("b.msh") << "gmsh_hexahedra.vtk";
  QTest::newRow("c.msh") << "vtk_line.vtk";
  QTest::newRow("a.obj") << "meshio.off";
  QTest::newRow("a.ply") << "meshio.off";
  QTest::newRow("b.ply") << "gmsh_hexahedra.vtk";  // the links of its cells as edges
}

void OpenMeshTest::what_we_write_comes_back() {
  QFETCH(QString, source);
  const auto mesh = open_mesh(source_file("tests/files/foreign") / source.toStdString()).mesh;
  const auto written = path(QTest::currentDataTag());
  save_mesh(written, {*mesh, {}, rest_positions(*mesh), {}});
  const auto again = open_mesh(written).mesh;
  QCOMPARE(again->links, mesh->links);
  QCOMPARE(again->rest, mesh->rest);  // to the bit
  QCOMPARE(again->triangles.size(), mesh->triangles.size());
  if (written.extension() == ".msh") {  // the other formats have no cells
    QCOMPARE(again->tetrahedra, mesh->tetrahedra);
    QCOMPARE(again->hexahedra, mesh->hexahedra);
  }
}

/// Points of a grid are not invented where its kind says that the file lists them.
void OpenMeshTest::a_grid_without_its_points_is_refused() {
  const std::string head = "# vtk DataFile Version 3.0\na\nASCII\nDATASET ";
  for (const char* spacing : {"SPACING", "ASPECT_RATIO"}) {  // the latter in files of older programs
    put_file(path("spaced.vtk"),
             "# vtk DataFile Version 2.0\na\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\nORIGIN 0 0 0\n" +
                 std::string(spacing) + " 3 4 5\n");
    QCOMPARE(open_mesh(path("spaced.vtk")).mesh->box[1], Point(3, 4, 0));
  }
  put_file(path("bent.vtk"), head + "STRUCTURED_GRID\nDIMENSIONS 2 2 1\n");
  put_file(path("boxes.vtk"), head +
                                  "RECTILINEAR_GRID\nDIMENSIONS 2 2 1\nX_COORDINATES 2 double\n0 1\n"
                                  "Y_COORDINATES 2 double\n0 3\n");
  QVERIFY(error_of([&] { open_mesh(path("bent.vtk")); }).contains("the section POINTS is missing"));
  QVERIFY(error_of([&] { open_mesh(path("boxes.vtk")); }).contains("the coordinates of an axis are missing"));
}

/// VTK lists the corners of voxels and pixels along x, then y, then z, and those of other cells around a side. Here all
/// are cubes and squares with edges of length 1.
void OpenMeshTest::voxels_and_pixels_have_corners_in_an_order_of_their_own() {
  const std::string head = "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  const std::string below = "0 0 0  1 0 0  2 0 0  0 1 0  1 1 0  2 1 0\n";
  put_file(path("voxels.vtk"), head + "POINTS 12 double\n" + below + "0 0 1  1 0 1  2 0 1  0 1 1  1 1 1  2 1 1\n" +
                                   "CELLS 2 18\n8 0 1 3 4 6 7 9 10\n8 1 2 4 5 7 8 10 11\nCELL_TYPES 2\n11 11\n");
  put_file(path("pixels.vtk"),
           head + "POINTS 6 double\n" + below + "CELLS 2 10\n4 0 1 3 4\n4 1 2 4 5\nCELL_TYPES 2\n8 8\n");
  const auto voxels = open_mesh(path("voxels.vtk")), pixels = open_mesh(path("pixels.vtk"));
  for (const auto& opened : {voxels, pixels}) {
    QCOMPARE(opened.flaws, MeshFlaws());
    for (LinkId link = 0; link < opened.mesh->link_count(); ++link) {
      QCOMPARE(rest_length(*opened.mesh, link), 1.0);
    }
  }
  QCOMPARE(voxels.mesh->link_count(), 20U);
  QCOMPARE(voxels.mesh->hexahedra.size(), std::size_t{2});
  for (const auto& cell : voxels.mesh->hexahedra) {
    Mesh one = *voxels.mesh;
    one.hexahedra = {cell};
    QCOMPARE(volume_of(one), 1.0);
  }
  QCOMPARE(pixels.mesh->link_count(), 7U);
  double area = 0;
  for (const auto& [a, b, c] : pixels.mesh->triangles) {
    const auto at = [&](ElementId e) { return pixels.mesh->rest_position(e); };
    const double doubled = (at(b) - at(a)).cross(at(c) - at(a)).z();
    QVERIFY(doubled > 0);
    area += doubled / 2;
  }
  QCOMPARE(area, 2.0);
}

void OpenMeshTest::flaws_are_told() {
  // A triangle, the same in another order, one that uses a point twice, one without an area, and two elements at one
  // position.
  put_file(path("flawed.off"),
           "OFF\n6 5 0\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n2 0 0\n5 5 0\n3 0 1 2\n3 2 0 1\n3 3 3 5\n3 0 1 3\n3 1 4 5\n");
  const auto opened = open_mesh(path("flawed.off"));
  QCOMPARE(opened.flaws, (MeshFlaws{0, 1, 1, 1, 0, 1}));
  QCOMPARE(opened.mesh->triangles.size(), std::size_t{3});
  QVERIFY2(find_link(*opened.mesh, 3, 5), "the edges of what is left out are links all the same");
  QCOMPARE(QString::fromStdString(in_words(opened.flaws)),
           QString("1 face or cell with a point used twice or fewer than 3, 1 duplicate face or cell left out; 1 face "
                   "or cell is "
                   "flat, 1 element shares its position with another"));
  QCOMPARE(in_words(open_mesh(source_file("tests/files/foreign/gmsh22.msh")).flaws), std::string());
  put_file(path("sides.off"), "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n2 1 2\n");
  QCOMPARE(open_mesh(path("sides.off")).flaws.collapsed, std::uint64_t{2});  // faces of two corners
}

/// A square, the same starting at another corner, one with other points, and one that uses a point twice.
void OpenMeshTest::polygons_that_come_twice_are_left_out() {
  put_file(path("squares.off"),
           "OFF\n6 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n4 0 1 2 3\n4 2 3 0 1\n4 1 4 5 2\n4 0 1 1 2\n");
  const auto opened = open_mesh(path("squares.off"));
  QCOMPARE(opened.flaws, (MeshFlaws{0, 1, 1, 0, 0, 0}));
  QCOMPARE(opened.mesh->triangles.size(), std::size_t{4});  // two squares
}

/// A cube, a tetrahedron and a flat tetrahedron, in sizes from micrometres to megametres.
void OpenMeshTest::flat_cells_are_flat_in_any_unit() {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    MeshParts parts;
    for (const Point& at : {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 0, 1),
                            Point(1, 0, 1), Point(1, 1, 1), Point(0, 1, 1)}) {
      parts.rest.push_back(unit * at);
    }
    parts.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
    parts.tetrahedra = {{0, 1, 3, 4}, {0, 1, 2, 3}};
    add_links_along_edges(parts);
    MeshFlaws flaws;
    count_flaws(*build_mesh(std::move(parts)), flaws);
    QCOMPARE(flaws.flat, std::uint64_t{1});
    QCOMPARE(flaws.inverted, std::uint64_t{0});
  }
}

void OpenMeshTest::a_strip_is_triangles_in_a_row() {
  put_file(path("strip.vtk"),
           "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 6 double\n"
           "0 0 0  0 1 0  1 0 0  1 1 0  2 0 0  2 1 0\nTRIANGLE_STRIPS 1 7\n6 0 1 2 3 4 5\n");
  const auto opened = open_mesh(path("strip.vtk"));
  QCOMPARE(opened.flaws, MeshFlaws());
  QCOMPARE(opened.mesh->triangles.size(), std::size_t{4});
  QCOMPARE(opened.mesh->link_count(), 9U);  // three across, two along each side, and two diagonals
  for (const auto& [a, b, c] : opened.mesh->triangles) {
    const auto at = [&](ElementId e) { return opened.mesh->rest_position(e); };
    QCOMPARE((at(b) - at(a)).cross(at(c) - at(a)) / 2, Point(0, 0, -0.5));  // all as the first one lists its corners
  }
}

/// A tetrahedron and a hexahedron, once correct and once mirrored. A flat cell does not count as inverted.
void OpenMeshTest::cells_inside_out_are_counted() {
  const std::string head =
      "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 13 double\n"
      "0 0 0  1 0 0  1 1 0  0 1 0  0 0 1  1 0 1  1 1 1  0 1 1\n5 0 0  6 0 0  5 1 0  5 0 1  6 1 0\n";
  const auto flaws = [&](const std::string& cells) {
    put_file(path("cells.vtk"), head + cells);
    return open_mesh(path("cells.vtk")).flaws;
  };
  const std::string types = "CELL_TYPES 2\n12 10\n";
  QCOMPARE(flaws("CELLS 2 14\n8 0 1 2 3 4 5 6 7\n4 8 9 10 11\n" + types), MeshFlaws());
  QCOMPARE(flaws("CELLS 2 14\n8 4 5 6 7 0 1 2 3\n4 8 9 10 11\n" + types).inverted, std::uint64_t{1});
  QCOMPARE(flaws("CELLS 2 14\n8 0 1 2 3 4 5 6 7\n4 8 10 9 11\n" + types).inverted, std::uint64_t{1});
  const MeshFlaws both = flaws("CELLS 2 14\n8 4 5 6 7 0 1 2 3\n4 8 10 9 11\n" + types);
  QCOMPARE(both.inverted, std::uint64_t{2});
  QCOMPARE(both.flat, std::uint64_t{0});
  QCOMPARE(in_words(both), std::string("2 cells are inside out"));
  const MeshFlaws flat = flaws("CELLS 2 14\n8 0 1 2 3 4 5 6 7\n4 8 9 10 12\n" + types);
  QCOMPARE(flat.flat, std::uint64_t{1});
  QCOMPARE(flat.inverted, std::uint64_t{0});
}

void OpenMeshTest::what_others_hold_and_we_do_not_is_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("sentence");
  const QByteArray msh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "5 1 0 1\n6 0 1 1\n$EndNodes\n$Elements\n1\n";
  QTest::newRow("third.msh") << msh + "1 26 2 0 1 1 2 3 4\n$EndElements\n"
                             << "third.msh:15: Gmsh's type 26 is of higher order";
  const QByteArray vtk = "# vtk DataFile Version 2.0\na\nASCII\nDATASET ";
  QTest::newRow("grid.vtk") << vtk + "TABLE\n"
                            << "'TABLE' is not supported; ";
  QTest::newRow("cloud.vtk") << vtk + "POLYDATA\nPOINTS 2 float\n0 0 0 1 1 1\n"
                             << "it contains points without links; ";
  QTest::newRow("cloud.off") << QByteArray("OFF\n2 0 0\n0 0 0\n1 1 1\n") << "it contains points without links; ";
  for (const char* name : {"headless.off", "OF.off", "OFFx.off", "other.off"}) {
    const QByteArray head = name == std::string("headless.off") ? QByteArray() : QByteArray(name).chopped(4) + '\n';
    QTest::newRow(name) << head + "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
                        << "it does not begin with OFF; ";
  }
}

void OpenMeshTest::what_others_hold_and_we_do_not_is_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, sentence);
  const QString error = refusal(QTest::currentDataTag(), text.toStdString());
  QVERIFY2(error.contains(sentence), qPrintable(error));
}

/// A file cut off at any place gives an error sentence or a part of the mesh, even if a library crashes or hangs.
void OpenMeshTest::damaged_files_give_one_sentence() {
  for (const char* name : {"gmsh41_binary.msh", "assimp_binary.ply", "gmsh_binary.stl", "gmsh.mesh", "teem.nrrd"}) {
    const std::string whole = file_text(source_file("tests/files/foreign") / name);
    for (const double share : {0.3, 0.9}) {
      const auto cut = path(std::string("cut_") + name);
      put_file(cut, whole.substr(0, std::size_t(share * double(whole.size()))));
      const QString error = error_of([&] { open_mesh(cut); });
      QVERIFY2(!error.isEmpty() && !error.contains('\n') && error.contains(name), name);
    }
  }
}

void OpenMeshTest::halves_of_a_pair_are_missed() {
  std::filesystem::copy(source_file("tests/files/foreign/tetgen.node"), path("half.node"));
  QVERIFY(
      error_of([&] { open_mesh(path("half.node")); }).contains("the other file of the pair, half.ele, is missing; "));
}

void OpenMeshTest::cancelling_ends_the_import_at_once() {
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, open_mesh(source_file("tests/files/foreign/gmsh22.msh"), {}, job));
}

CHAINMAIL_TEST(OpenMeshTest)

}  // namespace chainmail::test_open_mesh

#include "test_open_mesh.moc"
