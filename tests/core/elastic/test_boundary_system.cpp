#include <Eigen/Dense>
#include <QtTest>

#include "core/elastic/elastic_problems.h"
#include "core/pinned.h"
#include "core/spheres.h"
#include "elastic/boundary_system.h"
#include "program.h"

namespace chainmail::test_boundary_system {

using namespace chainmail::test;

namespace {

constexpr double poisson = 0.3;

/// The integrals by their definition: the sum of the kernels at the centres of smaller and smaller parts of a facet.
KelvinIntegrals summed(const Facet& facet, const Point& point, int depth) {
  if (depth == 0) {
    const Point r = facet.centroid - point;
    return {facet.area * kelvin_displacement(r, poisson), facet.area * kelvin_traction(r, facet.normal, poisson)};
  }
  const auto& [a, b, c] = facet.corner;
  const Point ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
  KelvinIntegrals sum{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const auto& part :
       {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
    const auto [displacement, traction] = summed(Facet(part), point, depth - 1);
    sum.displacement += displacement;
    sum.traction += traction;
  }
  return sum;
}

std::vector<Facet> facets_of(const MeshParts& parts) {
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : parts.triangles) {
    facets.emplace_back(std::array{parts.rest[a], parts.rest[b], parts.rest[c]});
  }
  return facets;
}

Eigen::VectorXd at_facets(const std::vector<Facet>& facets, const std::function<Point(const Facet&)>& field) {
  Eigen::VectorXd values(Eigen::Index(3 * facets.size()));
  for (std::size_t i = 0; i < facets.size(); ++i) {
    values.segment<3>(Eigen::Index(3 * i)) = field(facets[i]);
  }
  return values;
}

/// Returns the tractions that cause a displacement of the whole surface.
Eigen::VectorXd tractions_for(const std::vector<Facet>& facets, const std::function<Point(const Facet&)>& field) {
  const BoundarySystem system(facets, std::vector<bool>(facets.size(), true), poisson);
  return system.solve(at_facets(facets, field)).tractions;
}

/// Returns the largest error of displacements over the largest displacement. Tractions are given on most facets, and
/// displacements where x, y and z are all above 0, so that the body cannot move as a whole.
double error_under(const std::vector<Facet>& facets, const std::function<Point(const Facet&)>& displacement,
                   const std::function<Point(const Facet&)>& traction) {
  std::vector<bool> known;
  known.reserve(facets.size());
  for (const Facet& facet : facets) {
    known.push_back(facet.centroid.minCoeff() > 0);
  }
  const BoundarySystem system(facets, known, poisson);
  std::size_t i = 0;
  const auto fields = system.solve(
      at_facets(facets, [&](const Facet& facet) { return known[i++] ? displacement(facet) : traction(facet); }));
  const Eigen::VectorXd right = at_facets(facets, displacement);
  return (fields.displacements - right).norm() / right.norm();
}

/// The shear modulus for Young's modulus 1: tractions are divided by it.
constexpr double shear_modulus = 1 / (2 * (1 + poisson));

}  // namespace

/// Checks the equations of boundary elements against known solutions.
class BoundarySystemTest : public QObject {
  Q_OBJECT

 private slots:
  void kernels_obey_hookes_law();
  void integrals_are_those_of_the_kernels();
  void a_point_force_is_balanced();
  void the_factors_solve_and_can_be_cancelled();
  void a_rigid_motion_takes_no_tractions();
  void a_uniform_strain_takes_its_tractions();
  void a_sphere_under_pressure_converges();
  void a_hollow_sphere_under_pressure_converges();
};

/// Checks the traction kernel against differences of the displacement kernel.
void BoundarySystemTest::kernels_obey_hookes_law() {
  const Point r(0.7, -0.4, 0.9), normal = Point(1, 2, -0.5).normalized();
  const double lambda = 2 * poisson / (1 - 2 * poisson), step = 1e-5;
  for (int force = 0; force < 3; ++force) {
    Eigen::Matrix3d gradient;
    for (int j = 0; j < 3; ++j) {
      const Point ahead = r + step * Point::Unit(j), behind = r - step * Point::Unit(j);
      const Eigen::Matrix3d change = kelvin_displacement(ahead, poisson) - kelvin_displacement(behind, poisson);
      gradient.col(j) = change.row(force) / (2 * step);
    }
    const Eigen::Matrix3d stress =
        lambda * gradient.trace() * Eigen::Matrix3d::Identity() + gradient + gradient.transpose();
    // The error of differences is the square of their step.
    QVERIFY((stress * normal - kelvin_traction(r, normal, poisson).row(force).transpose()).norm() < 1e-9);
  }
}

void BoundarySystemTest::integrals_are_those_of_the_kernels() {
  const Facet facet({Point(0, 0, 0), Point(1, 0.1, 0.2), Point(0.3, 0.9, -0.1)});
  const Point& normal = facet.normal;
  const Point beside = facet.corner[0] - 0.3 * facet.along[0];  // in the plane, in line with an edge
  for (const Point& point :
       {Point(0.2, 0.3, 0.5), Point(0.5, 0.4, -0.3), Point(3, 2, -1), Point(40, -60, 20), beside}) {
    const auto [displacement, traction] = integrate_kelvin(facet, point, poisson);
    const auto sum = summed(facet, point, 6);
    // The error of the sums is the square of their parts' size, 1 / 64, over the distance.
    QVERIFY((displacement - sum.displacement).norm() < 5e-4 * displacement.norm());
    QVERIFY((traction - sum.traction).norm() < 5e-4 * traction.norm());
  }
  // On the facet, the displacement is continuous, and the traction jumps by the force.
  const auto on = integrate_kelvin(facet, facet.centroid, poisson);
  const auto above = integrate_kelvin(facet, facet.centroid + 1e-7 * normal, poisson);
  const auto below = integrate_kelvin(facet, facet.centroid - 1e-7 * normal, poisson);
  QVERIFY((on.displacement - above.displacement).norm() < 1e-6);
  QVERIFY((on.displacement - below.displacement).norm() < 1e-6);
  QVERIFY((above.traction - below.traction - Eigen::Matrix3d::Identity()).norm() < 1e-6);
}

/// The tractions on a closed surface balance a force inside it, and are in balance with themselves if the force is
/// outside. This is exact for any facets, and the diagonal of the equations relies on it.
void BoundarySystemTest::a_point_force_is_balanced() {
  const auto facets = facets_of(sphere_parts(2));
  const auto carried = [&](const Point& force) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Facet& facet : facets) {
      sum += integrate_kelvin(facet, force, poisson).traction;
    }
    return sum;
  };
  for (const Point& inside : {Point(0, 0, 0), Point(0.3, -0.4, 0.2), Point(0, 0.99, 0)}) {
    QVERIFY((carried(inside) + Eigen::Matrix3d::Identity()).norm() < 1e-12);
  }
  for (const Point& outside : {Point(0, 1.01, 0), Point(3, 1, -2), Point(100, 0, 0)}) {
    QVERIFY(carried(outside).norm() < 1e-12);
  }
}

void BoundarySystemTest::the_factors_solve_and_can_be_cancelled() {
  std::mt19937_64 random(3);
  for (const Eigen::Index size : {1, 5, 128, 129, 300}) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return uniform(random, -1, 1); });
    const Eigen::MatrixXd sides = Eigen::MatrixXd::NullaryExpr(size, 2, [&] { return uniform(random, -1, 1); });
    Eigen::MatrixXd answers = sides;
    DenseLu(Eigen::MatrixXd(matrix)).solve(answers);
    QVERIFY((matrix * answers - sides).norm() < 1e-10 * (1 + answers.norm()));
  }
  QVERIFY(QString::fromStdString(refusal([] { DenseLu(Eigen::MatrixXd::Zero(3, 3)); })).contains("no single answer"));
  const Progress job = Progress::watched();
  job.cancel();
  QVERIFY_EXCEPTION_THROWN(DenseLu(Eigen::MatrixXd::Random(300, 300), job), Cancelled);
}

void BoundarySystemTest::a_rigid_motion_takes_no_tractions() {
  std::vector<double> sizes, errors;
  for (const int n : {2, 6}) {
    const auto facets = facets_of(sphere_parts(n));
    const auto moved = tractions_for(facets, [](const Facet&) { return Point(1, -2, 0.5); });
    QVERIFY(moved.cwiseAbs().maxCoeff() < 1e-10);  // condition number of the equations times rounding
    const auto turned =
        tractions_for(facets, [](const Facet& facet) { return Point(-facet.centroid.y(), facet.centroid.x(), 0); });
    sizes.push_back(1.0 / n);
    errors.push_back(turned.norm() / std::sqrt(double(facets.size())));
  }
  qInfo() << "tractions of a turn: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 0.8);
}

/// With constant elements, the error of a uniform strain shrinks in proportion to their size.
void BoundarySystemTest::a_uniform_strain_takes_its_tractions() {
  Eigen::Matrix3d strain;
  strain << 0.2, 0.05, -0.1, 0.05, -0.1, 0.08, -0.1, 0.08, 0.15;
  const double lambda = 2 * poisson / (1 - 2 * poisson);
  const Eigen::Matrix3d stress = lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2 * strain;
  std::vector<double> sizes, errors;
  for (const int n : {2, 6}) {
    const auto facets = facets_of(sphere_parts(n));
    const auto found = tractions_for(facets, [&](const Facet& facet) { return Point(strain * facet.centroid); });
    const auto right = at_facets(facets, [&](const Facet& facet) { return Point(stress * facet.normal); });
    sizes.push_back(1.0 / n);
    errors.push_back((found - right).norm() / right.norm());
  }
  qInfo() << "tractions of a uniform strain: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 0.8);
}

/// Solution of Lamé (1852): u = -p (1 - 2ν) r / E.
void BoundarySystemTest::a_sphere_under_pressure_converges() {
  std::vector<double> sizes, errors;
  for (const int n : {2, 6}) {
    sizes.push_back(1.0 / n);
    errors.push_back(error_under(
        facets_of(sphere_parts(n)), [](const Facet& facet) { return Point(-(1 - 2 * poisson) * facet.centroid); },
        [](const Facet& facet) { return Point(-facet.normal / shear_modulus); }));
  }
  qInfo() << "a sphere under pressure: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 0.8);
  QVERIFY(errors.back() < 0.05);
}

/// Solution of Lamé (1852): u = p a³ / (b³ - a³) ((1 - 2ν) r + (1 + ν) b³ / (2 r²)) / E for a pressure inside, radii a
/// to b.
void BoundarySystemTest::a_hollow_sphere_under_pressure_converges() {
  constexpr double inner = 0.5;
  const auto displacement = [](const Facet& facet) {
    const double r = facet.centroid.norm(), scale = std::pow(inner, 3) / (1 - std::pow(inner, 3));
    return Point(scale * ((1 - 2 * poisson) * r + (1 + poisson) / (2 * r * r)) * facet.centroid / r);
  };
  const auto traction = [](const Facet& facet) {
    return facet.centroid.norm() < 0.75 ? Point(-facet.normal / shear_modulus) : Point(Point::Zero());
  };
  std::vector<double> sizes, errors;
  for (const int n : {3, 6}) {
    MeshParts cavity = sphere_parts(n, inner);
    std::ranges::for_each(cavity.triangles, [](auto& triangle) { std::swap(triangle[0], triangle[1]); });
    sizes.push_back(1.0 / n);
    errors.push_back(error_under(facets_of(together(sphere_parts(n), cavity)), displacement, traction));
  }
  qInfo() << "a hollow sphere under pressure: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 0.8);
}

CHAINMAIL_TEST(BoundarySystemTest)

}  // namespace chainmail::test_boundary_system

#include "test_boundary_system.moc"
