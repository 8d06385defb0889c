#include <Eigen/Geometry>
#include <QtTest>
#include <numeric>

#include "elastic/energy.h"
#include "elastic/newton.h"
#include "elastic/stiffness.h"
#include "elastic_problems.h"
#include "mesh/cells.h"
#include "mesh/error.h"

using namespace chainmail;
using namespace chainmail::test;

/// Checks finite elements against known solutions of mechanics.
class ElasticTest : public QObject {
  Q_OBJECT

 private slots:
  void uniform_strain_is_exact_data();
  void uniform_strain_is_exact();
  void rigid_motion_costs_nothing();
  void stiffness_at_rest_is_that_of_textbooks();
  void derivatives_are_those_of_differences();
  void a_bent_sheet_converges();
  void a_bent_solid_converges();
  void a_cantilever_bends_as_beams_do();
  void small_moves_are_linear();
  void the_hand_and_the_pins_are_where_they_are();
};

namespace {

MeshPointer of_dimension(int dimension) {
  return dimension == 1   ? make_mesh(MeshKind::line, {6, 1, 1})
         : dimension == 2 ? jittered(make_mesh(MeshKind::cloth, {5, 4, 1}))
                          : jittered(make_mesh(MeshKind::tetra, {4, 4, 3}));
}

/// Returns random displacements of the corners of a simplex that do not invert it.
CornerDisplacements some_corners(int dimension, std::mt19937_64& random) {
  CornerDisplacements at(dimension, dimension + 1);
  for (double& one : at.reshaped()) {
    one = uniform(random, -0.08, 0.08);
  }
  return at;
}

}  // namespace

void ElasticTest::uniform_strain_is_exact_data() {
  QTest::addColumn<int>("dimension");
  QTest::addColumn<int>("method");
  for (const int dimension : {1, 2, 3}) {
    for (const ElasticMethod method : {ElasticMethod::linear_fem, ElasticMethod::neo_hookean}) {
      QTest::addRow("%dD, method %d", dimension, int(method)) << dimension << int(method);
    }
  }
}

/// The patch test: for any cells, the method finds a field that linear elements can represent.
void ElasticTest::uniform_strain_is_exact() {
  QFETCH(const int, dimension);
  QFETCH(const int, method);
  const MeshPointer mesh = of_dimension(dimension);
  Eigen::Matrix3d strain;
  strain << 0.2, -0.05, 0.1, 0.15, -0.1, 0.02, -0.07, 0.03, 0.12;
  const Field field = [&](const Point& at) { return Point(strain * at); };
  const auto solver = make_elastic(ElasticMethod(method), pinned(mesh, boundary(*mesh), field, 0.35));
  // Newton's method stops after a step below 1e-9 cells, and that step leaves a quadratically smaller error.
  const Field flat = [&](const Point& at) {
    Point to = field(at);
    for (int k = dimension; k < 3; ++k) {
      to[k] = 0;
    }
    return to;
  };
  const double error = furthest_from(*mesh, solver->displacements(), flat);
  QVERIFY2(error < 1e-10, qPrintable(QString::number(error)));
  QVERIFY(mesh->element_count() > boundary(*mesh).size());
}

void ElasticTest::rigid_motion_costs_nothing() {
  for (const int dimension : {2, 3}) {
    const MeshPointer mesh = of_dimension(dimension);
    const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
    Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (dimension == 3) {
      turn = turn * Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized());
    }
    std::vector<double> displacements;
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      const Point at = mesh->rest_position(e), to = turn * at + Point(4, -2, 0);
      for (int k = 0; k < dimension; ++k) {
        displacements.push_back(to[k] - at[k]);
      }
    }
    const Newton newton(simplices, lame({3, 0.4}), mesh->element_count(), {}, {});
    // Young's modulus is 3 and the object a few units large, so these are roundings.
    QVERIFY(std::abs(newton.energy(displacements)->value) < 1e-12);
    for (const double force : newton.gradient(displacements)) {
      QVERIFY(std::abs(force) < 1e-12);
    }
    // A linear material resists no infinitesimal rotation: K (ω × x) = 0.
    for (std::size_t s = 0; s < simplices.count(); ++s) {
      CornerVector spin(dimension * (dimension + 1));
      for (int a = 0; a <= dimension; ++a) {
        const Point at = mesh->rest_position(simplices.corners_of(s)[std::size_t(a)]);
        const Point to = (dimension == 3 ? Point(1, -2, 0.5) : Point(0, 0, 1)).cross(at) + Point(1, 2, 3);
        spin.segment(dimension * a, dimension) = to.head(dimension);
      }
      QVERIFY((stiffness(simplices, s, lame({3, 0.4})) * spin).norm() < 1e-12);
    }
  }
}

/// Moduli: E for a bar, E / (1 − ν²) for a sheet that is held laterally, and E (1 − ν) / ((1 + ν)(1 − 2ν)) for a solid
/// that is held laterally.
void ElasticTest::stiffness_at_rest_is_that_of_textbooks() {
  constexpr double young = 7, poisson = 0.25;
  const std::array<double, 3> moduli{young, young / (1 - poisson * poisson),
                                     young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))};
  for (const int dimension : {1, 2, 3}) {
    const MeshPointer mesh = of_dimension(dimension);
    const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
    double energy = 0, volume = 0;
    for (std::size_t s = 0; s < simplices.count(); ++s) {
      CornerVector stretched = CornerVector::Zero(dimension * (dimension + 1));
      for (int a = 0; a <= dimension; ++a) {
        stretched[dimension * a] = mesh->rest_position(simplices.corners_of(s)[std::size_t(a)]).x();
      }
      energy += 0.5 * stretched.dot(stiffness(simplices, s, lame({young, poisson})) * stretched);
      volume += simplices.volumes[s];
    }
    QCOMPARE(energy, 0.5 * moduli[std::size_t(dimension - 1)] * volume);  // to 1e-12
  }
}

void ElasticTest::derivatives_are_those_of_differences() {
  std::mt19937_64 random(3);
  const Lame material = lame({2, 0.45});
  for (const int dimension : {1, 2, 3}) {
    const MeshPointer mesh = of_dimension(dimension);
    const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
    for (int trial = 0; trial < 20; ++trial) {
      const std::size_t s = std::size_t(trial) % simplices.count();
      const CornerDisplacements at = some_corners(dimension, random);
      const SimplexEnergy here = neo_hookean(simplices, s, at, material, Want::hessian);
      QVERIFY(!here.inverted);
      constexpr double step = 1e-6;  // the error of central differences is step² and rounding / step: 1e-10
      for (int i = 0; i < dimension * (dimension + 1); ++i) {
        CornerDisplacements forward = at, back = at;
        forward.reshaped()[i] += step;
        back.reshaped()[i] -= step;
        const auto ahead = neo_hookean(simplices, s, forward, material, Want::gradient);
        const auto behind = neo_hookean(simplices, s, back, material, Want::gradient);
        QVERIFY(std::abs((ahead.energy - behind.energy) / (2 * step) - here.gradient[i]) < 1e-8);
        const CornerVector column = (ahead.gradient - behind.gradient) / (2 * step);
        QVERIFY((column - here.hessian.col(i)).norm() < 1e-7 * (1 + here.hessian.norm()));
      }
    }
  }
}

/// A cantilever under an end load in plane stress (Timoshenko and Goodier 1951). Both ends have the displacements of
/// that solution, and the long sides are free. The error of linear elements shrinks with the square of their size.
void ElasticTest::a_bent_sheet_converges() {
  constexpr double length = 8, height = 2, poisson = 0.3;
  const Field field = [](const Point& at) {
    const double x = at.x(), y = at.y() - height / 2, scale = 1e-4;
    return Point(-scale * y * ((6 * length - 3 * x) * x + (2 + poisson) * (y * y - height * height / 4)),
                 scale * (3 * poisson * y * y * (length - x) + (4 + 5 * poisson) * height * height * x / 4 +
                          (3 * length - x) * x * x),
                 0);
  };
  std::vector<double> sizes, errors;
  for (const std::uint32_t parts : {2U, 4U, 8U}) {
    const auto mesh = make_mesh(MeshKind::cloth, {4 * parts + 1, parts + 1, 1}, {}, height / parts);
    const auto solver = make_elastic(ElasticMethod::linear_fem, pinned(mesh, both_ends(*mesh), field, poisson));
    sizes.push_back(height / parts);
    errors.push_back(furthest_from(*mesh, solver->displacements(), field));
  }
  qInfo() << "a sheet under an end load: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 1.7);
}

/// The same for a solid beam in pure bending (Saint-Venant).
void ElasticTest::a_bent_solid_converges() {
  constexpr double poisson = 0.3;
  const Field field = [](const Point& at) {
    const double x = at.x(), y = at.y() - 1, z = at.z() - 1, bend = 1e-3;
    return Point(-bend * x * y, bend / 2 * (x * x + poisson * (y * y - z * z)), bend * poisson * y * z);
  };
  std::vector<double> sizes, errors;
  for (const std::uint32_t parts : {4U, 8U}) {
    const auto mesh = make_mesh(MeshKind::tetra, {2 * parts + 1, parts + 1, parts + 1}, {}, 2.0 / parts);
    const auto solver = make_elastic(ElasticMethod::linear_fem, pinned(mesh, both_ends(*mesh), field, poisson));
    sizes.push_back(2.0 / parts);
    errors.push_back(rms_from(*mesh, solver->displacements(), field));
  }
  qInfo() << "a solid in pure bending: order" << order_of(sizes, errors) << "errors" << errors;
  QVERIFY(order_of(sizes, errors) > 1.7);
}

/// A beam that is clamped at one end and grabbed at the other. Its line is the cubic of Euler and Bernoulli plus
/// Timoshenko's shear, which is small because the length is ten heights.
void ElasticTest::a_cantilever_bends_as_beams_do() {
  constexpr std::uint32_t parts = 8;
  constexpr double height = 1, length = 10, poisson = 0.3;
  const auto mesh = make_mesh(MeshKind::cloth, {10 * parts + 1, parts + 1, 1}, {}, height / parts);
  const auto solver = make_elastic(ElasticMethod::linear_fem, pinned(mesh, layer(*mesh, *find_side("left")), poisson));
  const ElementId middle_row = parts / 2 * (10 * parts + 1);
  solver->hold(ElasticHandle::of(middle_row + 10 * parts));
  solver->move(ElasticMotion::by(std::array{0.0, 0.1}));
  const auto deflection = [&](double x) {
    return solver->displacements()[2 * (middle_row + std::size_t(x * parts)) + 1];
  };
  const auto beam = [&](double x) {
    const double shear = 2 * (1 + poisson) / (5.0 / 6) * height * height / 12;  // E I / (κ G A)
    return (3 * length - x) * x * x / 6 + shear * x;
  };
  for (const double x : {2.5, 5.0, 7.5}) {
    const double ratio = deflection(x) / deflection(9) / (beam(x) / beam(9));
    QVERIFY2(std::abs(ratio - 1) < 0.02, qPrintable(QString::number(ratio)));  // clamping also fixes the width
  }
}

/// The difference between the two models grows with the square of the handle's displacement.
void ElasticTest::small_moves_are_linear() {
  for (const int dimension : {2, 3}) {
    const MeshPointer mesh = of_dimension(dimension);
    const ElasticProblem problem = pinned(mesh, layer(*mesh, *find_side("left")));
    const auto linear = make_elastic(ElasticMethod::linear_fem, problem);
    const auto whole = make_elastic(ElasticMethod::neo_hookean, problem);
    std::vector<double> apart;
    for (const double way : {0.02, 0.01}) {
      const std::vector<double> to{0.3 * way, way, 0.5 * way};
      for (ElasticSolver* solver : {linear.get(), whole.get()}) {
        solver->hold(ElasticHandle::of(mesh->element_count() - 1));
        solver->move(ElasticMotion::by(std::span(to).first(std::size_t(dimension))));
      }
      QVERIFY(whole->remark().empty());
      apart.push_back(largest_step(linear->displacements(), whole->displacements()));
    }
    const double order = std::log2(apart[0] / apart[1]);
    QVERIFY2(std::abs(order - 2) < 0.1, qPrintable(QString::number(order)));
  }
}

void ElasticTest::the_hand_and_the_pins_are_where_they_are() {
  const MeshPointer mesh = of_dimension(3);
  const auto left = layer(*mesh, *find_side("left"));
  const ElasticProblem problem = pinned(mesh, left);
  for (const ElasticMethod method : {ElasticMethod::linear_fem, ElasticMethod::neo_hookean, ElasticMethod::free_form}) {
    const auto solver = make_elastic(method, problem);
    const std::array<double, 3> first{0.4, 0.3, -0.2}, second{-0.3, 0.1, 0.6};
    for (const auto& [element, to] : {std::pair{mesh->element_count() - 1, first}, std::pair{ElementId{23}, second}}) {
      solver->hold(ElasticHandle::of(element));
      solver->move(ElasticMotion::by(to));
      for (std::size_t k = 0; k < 3; ++k) {
        QCOMPARE(solver->displacements()[3 * element + k], to[k]);
        for (const ElementId pin : left) {
          QCOMPARE(solver->displacements()[3 * pin + k], 0.0);
        }
      }
    }
    solver->reset();
    QVERIFY(std::ranges::all_of(solver->displacements(), [](double one) { return one == 0; }));
  }
}

QTEST_APPLESS_MAIN(ElasticTest)
#include "test_elastic.moc"
