#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <QtTest>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "core/elastic/elastic_problems.h"
#include "core/report/plain_minimum.h"
#include "elastic/xpbd.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_contestants {

using namespace chainmail::test;

/// Corotational and quasi-Newton FEM, ARAP, both XPBDs and Projective Dynamics, against their energies' minima and
/// under rotations.
class ContestantsTest : public QObject {
  Q_OBJECT

 private slots:
  void corotational_is_at_the_least_energy_data() { dimensions(); }
  void corotational_is_at_the_least_energy();
  void quasi_newton_is_at_the_least_energy_data() { dimensions(); }
  void quasi_newton_is_at_the_least_energy();
  void projective_is_at_the_least_energy_data() { dimensions(); }
  void projective_is_at_the_least_energy();
  void xpbd_rests_near_the_least_energy_data() { dimensions(); }
  void xpbd_rests_near_the_least_energy();
  void xpbd_swings();
  void xpbd_comes_to_rest();
  void neo_hookean_constraints_have_their_gradients();
  void neo_hookean_xpbd_rests_near_the_least_energy_data() { dimensions(); }
  void neo_hookean_xpbd_rests_near_the_least_energy();
  void neo_hookean_xpbd_survives_far_moves_data() { dimensions(); }
  void neo_hookean_xpbd_survives_far_moves();
  void neo_hookean_xpbd_refuses_surfaces_in_space();
  void too_few_iterations_are_told_data();
  void too_few_iterations_are_told();
  void what_has_no_cells_is_refused();
  void a_turned_object_gives_the_turned_answer_data() { objects(); }
  void a_turned_object_gives_the_turned_answer();
  void a_rigid_motion_strains_nothing_data() { objects(true); }
  void a_rigid_motion_strains_nothing();
  void a_handle_of_many_turns_the_object_data() { objects(); }
  void a_handle_of_many_turns_the_object();
  void a_cut_removes_its_cells_data() { objects(); }
  void a_cut_removes_its_cells();
  void the_answer_does_not_depend_on_the_start_data() { objects(); }
  void the_answer_does_not_depend_on_the_start();
  void cancelling_keeps_the_last_answer_data() { objects(true); }
  void cancelling_keeps_the_last_answer();

 private:
  static void dimensions();
  static void objects(bool wrinkles = false);
};

namespace {

constexpr std::array methods{Algorithm::corotational, Algorithm::arap,         Algorithm::xpbd,
                             Algorithm::projective,   Algorithm::quasi_newton, Algorithm::neo_hookean_xpbd};

enum class Object { sheet, solid, surface };

MeshPointer make(Object object) {
  switch (object) {
    case Object::sheet:
      return jittered(make_mesh(MeshKind::cloth, {4, 4, 1}));
    case Object::solid:
      return jittered(make_mesh(MeshKind::tetra, {3, 3, 3}));
    default:
      return jittered(make_mesh(MeshKind::cloth, {5, 4, 1}, 3));
  }
}

MeshPointer turned(const Mesh& mesh, const Eigen::Matrix3d& turn) {
  MeshParts parts = parts_of(mesh);
  for (Point& at : parts.rest) {
    at = turn * at;
  }
  return build_mesh(std::move(parts));
}

Eigen::Matrix3d turn_by(double degrees, const Mesh& mesh) {
  const Point axis = mesh.space_dimension == 2 ? Point(0, 0, 1) : Point(Point(1, 2, 2) / 3);
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
}

/// Moves the last element by a vector of the space.
void drag(ElasticSolver& solver, const Mesh& mesh, const Point& by) {
  solver.hold(ElasticHandle::of(mesh.element_count() - 1));
  solver.move(ElasticMotion::by(std::span(by.data(), std::size_t(mesh.space_dimension))));
}

const Point far{0.5, 0.6, -0.3};

/// The three elements with the lowest x: they do not lie on one line.
std::vector<ElementId> first_column(const Mesh& mesh) { return layer(mesh, *find_side("left")); }

/// Pins that hold a surface in space as well, which has only one layer.
std::vector<ElementId> pins_of(const Mesh& mesh) {
  return mesh.space_dimension == 3 && mesh.tetrahedra.empty() ? std::vector<ElementId>{0, 1, 2, 5, 6, 10, 15}
                                                              : first_column(mesh);
}

/// The minimum of an energy of the displacements of all elements, with pins and the last element where they are.
std::vector<double> least(const Mesh& mesh, const ElasticProblem& problem, const Point& by,
                          const std::function<double(const std::vector<double>&)>& energy) {
  const auto n = std::size_t(mesh.space_dimension);
  std::vector<double> all(mesh.rest.size(), 0.0);
  std::copy_n(by.data(), n, all.end() - std::ptrdiff_t(n));
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i + n < all.size(); ++i) {
    if (!std::ranges::binary_search(problem.pins, ElementId(i / n))) {
      free.push_back(i);
    }
  }
  const auto with = [&](const Eigen::VectorXd& unknown) {
    std::vector<double> whole = all;
    for (std::size_t i = 0; i < free.size(); ++i) {
      whole[free[i]] = unknown[Eigen::Index(i)];
    }
    return whole;
  };
  return with(plain_minimum([&](const Eigen::VectorXd& unknown) { return energy(with(unknown)); },
                            Eigen::VectorXd::Zero(Eigen::Index(free.size()))));
}

/// Deformation gradient and volume of a triangle or tetrahedron.
struct Shape {
  Eigen::MatrixXd deformation;
  double volume = 0;
};
template <class Corners>
Shape shape_of(const Mesh& mesh, const Corners& corners, const std::vector<double>& displacements) {
  const int n = mesh.space_dimension;
  Eigen::MatrixXd rest(n, n), now(n, n);
  for (int column = 0; column < n; ++column) {
    for (int k = 0; k < n; ++k) {
      const std::size_t to = std::size_t(corners[std::size_t(column) + 1] * ElementId(n) + ElementId(k)),
                        from = std::size_t(corners[0] * ElementId(n) + ElementId(k));
      rest(k, column) = mesh.rest[to] - mesh.rest[from];
      now(k, column) = rest(k, column) + displacements[to] - displacements[from];
    }
  }
  return {now * rest.inverse(), std::abs(rest.determinant()) / (n == 3 ? 6 : 2)};
}

/// Calls visit(Shape) for each cell.
template <class Visit>
void for_each_shape(const Mesh& mesh, const std::vector<double>& displacements, Visit visit) {
  for (const auto& corners : mesh.tetrahedra) {
    visit(shape_of(mesh, corners, displacements));
  }
  for (const auto& corners : mesh.triangles) {
    if (mesh.tetrahedra.empty()) {
      visit(shape_of(mesh, corners, displacements));
    }
  }
}

/// Calls visit(first, second, sum of the volumes of the cells at this edge) for each edge.
template <class Visit>
void for_each_edge(const Mesh& mesh, Visit visit) {
  std::map<std::array<ElementId, 2>, double> volumes;
  const auto add = [&](const auto& corners) {
    const double volume = shape_of(mesh, corners, std::vector<double>(mesh.rest.size())).volume;
    for (std::size_t a = 0; a < corners.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        volumes[{std::min(corners[a], corners[b]), std::max(corners[a], corners[b])}] += volume;
      }
    }
  };
  std::ranges::for_each(mesh.tetrahedra, add);
  if (mesh.tetrahedra.empty()) {
    std::ranges::for_each(mesh.triangles, add);
  }
  for (const auto& [edge, volume] : volumes) {
    visit(edge[0], edge[1], volume);
  }
}

/// The energy of springs whose stiffness is `modulus` times the volume at the edge over the square of its length.
double spring_energy(const Mesh& mesh, double modulus, const std::vector<double>& displacements) {
  double sum = 0;
  for_each_edge(mesh, [&](ElementId a, ElementId b, double volume) {
    const auto n = std::size_t(mesh.space_dimension);
    const Point rest = mesh.rest_position(b) - mesh.rest_position(a);
    const Point now = rest + mesh.to_point(displacements.data() + b * n) - mesh.to_point(displacements.data() + a * n);
    const double longer = now.norm() - rest.norm();
    sum += modulus * volume / rest.squaredNorm() * longer * longer / 2;
  });
  return sum;
}

/// Lamé's parameters of a solid, or of a sheet in plane stress.
struct Moduli {
  double mu = 0, lambda = 0;
};
Moduli moduli(const Mesh& mesh, double young, double poisson) {
  return {young / (2 * (1 + poisson)), mesh.space_dimension == 2
                                           ? young * poisson / (1 - poisson * poisson)
                                           : young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// Stable neo-Hookean elasticity, in plane stress for a sheet. Its second parameter is λ + μ, so that small strains
/// have the material's.
std::function<double(const std::vector<double>&)> stable_neo_hookean(const Mesh& mesh, double poisson) {
  const Moduli material = moduli(mesh, 3, poisson);
  return
      [&mesh, mu = material.mu, of_volume = material.lambda + material.mu](const std::vector<double>& displacements) {
        double sum = 0;
        for_each_shape(mesh, displacements, [&](const Shape& shape) {
          const double beyond = shape.deformation.determinant() - 1 - mu / of_volume;
          sum += shape.volume / 2 * (mu * shape.deformation.squaredNorm() + of_volume * beyond * beyond);
        });
        return sum;
      };
}

/// The closest rotation, by singular values.
Eigen::MatrixXd rotation_of(const Eigen::MatrixXd& deformation) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(deformation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::MatrixXd left = svd.matrixU();
  if ((left * svd.matrixV().transpose()).determinant() < 0) {
    left.col(left.cols() - 1) *= -1;
  }
  return left * svd.matrixV().transpose();
}

/// The distance from the least energy is in proportion to the square of the time step.
template <class Make>
void rests_nearer_with_smaller_steps(const Mesh& mesh, const std::vector<double>& exact, Make make_solver) {
  std::vector<double> apart;
  for (const double square : {0.08, 0.02, 0.005}) {
    const auto solver = make_solver(XpbdStep{.springs_over_inertia = square});
    drag(*solver, mesh, far);
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    apart.push_back(largest_step(solver->displacements(), exact));
  }
  for (std::size_t i = 1; i < apart.size(); ++i) {
    const double ratio = apart[i] / apart[i - 1];
    QVERIFY2(ratio > 0.2 && ratio < 0.3, qPrintable(QString::number(ratio)));
  }
  QVERIFY2(apart.back() < 2e-3, qPrintable(QString::number(apart.back())));
}

}  // namespace

void ContestantsTest::dimensions() {
  QTest::addColumn<int>("object");
  QTest::newRow("sheet") << int(Object::sheet);
  QTest::newRow("solid") << int(Object::solid);
}

/// XPBD and Projective Dynamics make a surface in space wrinkle like cloth, in many ways that are about as good. So the
/// tests that need one answer leave it out.
void ContestantsTest::objects(bool wrinkles) {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("object");
  for (const Algorithm method : methods) {
    for (const Object object : {Object::sheet, Object::solid, Object::surface}) {
      const bool is_cloth = object == Object::surface && method != Algorithm::arap;
      if (fits(method, *make(object)) && (wrinkles || !is_cloth)) {
        QTest::addRow("method %d, object %d", int(method), int(object)) << int(method) << int(object);
      }
    }
  }
}

/// The energy of Sifakis and Barbič (2012), in plane stress for a sheet.
void ContestantsTest::corotational_is_at_the_least_energy() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  constexpr double poisson = 0.35;
  const auto [mu, lambda] = moduli(*mesh, 3, poisson);
  const ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
  const auto solver = make_elastic(Algorithm::corotational, problem);
  drag(*solver, *mesh, far);
  QVERIFY2(solver->remark().empty(), solver->remark().c_str());
  const auto energy = [&, mu = mu, lambda = lambda](const std::vector<double>& displacements) {
    double sum = 0;
    for_each_shape(*mesh, displacements, [&](const Shape& shape) {
      const Eigen::MatrixXd rotation = rotation_of(shape.deformation);
      const double longer = (rotation.transpose() * shape.deformation).trace() - double(rotation.rows());
      sum += shape.volume * (mu * (shape.deformation - rotation).squaredNorm() + lambda / 2 * longer * longer);
    });
    return sum;
  };
  const double apart = largest_step(solver->displacements(), least(*mesh, problem, far, energy));
  QVERIFY2(apart < 1e-6, qPrintable(QString::number(apart)));
}

void ContestantsTest::quasi_newton_is_at_the_least_energy() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  for (const double poisson : {0.0, 0.4}) {
    const ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
    const auto solver = make_elastic(Algorithm::quasi_newton, problem);
    drag(*solver, *mesh, far);
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    const auto exact = least(*mesh, problem, far, stable_neo_hookean(*mesh, poisson));
    const double apart = largest_step(solver->displacements(), exact);
    QVERIFY2(apart < 1e-6, qPrintable(QString::number(apart)));
  }
}

/// The springs take the material's λ, or 3/4 of its μ if that is less, and the cells the rest of μ.
void ContestantsTest::projective_is_at_the_least_energy() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  for (const double poisson : {0.1, 0.35}) {
    const auto [mu, lambda] = moduli(*mesh, 3, poisson);
    const double of_springs = std::min(lambda, 0.75 * mu), of_cells = mu - of_springs;
    const ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
    const auto solver = make_elastic(Algorithm::projective, problem);
    drag(*solver, *mesh, far);
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    const auto energy = [&](const std::vector<double>& displacements) {
      double sum = spring_energy(*mesh, (mesh->space_dimension == 3 ? 2.5 : 8.0 / 3) * of_springs, displacements);
      for_each_shape(*mesh, displacements, [&](const Shape& shape) {
        sum += shape.volume * of_cells * (shape.deformation - rotation_of(shape.deformation)).squaredNorm();
      });
      return sum;
    };
    const double apart = largest_step(solver->displacements(), least(*mesh, problem, far, energy));
    QVERIFY2(apart < 1e-6, qPrintable(QString::number(apart)));
  }
}

/// Springs have the material's μ; what they lack of λ is the resistance of the volumes. One iteration per time step
/// does not meet all constraints, so the object rests beside the least energy, by an error in proportion to the square
/// of the step.
void ContestantsTest::xpbd_rests_near_the_least_energy() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  for (const double poisson : {0.1, 0.4}) {
    const auto [mu, lambda] = moduli(*mesh, 3, poisson);
    const double of_volumes = std::max(0.0, lambda - mu);
    ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
    problem.options.iterations = 100'000;
    const auto energy = [&, mu = mu](const std::vector<double>& displacements) {
      double sum = spring_energy(*mesh, (mesh->space_dimension == 3 ? 2.5 : 8.0 / 3) * mu, displacements);
      for_each_shape(*mesh, displacements, [&](const Shape& shape) {
        const double larger = shape.deformation.determinant() - 1;
        sum += of_volumes * shape.volume * larger * larger / 2;
      });
      return sum;
    };
    const auto exact = least(*mesh, problem, far, energy);
    const auto make_solver = [&](const XpbdStep& step) { return make_xpbd(problem, step, {}); };
    rests_nearer_with_smaller_steps(*mesh, exact, make_solver);
    if (QTest::currentTestFailed()) {
      return;
    }
  }
}

/// One element between a pin and the handle: its way, step by step, by hand. Both springs are equal, so that each takes
/// the share κ / (κ + 1) of what it is too long or too short, with κ = h² k / m.
void ContestantsTest::xpbd_swings() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {3, 1, 1});
  ElasticProblem problem = pinned(mesh, {0});
  problem.options.iterations = 1;
  const XpbdStep step;
  const auto solver = make_xpbd(problem, step, {});
  solver->hold(ElasticHandle::of(2));
  constexpr double by = 0.3;
  const double share = step.springs_over_inertia / (step.springs_over_inertia + 1);
  double at = 0, velocity = 0, furthest = 0;
  for (int i = 0; i < 60; ++i) {
    solver->move(ElasticMotion::by(std::array{by}));
    const double free = at + (1 - step.damping) * velocity;
    const double after = (1 - share) * (1 - share) * free + share * by;
    velocity = after - at;
    at = after;
    furthest = std::max(furthest, at);
    QVERIFY2(std::abs(solver->displacements()[1] - at) < 1e-12, qPrintable(QString::number(i)));
  }
  QVERIFY(furthest > at + 0.01);  // it swings beyond where it comes to rest
}

/// A stretched sheet of a material that hardly changes its volume, with the usual time step.
void ContestantsTest::xpbd_comes_to_rest() {
  const MeshPointer mesh = generate({MeshKind::cloth, {32, 32, 1}});
  for (const double poisson : {0.3, 0.45}) {
    ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
    problem.options.iterations = 20'000;
    const auto solver = make_elastic(Algorithm::xpbd, problem);
    drag(*solver, *mesh, far);
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    for (const double displacement : solver->displacements()) {
      QVERIFY(std::abs(displacement) < 2 * far.norm());
    }
  }
}

namespace {

/// Compares both constraints of a simplex with their definitions, and their derivatives with central differences.
template <int N>
double error_of_gradients(std::mt19937_64& random) {
  using Square = Eigen::Matrix<double, N, N>;
  using Corners = Eigen::Matrix<double, N, N + 1>;
  Corners rest, now;
  for (int i = 0; i < rest.size(); ++i) {
    rest(i) = uniform(random, -1, 1);
    now(i) = uniform(random, -1, 1);
  }
  const auto edges_of = [](const Corners& corners) {
    return Square(corners.template rightCols<N>().colwise() - corners.col(0));
  };
  const Square inverse = edges_of(rest).inverse();
  const auto constraints = [&](const Corners& corners) {
    const Square f = edges_of(corners) * inverse;
    return std::array{std::sqrt((f.transpose() * f).trace()), f.determinant()};
  };
  const auto fixed = [](const Square& square) { return FixedMatrix<double, N, N>::from(square.data()); };
  const NeoHookeanConstraints<N> found(fixed(edges_of(now)), fixed(inverse.transpose()));
  const auto [shape, volume] = constraints(now);
  const double scale = 1 + inverse.norm() + std::pow(inverse.norm(), N);
  double worst = std::max(std::abs(std::sqrt(found.shape) - shape), std::abs(found.volume - volume)) / scale;
  constexpr double by = 1e-6;
  for (int i = 0; i < now.size(); ++i) {
    Corners above = now, below = now;
    above(i) += by;
    below(i) -= by;
    const auto [shape_above, volume_above] = constraints(above);
    const auto [shape_below, volume_below] = constraints(below);
    const double of_shape = found.by_shape[i] / shape - (shape_above - shape_below) / (2 * by);
    const double of_volume = found.by_volume[i] - (volume_above - volume_below) / (2 * by);
    worst = std::max({worst, std::abs(of_shape) / scale, std::abs(of_volume) / scale});
  }
  return worst;
}

}  // namespace

void ContestantsTest::neo_hookean_constraints_have_their_gradients() {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100; ++i) {
    for (const double error : {error_of_gradients<2>(random), error_of_gradients<3>(random)}) {
      QVERIFY2(error < 1e-8, qPrintable(QString::number(error)));
    }
  }
}

/// The distance from the least energy is in proportion to the square of the time step, as that of XPBD.
void ContestantsTest::neo_hookean_xpbd_rests_near_the_least_energy() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  for (const double poisson : {0.0, 0.1, 0.4}) {
    ElasticProblem problem = pinned(mesh, first_column(*mesh), poisson);
    problem.options.iterations = 100'000;
    const auto exact = least(*mesh, problem, far, stable_neo_hookean(*mesh, poisson));
    const auto make_solver = [&](const XpbdStep& step) { return make_neo_hookean_xpbd(problem, step, {}); };
    rests_nearer_with_smaller_steps(*mesh, exact, make_solver);
    if (QTest::currentTestFailed()) {
      return;
    }
  }
}

/// Half the width of the object in one move, into it, across it and out of it, and back: inverted cells recover.
void ContestantsTest::neo_hookean_xpbd_survives_far_moves() {
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  const double width = mesh->box[1].x() - mesh->box[0].x();
  for (const Point& direction : {Point(-1, 0, 0), Point(0, -1, 0), Point(1, 0, 0), Point(-0.6, -0.8, 0)}) {
    const auto solver = make_elastic(Algorithm::neo_hookean_xpbd, pinned(mesh, first_column(*mesh), 0.45));
    drag(*solver, *mesh, width / 2 * direction);
    const std::string& remark = solver->remark();
    QVERIFY2(remark.empty() || remark.starts_with("it did not converge") || remark.starts_with("it diverged"),
             remark.c_str());
    for (const double displacement : solver->displacements()) {
      QVERIFY(std::abs(displacement) < 2 * width);  // so it is a number
    }
    for (int again = 0; again == 0 || (again < 100 && !solver->remark().empty()); ++again) {
      drag(*solver, *mesh, Point::Zero());
    }
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    QVERIFY(std::ranges::all_of(solver->displacements(), [](double one) { return std::abs(one) < 1e-6; }));
  }
}

void ContestantsTest::neo_hookean_xpbd_refuses_surfaces_in_space() {
  try {
    check(Algorithm::neo_hookean_xpbd, *make(Object::surface));
    QFAIL("it accepts a surface in space");
  } catch (const Error& error) {
    QVERIFY2(QString(error.what()).contains("the object has no tetrahedra or hexahedra, so it is not a solid"),
             error.what());
  }
}

void ContestantsTest::too_few_iterations_are_told_data() {
  QTest::addColumn<int>("method");
  QTest::newRow("corotational FEM") << int(Algorithm::corotational);
  QTest::newRow("ARAP") << int(Algorithm::arap);
  QTest::newRow("XPBD") << int(Algorithm::xpbd);
  QTest::newRow("quasi-Newton FEM") << int(Algorithm::quasi_newton);
  QTest::newRow("neo-Hookean XPBD") << int(Algorithm::neo_hookean_xpbd);
  QTest::newRow("Projective Dynamics") << int(Algorithm::projective);
}

/// The handle and the pins are at their positions all the same, and the next move goes on from there.
void ContestantsTest::too_few_iterations_are_told() {
  QFETCH(const int, method);
  const MeshPointer mesh = make(Object::solid);
  ElasticProblem problem = pinned(mesh, first_column(*mesh));
  problem.options.iterations = 3;
  const auto solver = make_elastic(Algorithm(method), problem);
  drag(*solver, *mesh, far);
  QVERIFY2(QString::fromStdString(solver->remark()).startsWith("it did not converge in 3 iterations: elements still"),
           solver->remark().c_str());
  QVERIFY(solver->reached());
  for (std::size_t k = 0; k < 3; ++k) {
    QCOMPARE(solver->displacements()[solver->displacements().size() - 3 + k], far[Eigen::Index(k)]);
    QCOMPARE(solver->displacements()[k], 0.0);
  }
  for (int again = 0; again < 2000 && !solver->remark().empty(); ++again) {
    drag(*solver, *mesh, far);
  }
  QVERIFY(solver->remark().empty());
  const auto patient = make_elastic(Algorithm(method), pinned(mesh, problem.pins));
  drag(*patient, *mesh, far);
  QVERIFY(largest_step(solver->displacements(), patient->displacements()) < 1e-6);
}

void ContestantsTest::what_has_no_cells_is_refused() {
  const MeshPointer chain = make_mesh(MeshKind::line, {9, 1, 1}, 3), solid = make(Object::solid);
  for (const Algorithm method : {Algorithm::arap, Algorithm::xpbd, Algorithm::projective}) {
    QVERIFY(!fits(method, *chain));
    try {
      check(method, *chain);
    } catch (const Error& error) {
      QVERIFY(QString(error.what()).contains("the object has no faces or cells; use a mesh with faces"));
    }
    QVERIFY_THROWS_EXCEPTION(Error, make_elastic(method, pinned(solid, {})));
    QVERIFY_THROWS_EXCEPTION(Error, make_elastic(method, pinned(solid, {0, 1})));  // free to turn
    QVERIFY(fits(method, *make_mesh(MeshKind::line, {9, 1, 1})));
    QVERIFY(fits(method, *make_mesh(MeshKind::block, {3, 3, 3})));
  }
}

void ContestantsTest::a_turned_object_gives_the_turned_answer() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  const auto solver = make_elastic(Algorithm(method), pinned(mesh, pins_of(*mesh)));
  Point by = far;
  by.tail(3 - mesh->space_dimension).setZero();
  drag(*solver, *mesh, by);
  QVERIFY2(solver->remark().empty(), solver->remark().c_str());
  for (const double degrees : {45.0, 90.0}) {
    const Eigen::Matrix3d turn = turn_by(degrees, *mesh);
    const MeshPointer other = turned(*mesh, turn);
    const auto of_turned = make_elastic(Algorithm(method), pinned(other, pins_of(*mesh)));
    drag(*of_turned, *other, turn * by);
    QVERIFY(of_turned->remark().empty());
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      const Point expected = turn * mesh->to_point(solver->displacements().data() + e * mesh->space_dimension);
      const Point found = mesh->to_point(of_turned->displacements().data() + e * mesh->space_dimension);
      QVERIFY2((found - expected).norm() < 1e-6, qPrintable(QString::number((found - expected).norm())));
    }
  }
}

void ContestantsTest::a_rigid_motion_strains_nothing() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  for (const double degrees : {0.0, 30.0, 90.0, 170.0}) {
    const Eigen::Matrix3d turn = turn_by(degrees, *mesh);
    Point by(1, -2, 0.5);
    by.tail(3 - mesh->space_dimension).setZero();
    const Field field = [&](const Point& at) { return Point(turn * at + by - at); };
    const auto solver = make_elastic(Algorithm(method), pinned(mesh, pins_of(*mesh), field, 0.3));
    const double of_pins = furthest_from(*mesh, solver->displacements(), field);
    QVERIFY2(of_pins < 1e-7, qPrintable(QString("%1 at %2 degrees").arg(of_pins).arg(degrees)));
    drag(*solver, *mesh, field(mesh->rest_position(mesh->element_count() - 1)));
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    QVERIFY(furthest_from(*mesh, solver->displacements(), field) < 1e-7);
  }
}

/// Elements that are bound to the handle and no pin turn with it.
void ContestantsTest::a_handle_of_many_turns_the_object() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  const auto n = std::size_t(mesh->space_dimension);
  const auto solver = make_elastic(Algorithm(method), pinned(mesh, pins_of(*mesh)));
  ElasticHandle handle;
  for (ElementId e = mesh->element_count(); handle.elements.size() < 3; --e) {
    if (!std::ranges::binary_search(pins_of(*mesh), e - 1)) {
      handle.elements.insert(handle.elements.begin(), e - 1);
    }
  }
  const Point pivot = mesh->rest_position(handle.elements[1]);
  for (const ElementId element : handle.elements) {
    const Point arm = mesh->rest_position(element) - pivot;
    handle.arms.insert(handle.arms.end(), arm.data(), arm.data() + n);
    handle.displacements.insert(handle.displacements.end(), n, 0.0);
  }
  const Eigen::Matrix3d turn = turn_by(12, *mesh) - Eigen::Matrix3d::Identity();
  const auto size = Eigen::Index(n);
  solver->hold(handle);
  solver->move({SmallMatrix(turn.topLeftCorner(size, size)), SmallVector(Point(0.2, 0.1, 0.1).head(size))});
  QVERIFY2(solver->remark().empty(), solver->remark().c_str());
  for (const ElementId element : handle.elements) {
    const Point arm = mesh->rest_position(element) - pivot, expected = turn * arm + Point(0.2, 0.1, 0.1);
    for (std::size_t k = 0; k < n; ++k) {
      QVERIFY(std::abs(solver->displacements()[element * n + k] - expected[Eigen::Index(k)]) < 1e-15);
    }
  }
  for (const ElementId pin : pins_of(*mesh)) {
    for (std::size_t k = 0; k < n; ++k) {
      QCOMPARE(solver->displacements()[pin * n + k], 0.0);
    }
  }
  solver->reset();
  QVERIFY(std::ranges::all_of(solver->displacements(), [](double one) { return one == 0; }));
}

/// A cut link leaves the answer of the same object without the cells at that link.
void ContestantsTest::a_cut_removes_its_cells() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  ElasticProblem problem = pinned(mesh, pins_of(*mesh));
  const ElementId last = mesh->element_count() - 1, before = last - 1;
  problem.cuts.cut(*find_link(*mesh, before, last));
  MeshParts parts = parts_of(*mesh);
  const auto has_link = [&](const auto& cell) {
    return std::ranges::count(cell, before) + std::ranges::count(cell, last) == 2;
  };
  std::erase_if(parts.triangles, has_link);
  std::erase_if(parts.tetrahedra, has_link);
  const MeshPointer without = build_mesh(std::move(parts));
  const auto cut = make_elastic(Algorithm(method), problem);
  const auto expected = make_elastic(Algorithm(method), pinned(without, problem.pins));
  const auto whole = make_elastic(Algorithm(method), pinned(mesh, problem.pins));
  for (ElasticSolver* one : {cut.get(), expected.get(), whole.get()}) {
    drag(*one, *mesh, far);
  }
  QVERIFY(largest_step(cut->displacements(), expected->displacements()) < 1e-7);
  QVERIFY(largest_step(cut->displacements(), whole->displacements()) > 1e-3);
}

void ContestantsTest::the_answer_does_not_depend_on_the_start() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  const ElasticProblem problem = pinned(mesh, pins_of(*mesh));
  const auto fresh = make_elastic(Algorithm(method), problem);
  drag(*fresh, *mesh, far);
  const auto other = make_elastic(Algorithm(method), problem);
  std::mt19937_64 random(5);
  std::vector<double> from(mesh->rest.size());
  for (double& one : from) {
    one = uniform(random, -0.1, 0.1);
  }
  other->start_from(from);
  drag(*other, *mesh, far);
  const double apart = largest_step(fresh->displacements(), other->displacements());
  QVERIFY2(apart < 1e-6, qPrintable(QString::number(apart)));
}

void ContestantsTest::cancelling_keeps_the_last_answer() {
  QFETCH(const int, method);
  QFETCH(const int, object);
  const MeshPointer mesh = make(Object(object));
  const auto solver = make_elastic(Algorithm(method), pinned(mesh, pins_of(*mesh)));
  drag(*solver, *mesh, far);
  const std::vector<double> answer = solver->displacements();
  const Progress job = Progress::watched();
  job.cancel();
  const auto n = std::size_t(mesh->space_dimension);
  QVERIFY_THROWS_EXCEPTION(Cancelled, solver->move(ElasticMotion::by(std::span(far.data(), n)), job));
  QVERIFY(solver->displacements() == answer);
  QVERIFY_THROWS_EXCEPTION(Cancelled, make_elastic(Algorithm(method), pinned(mesh, pins_of(*mesh)), job));
}

CHAINMAIL_TEST(ContestantsTest)

}  // namespace chainmail::test_contestants

#include "test_contestants.moc"
