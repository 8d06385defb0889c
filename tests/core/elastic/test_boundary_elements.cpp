#include <QtTest>

#include "core/elastic/elastic_problems.h"
#include "core/pinned.h"
#include "core/spheres.h"
#include "elastic/boundary_elements.h"
#include "elastic/closed_surface.h"
#include "program.h"

namespace chainmail::test_boundary_elements {

using namespace chainmail::test;

namespace {

constexpr double poisson = 0.3;

QString told(const std::function<void()>& act) { return QString::fromStdString(refusal(act)); }

QString refused(const MeshPointer& mesh, const std::vector<ElementId>& pins, const Cuts& cuts = {}) {
  ElasticProblem problem = pinned(mesh, pins);
  problem.cuts = cuts;
  return told([&] { make_elastic(Algorithm::boundary_elements, problem); });
}

}  // namespace

/// Boundary elements on closed surfaces: the answer to a handle.
class BoundaryElementsTest : public QObject {
  Q_OBJECT

 private slots:
  void cavities_and_turned_triangles_are_found();
  void a_cavity_belongs_to_the_innermost_solid();
  void the_hand_and_the_pins_are_where_they_are();
  void corners_average_their_triangles_by_area();
  void pins_that_move_alike_take_the_solid_along();
  void a_corner_of_two_solids_is_halfway_between_them();
  void the_hand_does_what_pins_would();
  void the_hand_wins_over_pins();
  void parts_move_by_themselves();
  void it_agrees_with_finite_elements();
  void it_can_be_cancelled();
  void wrong_surfaces_are_refused();
  void loose_parts_are_refused();
};
void BoundaryElementsTest::cavities_and_turned_triangles_are_found() {
  // A ball in a cavity of a ball, and another ball next to them. Every other triangle has the wrong orientation.
  MeshParts parts = together(together(sphere_parts(3, 3), sphere_parts(3, 2)), sphere_parts(2, 1));
  parts = together(parts, sphere_parts(2), Point(8, 0, 0));
  for (std::size_t t = 0; t < parts.triangles.size(); t += 2) {
    std::swap(parts.triangles[t][0], parts.triangles[t][1]);
  }
  const auto mesh = build_mesh(std::move(parts));
  const auto solids = enclosed_solids(mesh, Cuts(mesh));
  QCOMPARE(solids.size(), std::size_t(3));
  QCOMPARE(solids[0].triangles.size(), std::size_t(2 * 72));
  QCOMPARE(solids[1].triangles.size(), std::size_t(32));
  const Point middle = unit_position(*mesh, 0) - Point(0, 0, 3) / (mesh->box[1] - mesh->box[0]).norm();
  for (std::size_t t = 0; t < 2 * 72; ++t) {
    const Facet& facet = solids[0].facets[t];
    QCOMPARE(facet.normal.dot(facet.centroid - middle) > 0, t < 72);
  }
}

/// A hollow ball inside a hollow ball: each cavity belongs to the ball around it, not to the outer one.
void BoundaryElementsTest::a_cavity_belongs_to_the_innermost_solid() {
  const auto mesh = build_mesh(
      together(together(sphere_parts(2, 4), sphere_parts(2, 3)), together(sphere_parts(2, 2), sphere_parts(2, 1))));
  const auto solids = enclosed_solids(mesh, Cuts(mesh));
  QCOMPARE(solids.size(), std::size_t(2));
  for (const Solid& solid : solids) {
    double outer = 0, inner = 5;
    for (const auto& triangle : solid.triangles) {
      outer = std::max(outer, mesh->rest_position(triangle[0]).norm());
      inner = std::min(inner, mesh->rest_position(triangle[0]).norm());
    }
    QCOMPARE(outer - inner, 1.0);
  }
}

void BoundaryElementsTest::the_hand_and_the_pins_are_where_they_are() {
  const auto mesh = octahedral_sphere(4);
  const auto pins = layer(*mesh, *find_side("bottom"));
  const auto solver =
      make_elastic(Algorithm::boundary_elements,
                   pinned(
                       mesh, pins, [](const Point& at) { return Point(0, 0.1, 0.05 * at.x()); }, poisson));
  const auto rest = solver->displacements();
  const auto top = layer(*mesh, *find_side("top"));
  std::vector<std::vector<double>> answers;
  const Point first(0.3, 0.2, -0.1), second(-0.1, 0.4, 0.2), before(rest.data() + 3 * std::size_t{top.front()});
  for (const Point& to : {first, second, Point(first + second - before)}) {
    solver->hold(ElasticHandle::of(top.front()));
    solver->move(ElasticMotion::by(std::array{to.x(), to.y(), to.z()}));
    answers.push_back(solver->displacements());
    for (int k = 0; k < 3; ++k) {
      // The displacement from the position that the pins gave it is added to that position, which rounds.
      QVERIFY(std::abs(answers.back()[3 * top.front() + std::size_t(k)] - to[k]) < 1e-15);
      for (const ElementId pin : pins) {
        QCOMPARE(answers.back()[3 * pin + std::size_t(k)], rest[3 * pin + std::size_t(k)]);
      }
    }
  }
  for (const ElementId pin : pins) {
    QCOMPARE(rest[3 * pin + 1], 0.1);
    QCOMPARE(rest[3 * pin + 2], 0.05 * mesh->rest_position(pin).x());
  }
  // Measured from the answer to the pins, the third move is the sum of the first two, and so is its answer.
  for (std::size_t i = 0; i < rest.size(); ++i) {
    QVERIFY(std::abs(answers[0][i] + answers[1][i] - rest[i] - answers[2][i]) < 1e-12);
  }
  solver->reset();
  QVERIFY(same_bits(solver->displacements(), rest));
}

/// If every element is pinned, each triangle moves by the mean of its corners. A corner moves by the mean of the
/// triangles around it, weighted by area: otherwise many small triangles on one side would dominate.
void BoundaryElementsTest::corners_average_their_triangles_by_area() {
  MeshParts parts = sphere_parts(3);
  for (Point& at : parts.rest) {
    at = at.cwiseProduct(Point(1, 3, 0.4));  // so the triangles around a corner have different areas
  }
  const auto mesh = build_mesh(std::move(parts));
  const auto displacement = [&](ElementId e) {
    const Point at = mesh->rest_position(e);
    return Point(at.y() * at.y(), at.x() * at.z(), 0.3 * at.x() * at.y());
  };
  PinnedElements everywhere;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    everywhere.emplace_back(displacement(e));
  }
  const PinnedSolid solid(*mesh, enclosed_solids(mesh, Cuts(mesh)).front(), everywhere, poisson, {});
  QCOMPARE(solid.elements().size(), std::size_t(mesh->element_count()));
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    Point sum = Point::Zero();
    double area = 0;
    for (const auto& [a, b, c] : mesh->triangles) {
      if (a == e || b == e || c == e) {
        const double one = Facet({mesh->rest_position(a), mesh->rest_position(b), mesh->rest_position(c)}).area;
        sum += one * (displacement(a) + displacement(b) + displacement(c)) / 3;
        area += one;
      }
    }
    QVERIFY((solid.at_rest().segment<3>(3 * Eigen::Index{e}) - sum / area).norm() < 1e-12);
  }
}

/// Single pins hold the triangles around them, although the other corners of these are free.
void BoundaryElementsTest::pins_that_move_alike_take_the_solid_along() {
  const auto mesh = octahedral_sphere(4);
  const Point by(0.3, -0.2, 0.1);
  std::vector<ElementId> pins;  // the six corners of the octahedron, far from each other
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    if (mesh->rest_position(e).cwiseAbs().maxCoeff() > 1 - 1e-12) {
      pins.push_back(e);
    }
  }
  QCOMPARE(pins.size(), std::size_t(6));
  const Field shift = [&](const Point&) { return by; };
  const auto solver = make_elastic(Algorithm::boundary_elements, pinned(mesh, pins, shift, poisson));
  QVERIFY(furthest_from(*mesh, solver->displacements(), shift) < 1e-10);
}

/// Two balls that touch in one element. Each is pinned on its far side.
void BoundaryElementsTest::a_corner_of_two_solids_is_halfway_between_them() {
  const MeshParts ball = sphere_parts(2);
  const auto find = [&](const Point& at) {
    const auto found = std::ranges::find_if(ball.rest, [&](const Point& one) { return (one - at).norm() < 1e-12; });
    return static_cast<ElementId>(found - ball.rest.begin());
  };
  const ElementId touching = find({1, 0, 0}), of_second = find({-1, 0, 0});
  const auto count = static_cast<ElementId>(ball.rest.size());
  MeshParts both = together(ball, ball, Point(2, 0, 0));
  for (auto& triangle : both.triangles) {
    std::ranges::replace(triangle, count + of_second, touching);
  }
  both.links.clear();
  add_links_along_edges(both);
  const Field pulled = [](const Point& at) { return at.x() > 0.5 ? Point(0.2, 0.3, 0.1) : Point(-0.1, 0.2, 0.4); };
  std::vector<ElementId> of_left, of_right, of_both;
  for (ElementId e = 0; e < count; ++e) {
    if (ball.rest[e].x() < -0.5) {
      of_left.push_back(e);
      of_both.push_back(e);
    }
  }
  for (ElementId e = 0; e < count; ++e) {
    if (ball.rest[e].x() > 0.5) {
      of_right.push_back(e);
      of_both.push_back(count + e);
    }
  }
  const auto mesh = build_mesh(ball);
  const auto left = make_elastic(Algorithm::boundary_elements, pinned(mesh, of_left, pulled, poisson)),
             right = make_elastic(Algorithm::boundary_elements, pinned(mesh, of_right, pulled, poisson)),
             joined = make_elastic(Algorithm::boundary_elements, pinned(build_mesh(both), of_both, pulled, poisson));
  for (std::size_t k = 0; k < 3; ++k) {
    const double one = left->displacements()[3 * touching + k], other = right->displacements()[3 * of_second + k];
    QVERIFY(std::abs(one - other) > 0.01);
    QVERIFY(std::abs(joined->displacements()[3 * touching + k] - (one + other) / 2) < 1e-10);
  }
}

/// Prescribing the facets of the handle by pins is another system of equations with the same answer.
void BoundaryElementsTest::the_hand_does_what_pins_would() {
  const auto mesh = octahedral_sphere(4);
  const auto bottom = layer(*mesh, *find_side("bottom"));
  const ElementId top = layer(*mesh, *find_side("top")).front();
  const auto held = make_elastic(Algorithm::boundary_elements, pinned(mesh, bottom));
  held->hold(ElasticHandle::of(top));
  held->move(ElasticMotion::by(std::array{0.1, 0.3, -0.2}));
  std::vector<ElementId> pins(mesh->neighbours_of(top).begin(), mesh->neighbours_of(top).end());
  pins.push_back(top);
  pins.insert(pins.end(), bottom.begin(), bottom.end());
  std::ranges::sort(pins);
  const auto prescribed = make_elastic(
      Algorithm::boundary_elements,
      pinned(
          mesh, pins, [](const Point& at) { return at.y() > 0 ? Point(0.1, 0.3, -0.2) : Point(Point::Zero()); },
          poisson));
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    for (std::size_t k = 0; k < 3 && !std::ranges::binary_search(pins, e); ++k) {
      QVERIFY(std::abs(held->displacements()[3 * e + k] - prescribed->displacements()[3 * e + k]) < 1e-12);
    }
  }
}

/// Single pins hold all triangles around them. Here these are all triangles that the handle holds.
void BoundaryElementsTest::the_hand_wins_over_pins() {
  const auto octahedron = octahedral_sphere(1);
  const ElementId top = layer(*octahedron, *find_side("top")).front(),
                  bottom = layer(*octahedron, *find_side("bottom")).front();
  std::vector<ElementId> equator;
  for (ElementId e = 0; e < octahedron->element_count(); ++e) {
    if (e != top && e != bottom) {
      equator.push_back(e);
    }
  }
  const auto solver = make_elastic(Algorithm::boundary_elements, pinned(octahedron, equator));
  solver->hold(ElasticHandle::of(top));
  solver->move(ElasticMotion::by(std::array{0.0, 0.5, 0.0}));
  QCOMPARE(solver->displacements()[3 * top + 1], 0.5);
  QCOMPARE(solver->displacements()[3 * bottom + 1], 0.0);
  QCOMPARE(solver->displacements()[3 * equator[0] + 1], 0.0);
}

void BoundaryElementsTest::parts_move_by_themselves() {
  MeshParts parts = together(sphere_parts(2), sphere_parts(2), Point(3, 0, 0));
  parts.rest.emplace_back(0, 0, 0);  // not the corner of a triangle
  const auto two = build_mesh(std::move(parts)), one = octahedral_sphere(2);
  const auto count = one->element_count();
  auto pins = layer(*one, *find_side("bottom"));
  for (ElementId e = 0; pins.size() < 3; ++e) {
    if (one->rest_position(e).y() < 0) {
      pins.insert(std::ranges::lower_bound(pins, e), e);
    }
  }
  pins.erase(std::unique(pins.begin(), pins.end()), pins.end());
  std::vector<ElementId> both = pins;
  std::ranges::transform(pins, std::back_inserter(both), [&](ElementId e) { return e + count; });
  const auto alone = make_elastic(Algorithm::boundary_elements, pinned(one, pins));
  const auto beside = make_elastic(Algorithm::boundary_elements, pinned(two, both));
  const ElementId top = layer(*one, *find_side("top")).front();
  const std::array<double, 3> to{0.2, 0.1, 0.3};
  alone->hold(ElasticHandle::of(top));
  alone->move(ElasticMotion::by(to));
  beside->hold(ElasticHandle::of(top));
  beside->move(ElasticMotion::by(to));
  for (std::size_t i = 0; i < 3 * std::size_t(count); ++i) {
    QVERIFY(std::abs(alone->displacements()[i] - beside->displacements()[i]) < 1e-12);
    QCOMPARE(beside->displacements()[i + 3 * count], 0.0);
  }
  const ElementId loose = 2 * count;
  QCOMPARE(beside->displacements()[3 * loose], 0.0);
  beside->hold(ElasticHandle::of(loose));
  beside->move(ElasticMotion::by(to));
  QCOMPARE(beside->displacements()[3 * loose + 2], to[2]);
  QCOMPARE(beside->displacements()[3 * top], 0.0);
}

/// A cube between two plates, one of which moves, computed on its surface and filled with tetrahedra. Both come closer
/// to the exact answer, and so to each other, as the elements become smaller. Constant elements are less accurate.
void BoundaryElementsTest::it_agrees_with_finite_elements() {
  const Field plates = [](const Point& at) { return at.x() > 0 ? Point(0.1, 0.05, -0.02) : Point(Point::Zero()); };
  std::vector<double> sizes, errors;
  for (const std::uint32_t parts : {3U, 6U}) {
    const auto mesh = make_mesh(MeshKind::tetra, {parts + 1, parts + 1, parts + 1}, {}, 1.0 / parts);
    const auto problem = pinned(mesh, both_ends(*mesh), plates, poisson);
    const auto fem = make_elastic(Algorithm::linear_fem, problem),
               bem = make_elastic(Algorithm::boundary_elements, problem);
    ElementId e = 0;
    sizes.push_back(1.0 / parts);
    errors.push_back(rms_from(*mesh, bem->displacements(),
                              [&](const Point&) {
                                const double* at = fem->displacements().data() + 3 * std::size_t{e++};
                                return Point(at[0], at[1], at[2]);
                              }) /
                     plates(Point(1, 0, 0)).norm());
  }
  qInfo() << "boundary elements compared with finite elements: order" << order_of(sizes, errors)
          << "differences over the move" << errors;
  QVERIFY(order_of(sizes, errors) > 0.8);
  QVERIFY(errors.back() < 0.05);
}

void BoundaryElementsTest::it_can_be_cancelled() {
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_EXCEPTION_THROWN(make_elastic(Algorithm::boundary_elements, pinned(octahedral_sphere(4), {0, 1, 2, 3}), job),
                           Cancelled);
}

void BoundaryElementsTest::wrong_surfaces_are_refused() {
  const auto ball = octahedral_sphere(3);
  const std::vector<ElementId> pins{0, 1, 2, 3};
  QCOMPARE(refused(ball, pins), QString());
  MeshParts open = sphere_parts(3), three = sphere_parts(3), flat = sphere_parts(3);
  open.triangles.erase(open.triangles.begin());
  QVERIFY(refused(build_mesh(open), pins).startsWith("BEM: the surface is open along the edge between the elements "));
  QVERIFY(!fits(Algorithm::boundary_elements, *build_mesh(open)) && fits(Algorithm::boundary_elements, *ball));
  three.rest.emplace_back(3, 3, 3);
  three.triangles.push_back({three.triangles[0][0], three.triangles[0][1], ElementId(three.rest.size() - 1)});
  QVERIFY(refused(build_mesh(three), pins).contains("3 triangles meet at the edge between the elements "));
  flat.rest[flat.triangles[0][0]] = (flat.rest[flat.triangles[0][1]] + flat.rest[flat.triangles[0][2]]) / 2;
  QVERIFY(refused(build_mesh(flat), pins).contains("of a triangle are on one line"));
  Cuts cuts(ball);
  cuts.cut(*find_link(*ball, ball->triangles[0][0], ball->triangles[0][1]));
  QVERIFY(refused(ball, pins, cuts).startsWith("BEM: a cut along the edge between the elements "));
  MeshParts doubled = sphere_parts(1);
  doubled.triangles.resize(1);
  doubled.triangles.push_back(doubled.triangles[0]);
  QVERIFY(refused(build_mesh(doubled), pins).contains("encloses no volume"));
  // The projective plane with six corners: no edge is open, and there is no inside.
  MeshParts one_sided;
  one_sided.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.3}, {0.4, 1, 1}};
  one_sided.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                         {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  add_links_along_edges(one_sided);
  QVERIFY(refused(build_mesh(one_sided), pins).contains("has only one side"));
  QVERIFY(!fits(Algorithm::boundary_elements, *make_mesh(MeshKind::cloth, {4, 4, 1})));
  QVERIFY(!fits(Algorithm::boundary_elements, *make_mesh(MeshKind::tetra, {40, 40, 40})));
  QVERIFY(refused(octahedral_sphere(30), pins)
              .contains("triangles on the surface, and this object has 7200; use a coarser mesh"));
}

void BoundaryElementsTest::loose_parts_are_refused() {
  const auto ball = octahedral_sphere(3);
  QCOMPARE(refused(ball, {}),
           QString("object: nothing pins it, so there is no solution; pin its bottom layer, or single elements"));
  QVERIFY(refused(ball, {0, 1}).startsWith("the part of element 0: fewer than three pins"));
  const auto two = build_mesh(together(sphere_parts(3), sphere_parts(3), Point(3, 0, 0)));
  QVERIFY(refused(two, {0, 1, 2, 3})
              .startsWith("the part of element " + QString::number(ball->element_count()) + ": fewer"));
  const auto block = make_mesh(MeshKind::tetra, {4, 3, 3});
  auto pins = layer(*block, *find_side("left"));
  const ElementId behind = 1 + 4 * (1 + 3 * 1), inside = behind + 1;
  const auto solver = make_elastic(Algorithm::boundary_elements, pinned(block, pins));
  QVERIFY(told([&] {
            solver->hold(ElasticHandle::of(inside));
          }).startsWith(QString("BEM: element %1 lies inside").arg(inside)));
  pins.insert(std::ranges::lower_bound(pins, behind), behind);
  QCOMPARE(refused(block, pins), QString());
  pins.insert(std::ranges::lower_bound(pins, inside), inside);
  QVERIFY(refused(block, pins).startsWith(QString("BEM: element %1 is pinned inside").arg(inside)));
}

CHAINMAIL_TEST(BoundaryElementsTest)

}  // namespace chainmail::test_boundary_elements

#include "test_boundary_elements.moc"
