#include <QtTest>

#include "core/elastic/elastic_problems.h"
#include "core/families.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_free_form {

using namespace chainmail::test;

/// Free-form deformation, and dragging elements by it.
class FreeFormTest : public QObject {
  Q_OBJECT

 private slots:
  void control_points_carry_affine_maps();
  void elements_follow_the_hand_by_least_squares();
  void pins_hold_as_well_as_the_lattice_can();
  void goes_on_from_where_others_put_it();
  void the_drag_goes_on_from_there_too();
  void a_lattice_lies_along_the_axes_of_the_object();
  void lattices_have_bounds();
};

namespace {

std::vector<MeshPointer> some_meshes() {
  return {make_mesh(MeshKind::line, {7, 1, 1}), make_mesh(MeshKind::cloth, {6, 5, 1}),
          make_mesh(MeshKind::block, {4, 5, 3})};
}

ElasticProblem with_lattice(const MeshPointer& mesh, std::array<std::uint32_t, 3> lattice,
                            std::vector<ElementId> pins = {}) {
  ElasticProblem problem = pinned(mesh, std::move(pins));
  problem.options.lattice = lattice;
  return problem;
}

}  // namespace

/// Bernstein polynomials have linear precision: an affine map of all control points is the same map of all elements.
void FreeFormTest::control_points_carry_affine_maps() {
  Eigen::Matrix3d map;
  map << 0.3, 0.1, -0.2, 0.05, -0.2, 0.4, 0.1, 0.2, 0.3;
  const Point shift(1, -2, 3);
  for (const MeshPointer& mesh : some_meshes()) {
    const auto n = static_cast<std::size_t>(mesh->space_dimension);
    const auto solver = make_elastic(Algorithm::free_form, with_lattice(mesh, {4, 3, 5}));
    const std::vector<double> rest(solver->control_points().begin(), solver->control_points().end());
    const std::vector<std::size_t> counts{4, 4 * 3, 4 * 3 * 5};
    QCOMPARE(rest.size(), n * counts[n - 1]);
    const auto image = [&](const Point& at) {
      Point to = map * at + shift;
      for (std::size_t k = n; k < 3; ++k) {
        to[static_cast<Eigen::Index>(k)] = 0;
      }
      return to;
    };
    for (std::size_t c = 0; c < rest.size() / n; ++c) {
      Point at = Point::Zero();
      std::copy_n(rest.begin() + static_cast<std::ptrdiff_t>(n * c), n, at.data());
      const Point to = at + image(at);
      solver->move_control_point(c, std::span(to.data(), n));
      QCOMPARE(solver->control_points()[n * c], to[0]);
    }
    QVERIFY(furthest_from(*mesh, solver->displacements(), image) < 1e-12);
  }
}

/// Of all motions of the control points that bring the element to its target, the smallest: along the weights of the
/// element.
void FreeFormTest::elements_follow_the_hand_by_least_squares() {
  const auto mesh = make_mesh(MeshKind::cloth, {9, 9, 1});
  const auto solver = make_elastic(Algorithm::free_form, with_lattice(mesh, {3, 3, 2}));
  const std::vector<double> before(solver->control_points().begin(), solver->control_points().end());
  solver->hold(ElasticHandle::of(40));  // the middle: weights (1, 2, 1) / 4 along each axis
  solver->move(ElasticMotion::by(std::array{0.5, -1.0}));
  QCOMPARE(solver->displacements()[80], 0.5);
  QCOMPARE(solver->displacements()[81], -1.0);
  const std::array<double, 3> along{0.25, 0.5, 0.25};
  double squares = 0;
  for (const double x : along) {
    for (const double y : along) {
      squares += x * x * y * y;
    }
  }
  for (std::size_t c = 0; c < 9; ++c) {
    const double weight = along[c % 3] * along[c / 3];
    QVERIFY(std::abs(solver->control_points()[2 * c] - before[2 * c] - 0.5 * weight / squares) < 1e-12);
    QVERIFY(std::abs(solver->control_points()[2 * c + 1] - before[2 * c + 1] + weight / squares) < 1e-12);
  }
  solver->move(ElasticMotion::by(std::array{0.0, 0.0}));  // back again: no displacement remains
  QVERIFY(furthest_from(*mesh, solver->displacements(), [](const Point&) { return Point(Point::Zero()); }) < 1e-12);
}

void FreeFormTest::pins_hold_as_well_as_the_lattice_can() {
  const auto mesh = make_mesh(MeshKind::cloth, {9, 5, 1});
  const auto left = layer(*mesh, *find_side("left"));
  const auto solver = make_elastic(Algorithm::free_form, with_lattice(mesh, {4, 4, 2}, left));
  solver->hold(ElasticHandle::of(mesh->element_count() - 1));
  solver->move(ElasticMotion::by(std::array{2.0, 1.0}));
  for (const ElementId pin : left) {
    QCOMPARE(solver->displacements()[2 * pin], 0.0);
  }
  // Next to a pin the sheet is almost still: the leftmost column of the lattice does not move.
  for (std::size_t c = 0; c < 16; c += 4) {
    QVERIFY(std::abs(solver->control_points()[2 * c]) < 1e-4);
  }
}

void FreeFormTest::goes_on_from_where_others_put_it() {
  const auto mesh = make_mesh(MeshKind::cloth, {6, 6, 1});
  const auto solver = make_elastic(Algorithm::free_form, with_lattice(mesh, {4, 4, 2}));
  std::vector<double> bent;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point at = mesh->rest_position(e);
    bent.push_back(0.1 * at.y() * at.y());  // a cubic lattice represents this
    bent.push_back(e == 14 ? 0.3 : 0.0);    // but not this
  }
  solver->start_from(bent);
  QVERIFY(same_bits(solver->displacements(), bent));
  QVERIFY(std::abs(solver->control_points()[2 * 15] - 5 - 2.5) < 1e-6);  // the far corner: 0.1 · 5²
  solver->hold(ElasticHandle::of(0));
  solver->move(ElasticMotion::by(std::array{1.0, 0.0}));
  QVERIFY(std::abs(solver->displacements()[2 * 14 + 1] - 0.3) < 1e-12);  // the remainder stays
}

/// The next move of a grabbed element starts from the current positions, which others may have set, not from the grab.
void FreeFormTest::the_drag_goes_on_from_there_too() {
  const auto mesh = make_mesh(MeshKind::cloth, {6, 6, 1});
  const auto problem = with_lattice(mesh, {3, 3, 2});
  std::vector<double> bent;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point at = mesh->rest_position(e);
    bent.push_back(0.2 * at.y());
    bent.push_back(0.1 * at.x() * at.x());
  }
  const auto dragged = make_elastic(Algorithm::free_form, problem);
  dragged->hold(ElasticHandle::of(14));
  dragged->move(ElasticMotion::by(std::array{3.0, -2.0}));
  dragged->start_from(bent);
  dragged->move(ElasticMotion::by(std::array{bent[2 * 14], bent[2 * 14 + 1]}));  // to its current position
  QVERIFY(largest_step(dragged->displacements(), bent) < 1e-12);
  dragged->move(ElasticMotion::by(std::array{1.0, 0.5}));
  const auto fresh = make_elastic(Algorithm::free_form, problem);
  fresh->start_from(bent);
  fresh->hold(ElasticHandle::of(14));
  fresh->move(ElasticMotion::by(std::array{1.0, 0.5}));
  QVERIFY(largest_step(dragged->displacements(), fresh->displacements()) < 1e-12);
}

/// The counts of control points are along x, y and z, also for an upright sheet, which has no y.
void FreeFormTest::a_lattice_lies_along_the_axes_of_the_object() {
  MeshParts parts = placed(*make_mesh(MeshKind::cloth, {6, 4, 1}), [](const Point& p) { return Point(p[0], 2, p[1]); });
  const auto solver = make_elastic(Algorithm::free_form, with_lattice(build_mesh(std::move(parts)), {4, 8, 3}));
  std::vector<double> expected;
  for (const double z : {0.0, 1.5, 3.0}) {
    for (const double x : {0.0, 5.0 / 3, 10.0 / 3, 5.0}) {
      expected.insert(expected.end(), {x, z});
    }
  }
  const std::vector<double> points(solver->control_points().begin(), solver->control_points().end());
  QCOMPARE(points.size(), expected.size());
  QVERIFY(largest_step(points, expected) < 1e-12);
}

void FreeFormTest::lattices_have_bounds() {
  const auto mesh = make_mesh(MeshKind::cloth, {6, 6, 1});
  for (const std::uint32_t count : {0U, 1U, 9U}) {
    QVERIFY_THROWS_EXCEPTION(Error, make_elastic(Algorithm::free_form, with_lattice(mesh, {4, count, 4})));
  }
}

CHAINMAIL_TEST(FreeFormTest)

}  // namespace chainmail::test_free_form

#include "test_free_form.moc"
