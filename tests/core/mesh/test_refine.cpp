#include <Eigen/Geometry>
#include <Eigen/LU>
#include <QtTest>
#include <map>

#include "core/elastic/elastic_problems.h"
#include "elastic/simplices.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/refine.h"
#include "program.h"

namespace chainmail::test_refine {

using namespace chainmail::test;

/// Uniform refinement of triangles, tetrahedra and chains.
class RefineTest : public QObject {
  Q_OBJECT

 private slots:
  void old_elements_keep_their_ids();
  void the_volume_is_kept();
  void cells_conform();
  void repeated_refinement_keeps_the_quality();
  void linear_fields_are_interpolated_exactly();
  void hexahedra_are_refused();
};

namespace {

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const double one : build_simplices(mesh, Cuts(std::make_shared<const Mesh>(mesh))).volumes) {
    sum += one;
  }
  return sum;
}

/// Returns the area of triangles in the plane; those that are clockwise count as negative.
double facing(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point from = mesh.rest_position(a);
    sum += (mesh.rest_position(b) - from).cross(mesh.rest_position(c) - from).z() / 2;
  }
  return sum;
}

/// Returns the edges from the first corner of a cell, as columns.
Eigen::Matrix3d edges_of(const Mesh& mesh, const std::array<ElementId, 4>& cell) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) {
    edges.col(i) = mesh.rest_position(cell[std::size_t(i) + 1]) - mesh.rest_position(cell[0]);
  }
  return edges;
}

/// The least ratio of volume to the cube of the longest edge, and the number of different ratios.
std::pair<double, std::size_t> quality_of(const Mesh& mesh) {
  double least = 1;
  std::map<long, int> different;
  for (const auto& cell : mesh.tetrahedra) {
    double longest = 0;
    for (const auto& [a, b] : tetrahedron_edges) {
      const Point edge = mesh.rest_position(cell[std::size_t(a)]) - mesh.rest_position(cell[std::size_t(b)]);
      longest = std::max(longest, edge.norm());
    }
    const double ratio = std::abs(edges_of(mesh, cell).determinant()) / 6 / (longest * longest * longest);
    least = std::min(least, ratio);
    ++different[std::lround(1e9 * ratio)];
  }
  return {least, different.size()};
}

const std::array<MeshPointer, 3>& objects() {
  static const std::array<MeshPointer, 3> all{make_mesh(MeshKind::line, {5, 1, 1}),
                                              jittered(make_mesh(MeshKind::cloth, {5, 4, 1})),
                                              jittered(make_mesh(MeshKind::tetra, {4, 3, 3}))};
  return all;
}

}  // namespace

void RefineTest::old_elements_keep_their_ids() {
  for (const MeshPointer& mesh : objects()) {
    const Refinement finer = refine(*mesh);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      QCOMPARE(finer.mesh->rest_position(e), mesh->rest_position(e));
    }
    // One new element for each edge, and 2, 4 or 8 parts for each cell.
    QCOMPARE(finer.mesh->element_count(), mesh->element_count() + ElementId(mesh->link_count()));
    QCOMPARE(finer.parents.size(), std::size_t(mesh->link_count()));
    QCOMPARE(finer.mesh->tetrahedra.size(), 8 * mesh->tetrahedra.size());
    if (mesh->space_dimension == 2) {
      QCOMPARE(finer.mesh->triangles.size(), 4 * mesh->triangles.size());
    }
    QCOMPARE(finer.mesh->space_dimension, mesh->space_dimension);
    QCOMPARE(finer.mesh->object_dimension, mesh->object_dimension);
  }
}

void RefineTest::the_volume_is_kept() {
  for (const MeshPointer& mesh : objects()) {
    const Refinement finer = refine(*mesh), finest = refine(*finer.mesh);
    QVERIFY(std::abs(volume_of(*finest.mesh) / volume_of(*mesh) - 1) < 1e-12);
    QVERIFY(std::abs(facing(*finest.mesh) - facing(*mesh)) < 1e-12);
    for (std::size_t i = 0; i < finer.mesh->tetrahedra.size(); ++i) {  // no cell is inverted
      const double part = edges_of(*finer.mesh, finer.mesh->tetrahedra[i]).determinant();
      QVERIFY(std::abs(8 * part / edges_of(*mesh, mesh->tetrahedra[i / 8]).determinant() - 1) < 1e-9);
    }
  }
}

/// Each inner side belongs to two cells, so the outer sides are those of the coarse mesh, in four parts each.
void RefineTest::cells_conform() {
  const auto outer = [](const MeshPointer& mesh) {
    const CellTable table(mesh);
    std::size_t count = 0;
    for (SideId side = 0; side < table.side_count(); ++side) {
      count += table.twin(side) == CellTable::none ? 1 : 0;
    }
    return count;
  };
  const MeshPointer mesh = objects()[2];
  QVERIFY(outer(mesh) > 0);
  QCOMPARE(outer(refine(*mesh).mesh), 4 * outer(mesh));
}

/// Bey (1995): at most three shapes per tetrahedron, however often it is refined.
void RefineTest::repeated_refinement_keeps_the_quality() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1.1, 0.1, 0}, {0.3, 0.9, 0.2}, {0.1, 0.4, 1.2}};
  parts.tetrahedra = {{0, 1, 2, 3}};
  add_links_along_edges(parts);
  MeshPointer mesh = build_mesh(std::move(parts));
  const double before = quality_of(*mesh).first;
  double least = before;
  for (int level = 1; level <= 5; ++level) {
    mesh = refine(*mesh).mesh;
    const auto [quality, shapes] = quality_of(*mesh);
    QVERIFY(shapes <= 3);
    if (level > 1) {
      QVERIFY(quality > 0.999 * least);  // all shapes exist after the first or second level
    }
    least = std::min(least, quality);
  }
  QVERIFY(least > before / 4);
}

void RefineTest::linear_fields_are_interpolated_exactly() {
  for (const MeshPointer& mesh : objects()) {
    const Refinement finer = refine(*mesh);
    const std::vector<double> rest = interpolated(finer, mesh->rest, mesh->space_dimension);
    QCOMPARE(rest.size(), finer.mesh->rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
      QVERIFY(std::abs(rest[i] - finer.mesh->rest[i]) < 1e-14);
    }
  }
}

void RefineTest::hexahedra_are_refused() {
  MeshParts parts;
  for (int i = 0; i < 8; ++i) {
    parts.rest.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  }
  parts.hexahedra = {{0, 1, 3, 2, 4, 5, 7, 6}};
  add_links_along_edges(parts);
  const MeshPointer mesh = build_mesh(std::move(parts));
  QVERIFY_THROWS_EXCEPTION(Error, refine(*mesh));
}

CHAINMAIL_TEST(RefineTest)

}  // namespace chainmail::test_refine

#include "test_refine.moc"
