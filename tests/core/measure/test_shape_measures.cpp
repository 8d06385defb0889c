#include <QtTest>
#include <cmath>
#include <random>

#include "core/families.h"
#include "core/hexahedra.h"
#include "measure/hausdorff.h"
#include "measure/shape_measures.h"
#include "program.h"

namespace chainmail::test_shape_measures {

using namespace chainmail::test;

namespace {

/// Positions of a mesh after `place` was applied to each rest position.
class Placed {
 public:
  template <class Place>
  Placed(const Mesh& mesh, Place place) : dimension_(std::size_t(mesh.space_dimension)) {
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      const Point at = place(mesh.rest_position(e));
      for (std::size_t k = 0; k < dimension_; ++k) {
        coordinates_.push_back(at[mesh.axes[k]]);
      }
    }
  }
  operator PositionView() const {
    return {coordinates_.data(), dimension_ * sizeof(double), Precision::double_precision};
  }

 private:
  std::size_t dimension_;
  std::vector<double> coordinates_;
};

Point same(const Point& position) { return position; }
Point stretched(const Point& position) { return {1.3 * position.x(), position.y(), position.z()}; }
Point mirrored(const Point& position) { return {-position.x(), position.y(), position.z()}; }
Point larger(const Point& position) { return 1.2 * position; }

bool near(double one, double other) { return std::abs(one - other) < 1e-9; }

}  // namespace

/// Figures about the shape of a deformed object, against closed forms.
class ShapeMeasuresTest : public QObject {
  Q_OBJECT

 private slots:
  void a_stretched_box();
  void a_mirrored_box_is_inverted();
  void one_cell_that_is_turned_inside_out_counts_once();
  void a_sphere_that_grows();
  void a_stretched_plane();
  void sheared_cells_have_the_stretch_of_the_closed_form();
  void objects_without_cells_have_no_figures();
  void figures_of_cells_are_at_rest_and_now();
  void cells_with_a_cut_link_do_not_count();
  void the_quality_of_tetrahedra_is_that_of_closed_forms();
  void hausdorff_is_from_points_to_triangles();
  void hausdorff_agrees_with_all_pairs();
  void hausdorff_looks_at_each_side_of_a_triangle();
  void hausdorff_agrees_with_a_search_of_all_triangles();
};

void ShapeMeasuresTest::a_stretched_box() {
  const MeshPointer tetrahedra = generate({MeshKind::tetra, {3, 3, 3}, 1, {}});
  for (const MeshPointer& mesh : {tetrahedra, hexahedral_block({2, 2, 2})}) {
    const Placed rest(*mesh, same), now(*mesh, stretched);
    QVERIFY(near(*volume_change(*mesh, rest), 0));
    QVERIFY(near(*volume_of(*mesh, rest), 8));
    QVERIFY(near(*volume_change(*mesh, now), 0.3));
    QVERIFY(near(*largest_principal_stretch(*mesh, rest), 1));
    QVERIFY(near(*largest_principal_stretch(*mesh, now), 1.3));
    QCOMPARE(*inverted_cells(*mesh, now), std::uint64_t{0});
    QVERIFY(near(hausdorff_distance(surface_of(*mesh, rest), surface_of(*mesh, now)), 0.6));
    QVERIFY(near(hausdorff_distance(*mesh, rest, now), 0.6 / mesh->mean_link_length));
    QVERIFY(near(hausdorff_distance(*mesh, now, rest), 0.6 / mesh->mean_link_length));
  }
}

void ShapeMeasuresTest::a_mirrored_box_is_inverted() {
  const MeshPointer tetrahedra = generate({MeshKind::tetra, {3, 3, 3}, 1, {}});
  for (const MeshPointer& mesh : {tetrahedra, hexahedral_block({2, 2, 2})}) {
    const Placed now(*mesh, mirrored);
    QCOMPARE(*inverted_cells(*mesh, now), std::uint64_t(mesh->tetrahedra.size() + mesh->hexahedra.size()));
    QVERIFY(near(*volume_change(*mesh, now), -2));
    QVERIFY(near(*largest_principal_stretch(*mesh, now), 1));
  }
}

void ShapeMeasuresTest::one_cell_that_is_turned_inside_out_counts_once() {
  const MeshPointer bricks_of_8 = hexahedral_block({2, 2, 2});
  // A corner of the box goes through its brick, and further.
  const Placed now(*bricks_of_8, [](const Point& at) { return at == Point(0, 0, 0) ? Point(0.9, 0.9, 0.9) : at; });
  QCOMPARE(*inverted_cells(*bricks_of_8, now), std::uint64_t{1});
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  parts.links = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  parts.tetrahedra = {{0, 2, 1, 3}};  // numbered the other way round: that is no inversion
  const MeshPointer mesh = build_mesh(std::move(parts));
  const auto tip_at = [&](double height) {
    return Placed(*mesh, [=](const Point& at) { return at.z() == 1 ? Point(0, 0, height) : at; });
  };
  QCOMPARE(*inverted_cells(*mesh, tip_at(0.5)), std::uint64_t{0});
  QCOMPARE(*inverted_cells(*mesh, tip_at(0)), std::uint64_t{1});  // flat
  QCOMPARE(*inverted_cells(*mesh, tip_at(-1)), std::uint64_t{1});
  QVERIFY(near(*volume_of(*mesh, tip_at(-1)), -1.0 / 6));
}

void ShapeMeasuresTest::a_sphere_that_grows() {
  const MeshPointer mesh = sphere(16, 9);
  const Placed rest(*mesh, same), now(*mesh, larger);
  QVERIFY(near(*volume_change(*mesh, now), 1.2 * 1.2 * 1.2 - 1));
  QVERIFY(near(*largest_principal_stretch(*mesh, now), 1.2));
  QVERIFY(!inverted_cells(*mesh, now));
  QVERIFY(near(hausdorff_distance(surface_of(*mesh, rest), surface_of(*mesh, now)), 0.2 * 3));
}

void ShapeMeasuresTest::a_stretched_plane() {
  const MeshPointer mesh = generate({MeshKind::cloth, {4, 5, 1}, 1, {}});
  QCOMPARE(mesh->space_dimension, 2);
  QVERIFY(near(*volume_change(*mesh, Placed(*mesh, stretched)), 0.3));
  QVERIFY(near(*largest_principal_stretch(*mesh, Placed(*mesh, stretched)), 1.3));
  QCOMPARE(*inverted_cells(*mesh, Placed(*mesh, mirrored)), std::uint64_t(mesh->triangles.size()));
}

void ShapeMeasuresTest::sheared_cells_have_the_stretch_of_the_closed_form() {
  const MeshPointer mesh = generate({MeshKind::tetra, {3, 2, 2}, 1, {}});
  const double shear = 0.7;
  const Placed now(*mesh, [&](const Point& at) { return Point(at.x() + shear * at.y(), at.y(), at.z()); });
  QVERIFY(near(*largest_principal_stretch(*mesh, now), shear / 2 + std::sqrt(1 + shear * shear / 4)));
  QVERIFY(near(*volume_change(*mesh, now), 0));
}

void ShapeMeasuresTest::objects_without_cells_have_no_figures() {
  const MeshPointer line = generate({MeshKind::line, {5, 1, 1}, 1, {}}),
                    cube = generate({MeshKind::block, {3, 3, 3}, 1, {}});
  for (const MeshPointer& mesh : {line, cube}) {
    const Placed now(*mesh, larger);
    QVERIFY(!volume_change(*mesh, now) && !inverted_cells(*mesh, now) && !largest_principal_stretch(*mesh, now));
    QVERIFY(hausdorff_distance(*mesh, Placed(*mesh, same), now) > 0.3);
  }
  // An open surface in space has no volume.
  const MeshPointer sheet = generate({MeshKind::cloth, {4, 4, 1}, 1, 3});
  QVERIFY(!volume_change(*sheet, Placed(*sheet, larger)) && !inverted_cells(*sheet, Placed(*sheet, larger)));
}

void ShapeMeasuresTest::hausdorff_is_from_points_to_triangles() {
  const MeshPointer mesh = generate({MeshKind::cloth, {5, 5, 1}, 1, 3});
  // Shifted in its plane, only the border is away. Raised, all of it is.
  const auto moved = [&](const Point& by) {
    const Placed rest(*mesh, same), now(*mesh, [&](const Point&at) { return Point(at + by); });
    return hausdorff_distance(surface_of(*mesh, rest), surface_of(*mesh, now));
  };
  QVERIFY(near(moved({0.4, 0, 0}), 0.4));
  QVERIFY(near(moved({0, 0, 0.25}), 0.25));
  QVERIFY(near(moved({0, 0, 0}), 0));
  // A large surface and a small part of it: one way it is 0.
  PointSurface one{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  PointSurface other{{{1, 1, 0}, {1.2, 1, 0}, {1, 1.2, 0}}, {{0, 1, 2}}};
  QVERIFY(near(hausdorff_distance(one, other), hausdorff_distance(other, one)));
  QVERIFY(near(hausdorff_distance(one, other), std::hypot(2.8, 1)));
}

void ShapeMeasuresTest::hausdorff_agrees_with_all_pairs() {
  std::mt19937_64 random(3);
  const auto drawn = [&](int count) {
    PointSurface result;
    for (int i = 0; i < count; ++i) {
      result.points.emplace_back(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    }
    return result;
  };
  for (int i = 0; i < 20; ++i) {
    const PointSurface one = drawn(40), other = drawn(70);
    double largest = 0;
    for (const auto& [from, to] : {std::pair(&one, &other), std::pair(&other, &one)}) {
      for (const Point& point : from->points) {
        double nearest = 1e9;
        for (const Point& candidate : to->points) {
          nearest = std::min(nearest, (candidate - point).norm());
        }
        largest = std::max(largest, nearest);
      }
    }
    QVERIFY(near(hausdorff_distance(one, other), largest));
  }
}

/// A point beside the middle of each side, with the corners in every order.
void ShapeMeasuresTest::hausdorff_looks_at_each_side_of_a_triangle() {
  const std::vector<Point> corners{{0, 0, 0}, {10, 0, 0}, {4, 9, 0}};
  const Point middle = (corners[0] + corners[1] + corners[2]) / 3;
  std::array<ElementId, 3> order{0, 1, 2};
  do {
    const PointSurface triangle{corners, {order}};
    for (std::size_t side = 0; side < 3; ++side) {
      const Point &from = corners[side], &to = corners[(side + 1) % 3], along = (to - from).normalized();
      const Point outward = ((from - middle) - (from - middle).dot(along) * along).normalized();
      PointSurface with_point = triangle;
      with_point.points.emplace_back((from + to) / 2 + 0.1 * outward);
      QVERIFY(near(hausdorff_distance(with_point, triangle), 0.1));
      QVERIFY(near(hausdorff_distance(triangle, with_point), 0.1));
    }
  } while (std::ranges::next_permutation(order).found);
}

namespace {

/// Returns the least value of a convex function between 0 and `end`, by a search in thirds.
template <class Function>
double least_of(double end, Function function) {
  double low = 0, high = end;
  for (int i = 0; i < 60; ++i) {
    const double one = low + (high - low) / 3, other = high - (high - low) / 3;
    (function(one) < function(other) ? high : low) = function(one) < function(other) ? other : one;
  }
  return function((low + high) / 2);
}

/// Returns the distance to a triangle, the least over all its points.
double searched_distance(const Point& from, const PointSurface& surface, const std::array<ElementId, 3>& corners) {
  const Point &a = surface.points[corners[0]], &b = surface.points[corners[1]], &c = surface.points[corners[2]];
  return least_of(1, [&](double u) {
    return least_of(1 - u, [&](double v) { return (a + u * (b - a) + v * (c - a) - from).norm(); });
  });
}

}  // namespace

/// A surface, and the same with one more point: their distance is that of the point.
void ShapeMeasuresTest::hausdorff_agrees_with_a_search_of_all_triangles() {
  std::mt19937_64 random(7);
  const auto drawn = [&random](double reach) {
    return Point(uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach));
  };
  for (int i = 0; i < 150; ++i) {
    PointSurface surface;
    for (ElementId corner = 0; corner < (i < 120 ? 3U : 60U); ++corner) {
      surface.points.push_back(drawn(1));
      if (corner % 3 == 2) {
        surface.triangles.push_back({corner - 2, corner - 1, corner});
      }
    }
    PointSurface with_point = surface;
    with_point.points.push_back(drawn(1.5));
    double nearest = 1e9;
    for (const auto& triangle : surface.triangles) {
      nearest = std::min(nearest, searched_distance(with_point.points.back(), surface, triangle));
    }
    const double found = hausdorff_distance(with_point, surface);
    QVERIFY2(near(found, nearest), qPrintable(QString("%1, not %2").arg(found).arg(nearest)));
  }
}

void ShapeMeasuresTest::figures_of_cells_are_at_rest_and_now() {
  const MeshPointer tetrahedra = generate({MeshKind::tetra, {3, 3, 3}, 1, {}});
  for (const MeshPointer& mesh : {tetrahedra, hexahedral_block({2, 2, 2})}) {
    const auto now = cell_figures(*mesh, {}, Placed(*mesh, stretched));
    QCOMPARE(now->cells, std::uint64_t{mesh->tetrahedra.size() + mesh->hexahedra.size()});
    QCOMPARE(now->parts, std::uint64_t{1});
    QVERIFY(near(now->rest_volume, 8) && near(now->volume, 8 * 1.3));
    // A sixth of a unit cube: the inscribed sphere has the radius 1 / (2 + 2 √2), the circumscribed one √3 / 2.
    QVERIFY(near(*now->worst_quality, 3 / (2 + 2 * std::sqrt(2.0)) / (std::sqrt(3.0) / 2)));
    QVERIFY(near(cell_figures(*mesh, {}, Placed(*mesh, mirrored))->volume, -8));
  }
  QVERIFY(!cell_figures(*generate({MeshKind::cloth, {3, 3, 1}, 1, {}}), {}, PositionView(nullptr, 0, {})));
}

void ShapeMeasuresTest::cells_with_a_cut_link_do_not_count() {
  const MeshPointer mesh = hexahedral_block({3, 1, 1});
  const Placed rest(*mesh, same);
  Cuts cuts(mesh);
  cuts.cut(*find_link(*mesh, 0, 1));
  auto found = cell_figures(*mesh, cuts, rest);
  QCOMPARE(found->cells, std::uint64_t{2});
  QCOMPARE(found->parts, std::uint64_t{1});
  QVERIFY(near(found->rest_volume, 2) && near(found->volume, 2));
  QVERIFY(near(*volume_change(*mesh, Placed(*mesh, stretched), cuts), 0.3));
  QCOMPARE(*volume_of(*mesh, rest, cuts), found->volume);
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    cuts.cut(link);
  }
  found = cell_figures(*mesh, cuts, rest);
  QCOMPARE(found->cells, std::uint64_t{0});
  QCOMPARE(found->parts, std::uint64_t{mesh->element_count()});
  QVERIFY(found->volume == 0 && !found->worst_quality);
}

void ShapeMeasuresTest::the_quality_of_tetrahedra_is_that_of_closed_forms() {
  using Corners = std::array<Point, 4>;
  const Corners regular{Point(1, 1, 1), Point(1, -1, -1), Point(-1, 1, -1), Point(-1, -1, 1)};
  const Corners corner{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  const Corners flat{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(1, 1, 0)};
  for (const double size : {1.0, 1e60, 1e-60, 1e100, 1e-100}) {
    Corners scaled = regular;
    std::ranges::for_each(scaled, [size](Point& one) { one *= size; });
    QVERIFY(near(tetrahedron_quality(scaled), 1));
  }
  QCOMPARE(tetrahedron_quality({Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, std::nan(""))}), 0.0);
  QCOMPARE(tetrahedron_quality({Point(1, 1, 1), Point(1, 1, 1), Point(1, 1, 1), Point(1, 1, 1)}), 0.0);
  // Its inscribed sphere has the radius 1 / (3 + √3), and its circumscribed one √3 / 2.
  QVERIFY(near(tetrahedron_quality(corner), 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2)));
  QCOMPARE(tetrahedron_quality(flat), 0.0);
}

CHAINMAIL_TEST(ShapeMeasuresTest)

}  // namespace chainmail::test_shape_measures

#include "test_shape_measures.moc"
