// Files as other programs write them: what tests/files/world/table.csv says of each one.

#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "files/mesh/mesh_formats.h"
#include "files/mesh/open_mesh.h"
#include "files/repair/defects.h"
#include "files/support.h"
#include "files/volume_of.h"
#include "folders.h"
#include "program.h"
#include "simulate/simulation.h"

namespace chainmail::test_world {

using namespace chainmail::test;

namespace fs = std::filesystem;

namespace {

/// A row of the table.
struct WorldFile {
  QString name;
  std::array<unsigned, 5> counts{};  // elements, links, triangles, tetrahedra, hexahedra
  std::array<Point, 2> bounds{Point::Zero(), Point::Zero()};
  double measure = 0;  // area without cells, else volume
  QString words;       // of the note or of the refusal
  bool is_refused = false;
};

Point point_in(const QString& text) {
  const QStringList numbers = text.split(QLatin1Char(' '));
  return {numbers.at(0).toDouble(), numbers.at(1).toDouble(), numbers.at(2).toDouble()};
}

std::vector<WorldFile> table() {
  std::vector<WorldFile> files;
  const QStringList lines = QString::fromStdString(file_text(source_file("tests/files/world/table.csv"))).split('\n');
  for (const QString& line : lines.mid(1)) {
    const QStringList fields = line.split(QLatin1Char(';'));
    if (fields.size() < 10) {
      continue;
    }
    WorldFile file;
    file.name = fields.at(0);
    file.words = QStringList(fields.mid(9)).join(QLatin1Char(';'));
    file.is_refused = fields.at(1).isEmpty();
    if (!file.is_refused) {
      for (std::size_t i = 0; i < file.counts.size(); ++i) {
        file.counts[i] = fields.at(qsizetype(i) + 1).toUInt();
      }
      file.bounds = {point_in(fields.at(6)), point_in(fields.at(7))};
      file.measure = fields.at(8).toDouble();
    }
    files.push_back(file);
  }
  return files;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point at = mesh.rest_position(a);
    area += (mesh.rest_position(b) - at).cross(mesh.rest_position(c) - at).norm() / 2;
  }
  return area;
}

/// Volume that closed faces enclose, with a sign; each counts as seen from the origin.
double enclosed_by(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.rest_position(a).cross(mesh.rest_position(b)).dot(mesh.rest_position(c)) / 6;
  }
  return volume;
}

double measure_of(const Mesh& mesh) { return mesh.has_cells() ? volume_of(mesh) : area_of(mesh); }

bool is_close(double a, double b, double tolerance = 1e-12) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}
bool is_close(const Point& a, const Point& b) { return (a - b).cwiseAbs().maxCoeff() <= 1e-12 * b.norm(); }

fs::path world(const QString& name) { return source_file("tests/files/world") / name.toStdString(); }

std::array<unsigned, 5> counts_of(const Mesh& mesh) {
  return {unsigned(mesh.element_count()), unsigned(mesh.link_count()), unsigned(mesh.triangles.size()),
          unsigned(mesh.tetrahedra.size()), unsigned(mesh.hexahedra.size())};
}

}  // namespace

class WorldTest : public QObject {
  Q_OBJECT

 private slots:
  void every_file_is_in_the_table();
  void files_data();
  void files();
  void they_come_back_data();
  void they_come_back();
  void they_deform_data() { opened(); }
  void they_deform();
  void divided_cells_share_their_sides_data();
  void divided_cells_share_their_sides();
  void strips_face_one_way();
  void mirrored_cells_are_positive();

 private:
  /// Makes a row of data for each file that opens.
  static void opened();
};

void WorldTest::every_file_is_in_the_table() {
  QStringList named{"README.md", "table.csv", "behind_header.raw", "behind_100_bytes.raw",
                    "s001.raw",  "s002.raw",  "s003.raw",          "s004.raw"};
  for (const WorldFile& file : table()) {
    named << file.name;
  }
  for (const auto& entry : fs::directory_iterator(source_file("tests/files/world"))) {
    const QString name = QString::fromStdString(entry.path().filename().string());
    QVERIFY2(named.contains(name), qPrintable(name));
  }
  QVERIFY(named.size() > 70);
}

void WorldTest::files_data() {
  QTest::addColumn<WorldFile>("file");
  for (const WorldFile& file : table()) {
    QTest::newRow(qPrintable(file.name)) << file;
  }
}

void WorldTest::files() {
  QFETCH(WorldFile, file);
  if (file.is_refused) {
    const QString error = error_of([&] { open_mesh(world(file.name)); });
    QVERIFY2(error.contains(file.words), qPrintable(error));
    QVERIFY2(error.contains(file.name) && !error.contains('\n'), qPrintable(error));
    return;
  }
  const OpenedMesh opened = open_mesh(world(file.name));
  QCOMPARE(counts_of(*opened.mesh), file.counts);
  QVERIFY(is_close(opened.mesh->box[0], file.bounds[0]) && is_close(opened.mesh->box[1], file.bounds[1]));
  QVERIFY2(is_close(measure_of(*opened.mesh), file.measure),
           qPrintable(QString::number(measure_of(*opened.mesh), 'g', 17)));
  const QString note = QString::fromStdString(in_words(opened.flaws));
  QVERIFY2(file.words.isEmpty() ? note.isEmpty() : note.contains(file.words), qPrintable(note));
}

void WorldTest::opened() {
  QTest::addColumn<WorldFile>("file");
  for (const WorldFile& file : table()) {
    if (!file.is_refused) {
      QTest::newRow(qPrintable(file.name)) << file;
    }
  }
}

/// One file of each object.
void WorldTest::they_come_back_data() {
  QTest::addColumn<WorldFile>("file");
  std::set<std::pair<std::array<unsigned, 5>, double>> seen;
  for (const WorldFile& file : table()) {
    if (!file.is_refused && seen.insert({file.counts, file.measure}).second) {
      QTest::newRow(qPrintable(file.name)) << file;
    }
  }
}

/// Written in each format that is also read, and read again. A format without cells gets their outer faces.
void WorldTest::they_come_back() {
  QFETCH(WorldFile, file);
  const QTemporaryDir folder;
  const auto mesh = open_mesh(world(file.name)).mesh;
  for (const MeshFormat& format : mesh_formats()) {
    if (!format.reads() || !format.writes() || !format.holds_positions) {
      continue;
    }
    const fs::path path = folder.filePath("again" + QString::fromUtf8(format.endings.data())).toStdString();
    save_mesh(path, {*mesh, {}, rest_positions(*mesh), {}});
    const auto again = open_mesh(path).mesh;
    QVERIFY(is_close(again->box[0], mesh->box[0]) && is_close(again->box[1], mesh->box[1]));
    const bool has_all = format.holds == MeshFormat::Holds::all;
    if (format.holds != MeshFormat::Holds::faces) {
      QCOMPARE(again->rest, mesh->rest);
      QCOMPARE(again->links, mesh->links);
    }
    if (format.name == "Gmsh" && !mesh->polygons.empty()) {
      continue;  // it has the links of large faces
    }
    if (has_all || !mesh->has_cells()) {
      QVERIFY2(is_close(measure_of(*again), measure_of(*mesh)), path.c_str());
    } else if (mesh->triangles.empty()) {  // faces of its own are written beside those of its cells
      // They look outward, also those of cells that are inside out.
      QVERIFY2(is_close(enclosed_by(*again), std::abs(volume_of(*mesh)), 1e-9), path.c_str());
    }
  }
}

void WorldTest::they_deform() {
  QFETCH(WorldFile, file);
  const auto mesh = open_mesh(world(file.name)).mesh;
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
  Point target = mesh->rest_position(0);
  for (int axis = 0; axis < mesh->space_dimension; ++axis) {
    target[mesh->axes[axis]] += 0.3 - 0.1 * axis;
  }
  simulation.apply(commands::Grab{{0}});
  simulation.apply(commands::Drag{target});
  const auto positions = simulation.body().positions();
  QCOMPARE(point_of(*mesh, positions, 0), target);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    QVERIFY(point_of(*mesh, positions, e).allFinite());
  }
}

/// Objects that are as large as their bounding box.
void WorldTest::divided_cells_share_their_sides_data() {
  QTest::addColumn<WorldFile>("file");
  for (const WorldFile& file : table()) {
    if (file.counts[3] > 0 && is_close(file.measure, (file.bounds[1] - file.bounds[0]).prod())) {
      QTest::newRow(qPrintable(file.name)) << file;
    }
  }
}

/// The sides that only one cell has are the surface, so their areas add up to that of the box.
void WorldTest::divided_cells_share_their_sides() {
  QFETCH(WorldFile, file);
  const auto mesh = open_mesh(world(file.name)).mesh;
  std::map<std::array<ElementId, 3>, int> cells_of;
  for (const auto& cell : mesh->tetrahedra) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array side{cell[(left_out + 1) % 4], cell[(left_out + 2) % 4], cell[(left_out + 3) % 4]};
      std::sort(side.begin(), side.end());
      ++cells_of[side];
    }
  }
  double area = 0;
  for (const auto& [side, cells] : cells_of) {
    const Point at = mesh->rest_position(side[0]);
    area += cells > 1 ? 0 : (mesh->rest_position(side[1]) - at).cross(mesh->rest_position(side[2]) - at).norm() / 2;
    QVERIFY(cells <= 2);
  }
  const Point size = file.bounds[1] - file.bounds[0];
  QVERIFY(is_close(area, 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0])));
}

void WorldTest::strips_face_one_way() {
  struct Strip {
    const char* file;
    double volume;  // with the sign that the corners of the first triangle give it
    Point area;     // sum of the areas as vectors
  };
  for (const auto& [file, volume, area] :
       {Strip{"strip.vtk", -1.0 / 6, Point::Zero()}, Strip{"strips.vtp", -1.0 / 6, Point::Zero()},
        Strip{"strips.ply", 0, Point(0, 0, -1.5)}}) {
    const auto mesh = open_mesh(world(file)).mesh;
    Point sum = Point::Zero();
    for (const auto& [a, b, c] : mesh->triangles) {
      const Point at = mesh->rest_position(a);
      sum += (mesh->rest_position(b) - at).cross(mesh->rest_position(c) - at) / 2;
    }
    QVERIFY2(is_close(enclosed_by(*mesh), volume), file);
    QVERIFY2((sum - area).norm() < 1e-12, file);
  }
}

void WorldTest::mirrored_cells_are_positive() {
  for (const char* name : {"mirrored.mha", "swapped_axes.mha", "swapped_axes.nrrd"}) {
    QCOMPARE(open_mesh(world(name)).flaws.inverted, std::uint64_t{0});
  }
}

CHAINMAIL_TEST(WorldTest)

}  // namespace chainmail::test_world

#include "test_world.moc"
