#include <QByteArray>
#include <QtTest>
#include <cstring>
#include <sstream>

#include "files/formats/mesh_pieces.h"
#include "files/mesh/mesh_formats.h"
#include "files/support.h"
#include "files/text/outputs.h"
#include "measure/violation.h"
#include "mesh/cells.h"
#include "program.h"

namespace chainmail::test_writers {

using namespace chainmail::test;

namespace fs = std::filesystem;

namespace {

/// Moves the first two elements by 0.3, a number that needs all its digits.
std::vector<double> pulled(const Mesh& mesh) {
  std::vector<double> positions = mesh.rest;
  for (int k = 0; k < 2 * mesh.space_dimension; ++k) {
    positions[k] += 0.1 + 0.2;
  }
  return positions;
}

PositionView view(const Mesh& mesh, const std::vector<double>& positions) {
  return {positions.data(), mesh.space_dimension * sizeof(double), Precision::double_precision};
}

/// A tetrahedron, a hexahedron, a pentagon, and a link that is not an edge of any of them.
MeshPointer one_of_each() {
  MeshParts parts;
  for (int z = 0; z < 2; ++z) {
    for (const auto& [x, y] : {std::array{0, 0}, std::array{1, 0}, std::array{1, 1}, std::array{0, 1}}) {
      parts.rest.emplace_back(x, y, z);
    }
  }
  parts.rest.emplace_back(0.5, 0.5, 2);
  parts.rest.emplace_back(0.5, 0.5, 3);
  parts.hexahedra.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  parts.tetrahedra.push_back({4, 5, 6, 8});
  parts.polygons = {5, 0, 3, 7, 8, 4, 4, 0, 1, 2, 3};
  add_links_along_edges(parts);
  parts.links.push_back({8, 9});
  return build_mesh(std::move(parts));
}

std::string written(const char* name, const MeshState& state) {
  std::ostringstream out;
  write_mesh(out, mesh_format(name, FormatUse::write), state);
  return out.str();
}

/// Returns the numbers in the lines of a text between the lines `begin` and `end`.
QList<QList<double>> rows(const std::string& text, const std::string& begin, const std::string& end) {
  QList<QList<double>> result;
  std::istringstream lines(text.substr(text.find(begin + "\n") + begin.size() + 1));
  for (std::string line; std::getline(lines, line) && line != end;) {
    result.append(QList<double>{});
    for (const QString& word : QString::fromStdString(line).split(' ')) {
      result.last().append(word.toDouble());
    }
  }
  return result;
}

/// Returns the array with this name in a .vtu file.
template <class Number>
QList<Number> array(const std::string& text, const std::string& name) {
  const auto begin = text.find('\n', text.find("Name=\"" + name + "\"")) + 1;
  const auto bytes =
      QByteArray::fromBase64(QByteArray::fromStdString(text.substr(begin, text.find('\n', begin) - begin)),
                             QByteArray::AbortOnBase64DecodingErrors);
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  QList<Number> numbers(qsizetype(size / sizeof(Number)));
  if (std::uint64_t(bytes.size()) == size + sizeof size) {
    std::memcpy(numbers.data(), bytes.data() + sizeof size, size);
  }
  return numbers;
}

}  // namespace

/// Tests the written files as a reader of each format reads them.
class WritersTest : public QObject {
  Q_OBJECT

 private slots:
  void what_a_format_loses_is_said_of_all_cells();
  void ply_holds_faces_and_edges();
  void ply_without_edges_names_none();
  void vtu_holds_every_piece();
  void vtu_holds_both_fields();
  void vtu_counts_no_cut_link_as_violated();
  void msh_is_as_documented();
  void msh_tells_large_faces_by_their_links();
  void msh_of_elements_alone();
  void stl_has_normals_of_the_deformed_faces();
  void cut_pieces_are_gone();
  void positions_are_told_to_the_bit();
  void other_edges_of_a_cut_face_are_lines();
  void a_full_disk_is_told_data();
  void a_full_disk_is_told();

 private:
  MeshPointer mesh_ = one_of_each();
  Softness softness_;
};

void WritersTest::what_a_format_loses_is_said_of_all_cells() {
  for (const MeshKind kind : {MeshKind::tetra, MeshKind::cloth}) {
    const MeshPointer mesh = made(kind, {3, 3, kind == MeshKind::cloth ? 1U : 3U});
    QCOMPARE(lost_in(mesh_format("a.obj", FormatUse::write), *mesh).empty(), !mesh->has_cells());
  }
  MeshParts parts;
  for (int i = 0; i < 8; ++i) {
    parts.rest.emplace_back(double((i ^ i >> 1) & 1), double(i >> 1 & 1), double(i >> 2));
  }
  parts.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}};
  add_links_along_edges(parts);
  const MeshPointer hexahedron = build_mesh(std::move(parts));
  for (const char* file : {"a.obj", "a.ply"}) {
    QVERIFY(lost_in(mesh_format(file, FormatUse::write), *hexahedron).ends_with("links inside as lines"));
  }
}

void WritersTest::ply_holds_faces_and_edges() {
  const std::string text = written("a.ply", {*mesh_, {}, rest_positions(*mesh_), softness_});
  QVERIFY(text.starts_with("ply\nformat ascii 1.0\n"));
  QVERIFY(text.find("element vertex 10\n") != text.npos && text.find("element face 11\n") != text.npos);
  const auto body = rows(text, "end_header", "");
  QCOMPARE(body.mid(10, 2), (QList<QList<double>>{{5, 0, 3, 7, 8, 4}, {4, 0, 1, 2, 3}}));
  // The sides of the cells follow, but for the one that is a face already. One link is along no face.
  QCOMPARE(body.size(), 10 + 2 + (5 + 4) + 1);
  QCOMPARE(body.last(), (QList<double>{8, 9}));
  QVERIFY(text.find("element edge " + std::to_string(1) + "\n") != text.npos);
}

void WritersTest::ply_without_edges_names_none() {
  const auto cloth = made(MeshKind::cloth, {3, 2, 1});
  const std::string text = written("a.ply", {*cloth, {}, rest_positions(*cloth), softness_});
  QVERIFY(text.find("element edge") == text.npos);
  QCOMPARE(rows(text, "end_header", "").size(), 6 + 4);
}

void WritersTest::vtu_holds_every_piece() {
  const std::string text = written("a.vtu", {*mesh_, {}, rest_positions(*mesh_), softness_});
  QVERIFY(text.find("NumberOfPoints=\"10\" NumberOfCells=\"5\"") != text.npos);
  // One line for 8-9; then pentagon, quadrangle, tetrahedron and hexahedron.
  QCOMPARE(array<std::uint8_t>(text, "types"), (QList<std::uint8_t>{3, 7, 9, 10, 12}));
}

void WritersTest::vtu_holds_both_fields() {
  const auto positions = pulled(*mesh_);
  Softness softness{{1, 1, 0}, {}};
  softness.links.set(*find_link(*mesh_, 0, 3), {0, 100, 100});
  const PositionView at = view(*mesh_, positions);
  const std::string text = written("a.vtu", {*mesh_, {}, at, softness});
  const auto displacement = array<double>(text, "displacement");
  const auto violation = array<double>(text, "violation");
  QCOMPARE(displacement.size(), 30);
  QCOMPARE(violation.size(), 10);
  QCOMPARE(displacement[4], positions[4] - mesh_->rest[4]);
  QCOMPARE(displacement[6], 0.0);
  // Element 3 has links to 0, which moved within its valid region, and to 2 and 7, which did not move. The link between
  // 4 and 0 is violated.
  QCOMPARE(violation[3], 0.0);
  QCOMPARE(violation[4], link_violation(*mesh_, softness, at, *find_link(*mesh_, 0, 4)));
  QVERIFY(violation[4] > 0.1);
}

/// Two halves that a cut separates may be as far from each other as they like.
void WritersTest::vtu_counts_no_cut_link_as_violated() {
  const auto line = made(MeshKind::line, {4, 1, 1});
  const std::vector<double> positions{0, 1, 7, 9};  // of the links, 1-2 is 6 and 2-3 is 2 long
  const Softness softness{{0.5, 1.5, 0}, {}};
  Cuts cuts(line);
  const auto violations = [&] {
    return array<double>(written("a.vtu", {*line, cuts, view(*line, positions), softness}), "violation");
  };
  QCOMPARE(violations(), (QList<double>{0, 4.5, 4.5, 0.5}));
  cuts.cut(*find_link(*line, 1, 2));
  QCOMPARE(violations(), (QList<double>{0, 0, 0.5, 0.5}));
}

void WritersTest::msh_is_as_documented() {
  const auto cloth = made(MeshKind::cloth, {2, 2, 1}, 0.5);
  QCOMPARE(written("a.msh", {*cloth, {}, rest_positions(*cloth), softness_}),
           std::string("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                       "$Entities\n0 0 1 0\n1 0 0 0 0.5 0.5 0 0 0\n$EndEntities\n"
                       "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n0.5 0 0\n0 0.5 0\n0.5 0.5 0\n$EndNodes\n"
                       "$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 4\n2 1 4 3\n$EndElements\n"));
}

void WritersTest::msh_tells_large_faces_by_their_links() {
  const auto elements =
      rows(written("a.msh", {*mesh_, {}, rest_positions(*mesh_), softness_}), "$Elements", "$EndElements");
  // Lines: 7-8, which only the pentagon has, and 8-9; then the quadrangle and the cells.
  QCOMPARE(elements, (QList<QList<double>>{{4, 5, 1, 5},
                                           {1, 1, 1, 2},
                                           {1, 8, 9},
                                           {2, 9, 10},
                                           {2, 1, 3, 1},
                                           {3, 1, 2, 3, 4},
                                           {3, 1, 4, 1},
                                           {4, 5, 6, 7, 9},
                                           {3, 1, 5, 1},
                                           {5, 1, 2, 3, 4, 5, 6, 7, 8}}));
}

void WritersTest::msh_of_elements_alone() {
  const auto line = made(MeshKind::line, {2, 1, 1});
  Cuts cuts(line);
  cuts.cut(0);
  const std::string text = written("a.msh", {*line, cuts, rest_positions(*line), softness_});
  QVERIFY(text.find("$Entities\n0 1 0 0\n1 0 0 0 1 0 0 0 0\n") != text.npos);
  QVERIFY(text.ends_with("$Elements\n0 0 0 0\n$EndElements\n"));
}

/// A sheet that lies at rest and now stands: its faces look along y, not along z.
void WritersTest::stl_has_normals_of_the_deformed_faces() {
  const auto sheet = made(MeshKind::cloth, {2, 2, 1}, 1, 3);
  const std::vector<double> standing{0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  std::istringstream text(written("a.stl", {*sheet, {}, view(*sheet, standing), softness_}));
  int facets = 0;
  for (std::string word; text >> word;) {
    if (word == "normal") {
      Point normal;
      text >> normal.x() >> normal.y() >> normal.z();
      QCOMPARE(normal, Point(0, -1, 0));
      ++facets;
    }
  }
  QCOMPARE(facets, 2);
}

/// Faces and cells with a cut link are left out; their other links are written as lines.
void WritersTest::cut_pieces_are_gone() {
  Cuts cuts(mesh_);
  cuts.cut(*find_link(*mesh_, 4, 5));  // an edge of the tetrahedron and the hexahedron
  const MeshState state{*mesh_, cuts, rest_positions(*mesh_), softness_};
  const auto types = array<std::uint8_t>(written("a.vtu", state), "types");
  QVERIFY(!types.contains(10) && !types.contains(12));
  QVERIFY(types.contains(7) && types.contains(9));
  // Each remaining link occurs once: the pentagon has five, the quadrangle four, and they share one.
  QCOMPARE(types.count(3), qsizetype(mesh_->link_count()) - 1 - 8);
  const auto lines = rows(written("a.msh", state), "$Elements", "$EndElements");
  QCOMPARE(lines[1][3], double(mesh_->link_count() - 1 - 4));
  cuts.cut(*find_link(*mesh_, 0, 3));  // an edge of both faces
  QVERIFY(written("a.ply", {*mesh_, cuts, rest_positions(*mesh_), softness_}).find("element face 0\n") !=
          std::string::npos);
}

void WritersTest::positions_are_told_to_the_bit() {
  const auto positions = pulled(*mesh_);
  const MeshState state{*mesh_, {}, view(*mesh_, positions), softness_};
  const QList<double> expected(positions.begin(), positions.end());
  QCOMPARE(array<double>(written("a.vtu", state), "Points"), expected);
  QList<double> ply, msh;
  for (const auto& row : rows(written("a.ply", state), "end_header", "").mid(0, 10)) {
    ply += row;
  }
  for (const auto& row : rows(written("a.msh", state), "$Nodes", "$EndNodes").mid(2 + 10)) {
    msh += row;
  }
  QCOMPARE(ply, expected);
  QCOMPARE(msh, expected);
}

/// The edges of a face that is not written are lines, even if the writer saw some of them before it met the cut.
void WritersTest::other_edges_of_a_cut_face_are_lines() {
  MeshParts parts;
  for (int i = 0; i < 6; ++i) {
    parts.rest.emplace_back(i / 3 * 5 + (i % 3 == 1 ? 1 : 0), i % 3 == 2 ? 1 : 0, 0);
  }
  parts.triangles = {{0, 1, 2}, {3, 4, 5}};  // far from each other
  add_links_along_edges(parts);
  const auto mesh = build_mesh(std::move(parts));
  for (const auto& [a, b] : {std::array{0, 1}, std::array{1, 2}, std::array{0, 2}}) {
    Cuts cuts(mesh);
    cuts.cut(*find_link(*mesh, ElementId(a), ElementId(b)));
    const MeshPieces pieces(*mesh, cuts, {}, {});
    QCOMPARE(pieces.count(Piece::triangle), 1U);
    QCOMPARE(pieces.count(Piece::line), 2U);
  }
}

void WritersTest::a_full_disk_is_told_data() {
  QTest::addColumn<const MeshFormat*>("format");
  for (const MeshFormat& format : mesh_formats()) {
    if (format.writes()) {
      QTest::newRow(format.endings.data()) << &format;
    }
  }
}

void WritersTest::a_full_disk_is_told() {
  QFETCH(const MeshFormat*, format);
  if (!fs::exists("/dev/full")) {
    QSKIP("there is no device that is full");
  }
  const auto grid = made(format->holds == MeshFormat::Holds::faces ? MeshKind::cloth : MeshKind::grid,
                         {60, 50, 1});  // more than one block of text
  const auto error = error_of([&] {
    write_file("/dev/full", [&](std::ostream& out) {
      write_mesh(out, *format, {*grid, {}, rest_positions(*grid), softness_});
    });
  });
  QVERIFY2(error.contains("it cannot be written to its end"), qPrintable(error));
}

CHAINMAIL_TEST(WritersTest)

}  // namespace chainmail::test_writers

#include "test_writers.moc"
