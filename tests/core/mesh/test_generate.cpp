#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <limits>

#include "core/support.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_generate {

using namespace chainmail::test;

/// Checks the numbers of elements, links, triangles and tetrahedra of generated meshes, counted by hand.
class GenerateTest : public QObject {
  Q_OBJECT

 private slots:
  void counts_data();
  void counts();
  void elements_are_numbered_along_x_then_y_then_z();
  void grid_links_run_along_the_axes_alone();
  void cloth_covers_the_plane_once();
  void tetra_fills_the_block_once();
  void every_edge_is_a_link();
  void sizes_beyond_the_kinds_own_are_ignored();
  void bad_recipes_are_refused_data();
  void bad_recipes_are_refused();
  void too_many_elements_are_refused_before_memory_is_taken();
};

void GenerateTest::counts_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<unsigned>("elements");
  QTest::addColumn<unsigned>("links");
  QTest::addColumn<unsigned>("triangles");
  QTest::addColumn<unsigned>("tetrahedra");
  const auto row = [](const char* name, MeshKind kind, unsigned elements, unsigned links, unsigned triangles,
                      unsigned tetrahedra) {
    QTest::newRow(name) << static_cast<int>(kind) << elements << links << triangles << tetrahedra;
  };
  // Size 5x4x3. Each layer has 4·4 and 5·3 links along x and y. Each of the 12 squares has one diagonal.
  row("line", MeshKind::line, 5, 4, 0, 0);
  row("grid", MeshKind::grid, 20, 16 + 15, 0, 0);
  row("cloth", MeshKind::cloth, 20, 16 + 15 + 12, 2 * 12, 0);
  row("block", MeshKind::block, 60, 3 * (16 + 15) + 2 * 20, 0, 0);
  // Face diagonals: 12 per xy layer (3), 4·2 per xz layer (4), 3·2 per yz layer (5). Body diagonals: 4·3·2.
  row("tetra", MeshKind::tetra, 60, 3 * (16 + 15) + 2 * 20 + 3 * 12 + 4 * 8 + 5 * 6 + 24, 0, 6 * 24);
}

void GenerateTest::counts() {
  QFETCH(int, kind);
  const auto mesh = make_mesh(static_cast<MeshKind>(kind), {5, 4, 3});
  QTEST(mesh->element_count(), "elements");
  QTEST(mesh->link_count(), "links");
  QTEST(static_cast<unsigned>(mesh->triangles.size()), "triangles");
  QTEST(static_cast<unsigned>(mesh->tetrahedra.size()), "tetrahedra");
}

void GenerateTest::elements_are_numbered_along_x_then_y_then_z() {
  const auto mesh = make_mesh(MeshKind::block, {4, 3, 2}, {}, 0.5);
  QVERIFY(mesh->rest_position(0) == Point(0, 0, 0));
  QVERIFY(mesh->rest_position(1) == Point(0.5, 0, 0));
  QVERIFY(mesh->rest_position(4) == Point(0, 0.5, 0));
  QVERIFY(mesh->rest_position(12) == Point(0, 0, 0.5));
  QVERIFY(mesh->rest_position(23) == Point(1.5, 1, 0.5));
}

void GenerateTest::grid_links_run_along_the_axes_alone() {
  for (const MeshKind kind : {MeshKind::line, MeshKind::grid, MeshKind::block}) {
    const auto mesh = make_mesh(kind, {4, 3, 3}, {}, 2);
    for (const auto& [a, b] : mesh->links) {
      const Point along = mesh->rest_position(b) - mesh->rest_position(a);
      QVERIFY(along == Point(2, 0, 0) || along == Point(0, 2, 0) || along == Point(0, 0, 2));
    }
  }
}

void GenerateTest::cloth_covers_the_plane_once() {
  const auto mesh = make_mesh(MeshKind::cloth, {5, 4, 1}, {}, 3);
  double area = 0;
  for (const auto& [a, b, c] : mesh->triangles) {
    const Point ab = mesh->rest_position(b) - mesh->rest_position(a);
    const Point ac = mesh->rest_position(c) - mesh->rest_position(a);
    QVERIFY(ab.cross(ac)[2] > 0);  // all face the same direction
    area += ab.cross(ac)[2] / 2;
  }
  QCOMPARE(area, 4.0 * 3.0 * 9.0);
}

void GenerateTest::tetra_fills_the_block_once() {
  const auto mesh = make_mesh(MeshKind::tetra, {4, 3, 3}, {}, 2);
  double volume = 0;
  for (const auto& [a, b, c, d] : mesh->tetrahedra) {
    const Point from = mesh->rest_position(a);
    const double six =
        (mesh->rest_position(b) - from).cross(mesh->rest_position(c) - from).dot(mesh->rest_position(d) - from);
    QCOMPARE(six, 8.0);  // right-handed, each a sixth of a cube
    volume += six / 6;
  }
  QCOMPARE(volume, 3.0 * 2.0 * 2.0 * 8.0);
}

void GenerateTest::every_edge_is_a_link() {
  const auto cloth = make_mesh(MeshKind::cloth, {4, 4, 1});
  for (const auto& [a, b, c] : cloth->triangles) {
    QVERIFY(find_link(*cloth, a, b) && find_link(*cloth, b, c) && find_link(*cloth, c, a));
  }
  const auto tetra = make_mesh(MeshKind::tetra, {3, 3, 3});
  for (const auto& corner : tetra->tetrahedra) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        QVERIFY(find_link(*tetra, corner[i], corner[j]));
      }
    }
  }
}

void GenerateTest::sizes_beyond_the_kinds_own_are_ignored() {
  QCOMPARE(make_mesh(MeshKind::line, {4, 9, 9})->element_count(), 4u);
  QCOMPARE(make_mesh(MeshKind::grid, {4, 3, 0})->element_count(), 12u);
}

void GenerateTest::bad_recipes_are_refused_data() {
  QTest::addColumn<unsigned>("width");
  QTest::addColumn<double>("spacing");
  QTest::newRow("no elements") << 0u << 1.0;
  QTest::newRow("no spacing") << 4u << 0.0;
  QTest::newRow("negative spacing") << 4u << -1.0;
  QTest::newRow("infinite spacing") << 4u << std::numeric_limits<double>::infinity();
  QTest::newRow("spacing is NaN") << 4u << std::numeric_limits<double>::quiet_NaN();
  QTest::newRow("infinite object") << 4u << std::numeric_limits<double>::max();
}

void GenerateTest::bad_recipes_are_refused() {
  QFETCH(unsigned, width);
  QFETCH(double, spacing);
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::grid, {width, 3, 1}, {}, spacing), Error);
}

void GenerateTest::too_many_elements_are_refused_before_memory_is_taken() {
  const auto most = std::numeric_limits<std::uint32_t>::max();
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::line, {20'000'001, 1, 1}), Error);
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::tetra, {most, most, most}), Error);
}

CHAINMAIL_TEST(GenerateTest)

}  // namespace chainmail::test_generate

#include "test_generate.moc"
