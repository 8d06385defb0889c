#include <Eigen/Geometry>
#include <QtTest>
#include <set>

#include "core/hexahedra.h"
#include "core/support.h"
#include "mesh/section.h"
#include "program.h"

namespace chainmail::test_section {

using namespace chainmail::test;

namespace {

// A share is a float: a position on a link of length 1 is wrong by at most 2^-25, an area of 6 by a few of these.
constexpr double rounding = 1e-6;

struct Block {
  const char* name;
  MeshPointer mesh;  // from 0 to 3, 2 and 2
};
std::vector<Block> blocks() {
  return {{"tetrahedra", make_mesh(MeshKind::tetra, {4, 3, 3})}, {"hexahedra", hexahedral_block({3, 2, 2})}};
}
constexpr std::array<double, 3> area_across{4, 6, 6};

CellTablePointer table_of(const MeshPointer& mesh) { return std::make_shared<CellTable>(mesh); }

Point position_at(const Mesh& mesh, const SectionPoint& point) {
  const Point from = mesh.rest_position(point.from);
  return from + double(point.share) * (mesh.rest_position(point.to) - from);
}

double area(const Section& section, const Surface& surface) {
  const Mesh& mesh = *section.table().mesh();
  const auto corners = section.triangles(surface);
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Point a = position_at(mesh, section.points()[corners[i]]),
                b = position_at(mesh, section.points()[corners[i + 1]]),
                c = position_at(mesh, section.points()[corners[i + 2]]);
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

double area(const MeshPointer& mesh, const SectionPlane& plane) {
  const auto table = table_of(mesh);
  return area(Section(table, plane), Surface(table));
}

}  // namespace

/// The face that a plane cuts through a volume at rest.
class SectionTest : public QObject {
  Q_OBJECT

 private slots:
  void its_area_is_the_cross_sections();
  void its_points_lie_in_the_plane_each_once();
  void where_nothing_is_taken_away_there_is_none();
  void cells_that_are_cut_leave_holes();
};

void SectionTest::its_area_is_the_cross_sections() {
  for (const auto& [name, mesh] : blocks()) {
    for (int axis = 0; axis < 3; ++axis) {
      // Through cells, and exactly through elements. In the second case the section consists of faces on one side.
      for (const double at : {0.25, 0.5, 1.0, 1.75, 1.999}) {
        for (const bool flipped : {false, true}) {
          const double found = area(mesh, {axis, at, flipped});
          QVERIFY2(std::abs(found - area_across[axis]) < rounding,
                   qPrintable(QStringLiteral("%1: axis %2 at %3: %4").arg(name).arg(axis).arg(at).arg(found)));
        }
      }
    }
  }
}

void SectionTest::its_points_lie_in_the_plane_each_once() {
  for (const auto& [name, mesh] : blocks()) {
    const Section section(table_of(mesh), {1, 0.3, false});
    std::set<std::pair<ElementId, ElementId>> seen;
    for (const SectionPoint& point : section.points()) {
      QVERIFY(std::abs(position_at(*mesh, point).y() - 0.3) < rounding);
      QVERIFY(point.share >= 0 && point.share <= 1 && point.from < point.to);
      QVERIFY(seen.insert({point.from, point.to}).second);
    }
  }
}

void SectionTest::where_nothing_is_taken_away_there_is_none() {
  for (const auto& [name, mesh] : blocks()) {
    QCOMPARE(area(mesh, {0, 3, false}), 0.0);
    QCOMPARE(area(mesh, {0, 0, true}), 0.0);
    QCOMPARE(area(mesh, {0, -1, false}), 0.0);                                 // nor where all is
    QVERIFY(std::abs(area(mesh, {0, 0, false}) - area_across[0]) < rounding);  // its low end stays visible
    QVERIFY(std::abs(area(mesh, {0, 3, true}) - area_across[0]) < rounding);
  }
  QCOMPARE(area(make_mesh(MeshKind::cloth, {4, 4, 1}, 3), {0, 1.5, false}), 0.0);  // it has no cells
}

void SectionTest::cells_that_are_cut_leave_holes() {
  const auto mesh = hexahedral_block({3, 2, 2});
  const auto table = table_of(mesh);
  const Section section(table, {0, 1.5, false});
  Surface surface(table);
  const LinkId link = *find_link(*mesh, 1, 2);  // an edge of only one of the crossed cells
  surface.cut(link);
  QVERIFY(std::abs(area(section, surface) - (area_across[0] - 1)) < rounding);
  surface.cut(*find_link(*mesh, 0, 1));  // of no crossed cell
  QVERIFY(std::abs(area(section, surface) - (area_across[0] - 1)) < rounding);
  surface.uncut(link);
  QVERIFY(std::abs(area(section, surface) - area_across[0]) < rounding);
}

CHAINMAIL_TEST(SectionTest)

}  // namespace chainmail::test_section

#include "test_section.moc"
