#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <random>

#include "files/mesh/fill.h"
#include "files/repair/defects.h"
#include "files/repair/simplify.h"
#include "files/support.h"
#include "folders.h"
#include "mesh/cells.h"
#include "program.h"

namespace chainmail::test_simplify {

using namespace chainmail::test;

namespace {

MeshPointer sample(const char* name) {
  return open_mesh(sourceFile(("meshes/" + std::string(name)).c_str()).toStdString()).mesh;
}

/// Returns the volume inside closed faces; below 0 if they look inward.
double volume_in(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.rest_position(a).dot(mesh.rest_position(b).cross(mesh.rest_position(c))) / 6;
  }
  return sum;
}

bool has_element_at(const Mesh& mesh, const Point& position) {
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (mesh.rest_position(e) == position) {
      return true;
    }
  }
  return false;
}

/// Returns a cloth of 9 x 9 in which a third triangle meets the edge between the elements 40 and 41.
MeshPointer cloth_with_fin() { return obj(obj_text(*made(MeshKind::cloth, {9, 9, 1})) + "v 4.5 4.5 2\nf 41 42 82\n"); }

}  // namespace

/// A surface gets fewer elements: its shape, its borders and its connections stay.
class SimplifyTest : public QObject {
  Q_OBJECT

 private slots:
  void a_closed_surface_stays_closed();
  void a_border_stays_where_it_is();
  void a_fin_stays_joined();
  void a_plane_object_stays_plane();
  void the_result_is_always_the_same();
  void what_cannot_be_simplified_is_refused_data();
  void what_cannot_be_simplified_is_refused();
  void random_triangles_are_simplified_or_refused();
  void it_can_be_cancelled();
};

/// The torus has 384 elements. A tenth of them changes its volume by less than a tenth.
void SimplifyTest::a_closed_surface_stays_closed() {
  const auto torus = sample("torus.obj");
  const auto coarse = simplify(*torus, 38);
  QCOMPARE(coarse->element_count(), 38U);
  QCOMPARE(coarse->triangles.size(), std::size_t{76});  // twice the elements: still a torus
  QCOMPARE(coarse->links.size(), std::size_t{114});
  QVERIFY(find_defects(*coarse).empty());
  const double ratio = volume_in(*coarse) / volume_in(*torus);
  QVERIFY2(std::abs(ratio - 1) < 0.1, qPrintable(QString::number(ratio)));
  QVERIFY(fill(*coarse, coarse->mean_link_length)->has_cells());
}

void SimplifyTest::a_border_stays_where_it_is() {
  const auto cloth = made(MeshKind::cloth, {9, 9, 1});
  const auto coarse = simplify(*cloth, 40);
  QCOMPARE(coarse->element_count(), 40U);
  for (ElementId e = 0; e < cloth->element_count(); ++e) {
    const Point at = cloth->rest_position(e);
    const bool is_border = at.x() == 0 || at.x() == 8 || at.y() == 0 || at.y() == 8;
    QVERIFY(!is_border || has_element_at(*coarse, at));
  }
  QCOMPARE(find_defects(*coarse).outlines, std::size_t{1});
}

/// CGAL needs at most two faces at an edge: the fin is taken off, and joined again.
void SimplifyTest::a_fin_stays_joined() {
  const auto surface = cloth_with_fin();
  const auto coarse = simplify(*surface, 50);
  QCOMPARE(coarse->element_count(), 50U);
  QCOMPARE(coarse->part_count, 1U);
  QCOMPARE(find_defects(*coarse).non_manifold.size(), std::size_t{1});
  for (const ElementId e : {40U, 41U, 81U}) {
    QVERIFY(has_element_at(*coarse, surface->rest_position(e)));
  }
}

void SimplifyTest::a_plane_object_stays_plane() {
  const auto coarse = simplify(*made(MeshKind::cloth, {9, 9, 1}), 45);
  QCOMPARE(coarse->space_dimension, 2);
  double area = 0;
  for (const auto& [a, b, c] : coarse->triangles) {
    const Point u = coarse->rest_position(b) - coarse->rest_position(a);
    const double one = u.cross(coarse->rest_position(c) - coarse->rest_position(a)).z() / 2;
    QVERIFY(one > 0);  // no triangle is flat or folded
    area += one;
  }
  QVERIFY(std::abs(area - 64) < 1e-9);  // rounding of sums of some dozen doubles
}

void SimplifyTest::the_result_is_always_the_same() {
  const auto sphere = sample("sphere.obj");
  const auto one = simplify(*sphere, 57), other = simplify(*sphere, 57);
  QVERIFY(one->rest == other->rest);
  QVERIFY(one->triangles == other->triangles);
}

void SimplifyTest::what_cannot_be_simplified_is_refused_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::addColumn<int>("elements");
  QTest::addColumn<QString>("sentence");
  const auto cloth = made(MeshKind::cloth, {9, 9, 1});
  QTest::newRow("volume") << made(MeshKind::tetra, {3, 3, 3}) << 9
                          << "surface: the object has cells, and only surfaces are simplified; ";
  QTest::newRow("links only") << made(MeshKind::grid, {5, 5, 1}) << 9 << "surface: it has no faces; use a surface";
  QTest::newRow("too few") << cloth << 3 << "elements: 3 are too few for a surface; choose 4 or more";
  QTest::newRow("not fewer") << cloth << 81 << "elements: the surface has 81, so 81 are not fewer; choose at most 80";
  QTest::newRow("border") << cloth << 32
                          << "surface: the 32 elements at its borders and non-manifold edges stay, so it cannot have "
                             "32; choose 33 or more";
  QTest::newRow("loose") << obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 5 5 0\nf 1 2 3\nf 2 4 3\nl 4 5\n") << 4
                         << "surface: its element 4 belongs to no face; remove loose points (Object > Repair, or "
                            "chainmail repair), and links without faces";
  QTest::newRow("torus") << sample("torus.obj") << 4 << "surface: with fewer than ";
}

void SimplifyTest::what_cannot_be_simplified_is_refused() {
  QFETCH(MeshPointer, mesh);
  QFETCH(int, elements);
  QFETCH(QString, sentence);
  const QString error = error_of([&] { simplify(*mesh, std::uint64_t(elements)); });
  QVERIFY2(error.startsWith(sentence), qPrintable(error));
}

/// Spheres whose elements are moved at random, so that they intersect themselves, with triangles between any elements.
void SimplifyTest::random_triangles_are_simplified_or_refused() {
  const auto sphere = sample("sphere.obj");
  std::mt19937 random(5);
  int simplified = 0;
  for (int round = 0; round < 12; ++round) {
    MeshParts parts;
    for (ElementId e = 0; e < sphere->element_count(); ++e) {
      parts.rest.push_back(sphere->rest_position(e) + Point(random() % 3, random() % 3, random() % 3));
    }
    parts.triangles = sphere->triangles;
    for (int fin = 0; fin < round; ++fin) {
      const ElementId a = random() % 100;
      parts.triangles.push_back({a, ElementId(a + 1 + random() % 40), ElementId(a + 42 + random() % 40)});
    }
    add_links_along_edges(parts);
    const auto mesh = build_mesh(parts);
    const QString sentence = error_of([&] {
      QCOMPARE(simplify(*mesh, 150)->element_count(), 150U);
      ++simplified;
    });
    QVERIFY2(sentence.isEmpty() || sentence.startsWith("surface: the ") || sentence.startsWith("surface: with fewer"),
             qPrintable(sentence));
  }
  QVERIFY2(simplified >= 6, qPrintable(QString::number(simplified)));
}

void SimplifyTest::it_can_be_cancelled() {
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_THROWS_EXCEPTION(Cancelled, simplify(*sample("torus.obj"), 100, job));
}

CHAINMAIL_TEST(SimplifyTest)

}  // namespace chainmail::test_simplify

#include "test_simplify.moc"
