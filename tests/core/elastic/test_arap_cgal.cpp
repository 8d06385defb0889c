#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <QtTest>

#include "core/elastic/elastic_problems.h"

using namespace chainmail;
using namespace chainmail::test;

/// Compares ARAP with the implementation in CGAL (Surface_mesh_deformation, ORIGINAL_ARAP), both iterated until they
/// converge.
class ArapCgalTest : public QObject {
  Q_OBJECT

 private slots:
  void a_surface_is_that_of_cgal_data();
  void a_surface_is_that_of_cgal();
};

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = CgalMesh::Vertex_index;

/// Half the sum of the two cotangents opposite an edge, where each counts as 0 if it is negative: CGAL 5's weights of
/// the original method. Those of CGAL 6 differ.
struct ClampedCotangents {
  template <class Positions>
  double operator()(CgalMesh::Halfedge_index edge, const CgalMesh& mesh, const Positions& at) const {
    double sum = 0;
    for (const auto side : {edge, mesh.opposite(edge)}) {
      if (!mesh.is_border(side)) {
        const auto apex = get(at, mesh.target(mesh.next(side)));
        const auto u = get(at, mesh.source(side)) - apex, v = get(at, mesh.target(side)) - apex;
        sum += std::max(0.0, u * v / std::sqrt(CGAL::cross_product(u, v).squared_length()));
      }
    }
    return sum / 2;
  }
};

using Deformation =
    CGAL::Surface_mesh_deformation<CgalMesh, CGAL::Default, CGAL::Default, CGAL::ORIGINAL_ARAP, ClampedCotangents>;

/// A curved sheet of triangles, some of which are obtuse.
MeshPointer curved_sheet() {
  const MeshPointer flat = jittered(make_mesh(MeshKind::cloth, {6, 5, 1}, 3), 0.35);
  MeshParts parts;
  for (ElementId e = 0; e < flat->element_count(); ++e) {
    Point at = flat->rest_position(e);
    at.x() *= 1.6;  // more angles above 90 degrees
    at.z() = 0.4 * std::sin(at.x()) + 0.1 * at.y() * at.y();
    parts.rest.push_back(at);
  }
  parts.links = flat->links;
  parts.triangles = flat->triangles;
  parts.space_dimension = 3;
  return build_mesh(std::move(parts));
}

std::vector<double> by_cgal(const Mesh& mesh, const std::vector<ElementId>& pins, ElementId handle, const Point& by) {
  CgalMesh surface;
  std::vector<Vertex> vertices;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point at = mesh.rest_position(e);
    vertices.push_back(surface.add_vertex({at.x(), at.y(), at.z()}));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    surface.add_face(vertices[a], vertices[b], vertices[c]);
  }
  Deformation deformation(surface);
  deformation.insert_roi_vertices(vertices.begin(), vertices.end());
  for (const ElementId pin : pins) {
    deformation.insert_control_vertex(vertices[pin]);
  }
  deformation.insert_control_vertex(vertices[handle]);
  deformation.preprocess();
  const Point to = mesh.rest_position(handle) + by;
  deformation.set_target_position(vertices[handle], {to.x(), to.y(), to.z()});
  deformation.deform(20'000, 0);
  std::vector<double> displacements;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    for (int k = 0; k < 3; ++k) {
      displacements.push_back(surface.point(vertices[e])[k] - mesh.rest_position(e)[k]);
    }
  }
  return displacements;
}

}  // namespace

void ArapCgalTest::a_surface_is_that_of_cgal_data() {
  QTest::addColumn<Point>("by");
  QTest::newRow("lifted") << Point(-0.5, 0.2, 1.5);
  QTest::newRow("bent over") << Point(-6, 0, 3);
  QTest::newRow("stretched") << Point(2, 1, 0);
}

void ArapCgalTest::a_surface_is_that_of_cgal() {
  QFETCH(const Point, by);
  const MeshPointer mesh = curved_sheet();
  const std::vector<ElementId> pins = layer(*mesh, *find_side("left"));
  const ElementId handle = mesh->element_count() - 1;
  const auto solver = make_elastic(Algorithm::arap, pinned(mesh, pins));
  solver->hold(ElasticHandle::of(handle));
  solver->move(ElasticMotion::by(std::span(by.data(), 3)));
  QVERIFY2(solver->remark().empty(), solver->remark().c_str());
  const double apart = largest_step(solver->displacements(), by_cgal(*mesh, pins, handle, by));
  QVERIFY2(apart < 1e-6, qPrintable(QString::number(apart)));
}

QTEST_APPLESS_MAIN(ArapCgalTest)
#include "test_arap_cgal.moc"
