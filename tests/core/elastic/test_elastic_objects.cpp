#include <Eigen/Geometry>
#include <QtTest>
#include <numeric>

#include "core/elastic/elastic_problems.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_elastic_objects {

using namespace chainmail::test;

/// Which objects finite elements accept, and what the messages say about the others.
class ElasticObjectsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_block_of_links_has_cells();
  void hexahedra_have_cells();
  void wrong_objects_are_refused();
  void a_cut_part_is_named();
  void cells_that_are_too_small_to_hold_are_told();
  void what_does_not_converge_is_told();
  void the_last_step_is_told_relative_to_the_edges_data();
  void the_last_step_is_told_relative_to_the_edges();
};

namespace {

QString sentence(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return QString::fromStdString(error.what());
  }
  return QStringLiteral("no error");
}

}  // namespace

/// A grid and a block have only links along the axes. Their squares and cubes resist deformation.
void ElasticObjectsTest::a_block_of_links_has_cells() {
  const auto grid = make_mesh(MeshKind::grid, {5, 4, 1}), block = make_mesh(MeshKind::block, {4, 3, 3});
  const Simplices squares = build_simplices(*grid, Cuts(grid)), cubes = build_simplices(*block, Cuts(block));
  QCOMPARE(squares.count(), std::size_t(2 * 4 * 3));
  QCOMPARE(cubes.count(), std::size_t(6 * 3 * 2 * 2));
  QCOMPARE(std::accumulate(squares.volumes.begin(), squares.volumes.end(), 0.0), 12.0);
  QCOMPARE(std::accumulate(cubes.volumes.begin(), cubes.volumes.end(), 0.0), 12.0);
  Cuts cuts(block);
  cuts.cut(*find_link(*block, 0, 1));  // an edge of only one cube
  QCOMPARE(build_simplices(*block, cuts).count(), cubes.count() - 6);
}

/// Neighbours must agree on the diagonals of their common side, otherwise a uniform strain would not be exact.
void ElasticObjectsTest::hexahedra_have_cells() {
  const auto block = make_mesh(MeshKind::block, {4, 4, 4});
  MeshParts parts;
  // Elements are renumbered at random, so that any corner of a cell can have the lowest id.
  std::vector<ElementId> number(block->element_count());
  std::iota(number.begin(), number.end(), 0U);
  std::mt19937_64 random(5);
  for (std::size_t i = number.size() - 1; i > 0; --i) {
    std::swap(number[i], number[random() % (i + 1)]);
  }
  parts.rest.resize(number.size());
  for (ElementId e = 0; e < block->element_count(); ++e) {
    const Point at = block->rest_position(e);
    parts.rest[number[e]] = at;
    if (at.maxCoeff() < 3) {
      std::array<ElementId, 8> cell{e, e + 1, e + 5, e + 4, e + 16, e + 17, e + 21, e + 20};
      std::ranges::transform(cell, cell.begin(), [&](ElementId one) { return number[one]; });
      parts.hexahedra.push_back(cell);
      for (const auto& [i, j] : hexahedron_edges) {
        parts.links.push_back({cell[i], cell[j]});
      }
    }
  }
  const MeshPointer mesh = build_mesh(std::move(parts));
  const Field field = [](const Point& at) { return Point(0.1 * at.x() + 0.2 * at.y(), 0.05 * at.z(), -0.1 * at.x()); };
  const auto solver = make_elastic(Algorithm::linear_fem, pinned(mesh, boundary(*mesh), field, 0.3));
  QCOMPARE(boundary(*mesh).size(), std::size_t(64 - 8));
  QVERIFY(furthest_from(*mesh, solver->displacements(), field) < 1e-12);
}

void ElasticObjectsTest::wrong_objects_are_refused() {
  const auto refusal = [](const ElasticProblem& problem, Algorithm method = Algorithm::linear_fem) {
    return sentence([&] { make_elastic(method, problem); });
  };
  const auto tetra = make_mesh(MeshKind::tetra, {3, 3, 3});
  const auto left = layer(*tetra, *find_side("left"));
  QVERIFY(refusal(pinned(tetra, {})).startsWith("object: nothing pins it, so there is no solution; pin its bottom"));
  QVERIFY(refusal(pinned(tetra, {0, 1, 2}))
              .startsWith("the part of element 0: fewer than three pins that do not lie on one"));
  QVERIFY(refusal(pinned(make_mesh(MeshKind::cloth, {3, 3, 1}), {4}))
              .contains("fewer than two pins at different positions"));
  QVERIFY(
      refusal(pinned(tetra, left, 0.5)).startsWith("poisson: Poisson's ratio 0.5 is out of range; use 0 to below 0.5"));
  QVERIFY(refusal(pinned(tetra, left, -0.1)).startsWith("poisson: "));
  ElasticProblem soft = pinned(tetra, left);
  soft.options.material.young = 0;
  QVERIFY(refusal(soft).startsWith("young: Young's modulus 0 is out of range; use a number above 0"));
  const auto cloth_in_space = make_mesh(MeshKind::cloth, {4, 4, 1}, 3);
  for (const Algorithm method : {Algorithm::linear_fem, Algorithm::neo_hookean}) {
    QVERIFY(!fits(method, *cloth_in_space));
    QVERIFY(refusal(pinned(cloth_in_space, {0, 1, 4}), method).contains("no tetrahedra or hexahedra"));
  }
  QVERIFY(refusal(pinned(make_mesh(MeshKind::line, {9, 1, 1}, 2), {0})).contains("no triangles"));

  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}};
  parts.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  add_links_along_edges(parts);
  MeshParts flat = parts, inverted = parts;
  QCOMPARE(refusal(pinned(build_mesh(parts), {0, 1, 2})), "no error");
  flat.tetrahedra.push_back({0, 1, 2, 5});
  QVERIFY(refusal(pinned(build_mesh(flat), {0, 1, 2})).startsWith("the cell of elements 0, 1, 2 and 5: it is flat"));
  std::swap(inverted.tetrahedra[1][0], inverted.tetrahedra[1][1]);
  QVERIFY(refusal(pinned(build_mesh(inverted), {0, 1, 2}))
              .startsWith("the cell of elements 2, 1, 3 and 4: it is inverted"));
}

void ElasticObjectsTest::a_cut_part_is_named() {
  const auto cloth = make_mesh(MeshKind::cloth, {6, 3, 1});
  ElasticProblem problem = pinned(cloth, layer(*cloth, *find_side("left")));
  for (LinkId link = 0; link < cloth->link_count(); ++link) {
    const auto [a, b] = cloth->links[link];
    if (std::min(a % 6, b % 6) == 2 && std::max(a % 6, b % 6) == 3) {
      problem.cuts.cut(link);
    }
  }
  QVERIFY(sentence([&] { make_elastic(Algorithm::linear_fem, problem); }).startsWith("the part of element 3: fewer"));
}

namespace {

void add_tetrahedron(MeshParts& parts, std::array<ElementId, 4> corners) {
  const Point a = parts.rest[corners[0]], b = parts.rest[corners[1]], c = parts.rest[corners[2]];
  if ((b - a).cross(c - a).dot(parts.rest[corners[3]] - a) < 0) {
    std::swap(corners[2], corners[3]);
  }
  parts.tetrahedra.push_back(corners);
}

/// A pinned tetrahedron from which others hang. What joins them is so small that it is lost in the sums of stiffness:
/// then rounding decides about each of them whether anything holds it.
MeshPointer hung_on_almost_nothing() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_tetrahedron(parts, {0, 1, 2, 3});
  std::mt19937_64 random(8);
  for (int hung = 0; hung < 40; ++hung) {
    const auto first = ElementId(parts.rest.size());
    for (const double size : {1e-25, 1.0}) {
      for (int k = 0; k < 3; ++k) {
        parts.rest.push_back(
            size * (Point::Unit(k) + Point(uniform(random, 0, 0.2), uniform(random, 0, 0.2), uniform(random, 0, 0.2))));
      }
    }
    add_tetrahedron(parts, {0, first, first + 1, first + 2});
    add_tetrahedron(parts, {first, first + 3, first + 4, first + 5});
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

}  // namespace

void ElasticObjectsTest::cells_that_are_too_small_to_hold_are_told() {
  const MeshPointer mesh = hung_on_almost_nothing();
  for (const auto& [method, name] :
       {std::pair(Algorithm::arap, "ARAP"), std::pair(Algorithm::projective, "Projective Dynamics")}) {
    const QString told = sentence([&, method = method] {
      make_elastic(method, pinned(mesh, {0, 1, 2, 3}))->hold(ElasticHandle::of(mesh->element_count() - 1));
    });
    QVERIFY2(told.startsWith(QString(name) + ": its matrix is not positive definite: cells are too thin; "),
             qPrintable(told));
  }
}

/// The handle is pushed through the wall that holds the object. Cells cannot follow without inverting.
void ElasticObjectsTest::what_does_not_converge_is_told() {
  const auto mesh = make_mesh(MeshKind::tetra, {4, 3, 3});
  const auto solver = make_elastic(Algorithm::neo_hookean, pinned(mesh, boundary(*mesh)));
  const ElementId middle = 1 + 4 * (1 + 3 * 1);
  solver->hold(ElasticHandle::of(middle));
  solver->move(ElasticMotion::by(std::array{-3.0, 0.0, 0.0}));
  const QString remark = QString::fromStdString(solver->remark());
  QVERIFY2(remark.startsWith("Newton did not converge in load step "), qPrintable(remark));
  QVERIFY(remark.contains("this is the last converged state"));
  const double reached = solver->displacements()[3 * middle];
  QVERIFY(reached < 0 && reached > -1);  // the wall is one spacing away
  solver->move(ElasticMotion::by(std::array{-0.3, 0.0, 0.0}));
  QVERIFY(solver->remark().empty());
  QCOMPARE(solver->displacements()[3 * middle], -0.3);
}

void ElasticObjectsTest::the_last_step_is_told_relative_to_the_edges_data() {
  QTest::addColumn<int>("method");
  for (const AlgorithmInfo& one : elastic_algorithms()) {
    if (one.obeys_iterations) {
      QTest::newRow(std::string(one.name).c_str()) << int(one.algorithm);
    }
  }
}

/// The same object in another unit of length: the remark has the same number.
void ElasticObjectsTest::the_last_step_is_told_relative_to_the_edges() {
  QFETCH(const int, method);
  const auto remark = [&](double unit) {
    const auto mesh = make_mesh(MeshKind::tetra, {6, 3, 3}, {}, unit);
    ElasticProblem problem = pinned(mesh, layer(*mesh, *find_side("left")));
    problem.options.iterations = 2;
    const auto solver = make_elastic(Algorithm(method), problem);
    solver->hold(ElasticHandle::of(mesh->element_count() - 1));
    solver->move(ElasticMotion::by(std::array{unit, 2 * unit, 0.0}));
    return QString::fromStdString(solver->remark());
  };
  const QString in_metres = remark(1), in_sixteenths = remark(16);
  QVERIFY2(in_metres.contains("of the mean edge length"), qPrintable(in_metres));
  QCOMPARE(in_sixteenths, in_metres);
}

CHAINMAIL_TEST(ElasticObjectsTest)

}  // namespace chainmail::test_elastic_objects

#include "test_elastic_objects.moc"
