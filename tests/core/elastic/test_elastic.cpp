#include <Eigen/Geometry>
#include <QtTest>
#include <numeric>

#include "core/elastic/elastic_problems.h"
#include "elastic/energy.h"
#include "elastic/methods.h"
#include "elastic/nonlinear_fem.h"
#include "elastic/stiffening.h"
#include "elastic/stiffness.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_elastic {

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
  void stiffening_derivatives_are_those_of_differences();
  void stiffening_equals_linear_elasticity_at_small_strains();
  void stretches_are_those_of_the_closed_form();
  void the_limit_of_strain_is_kept();
  void an_inverted_cell_has_no_energy();
  void a_bent_sheet_converges();
  void a_bent_solid_converges();
  void a_cantilever_bends_as_beams_do();
  void small_moves_are_linear();
  void the_hand_and_the_pins_are_where_they_are();
  void what_was_held_is_free_again();
  void a_hand_may_lie_on_a_pin();
  void the_order_of_cells_changes_nothing_data();
  void the_order_of_cells_changes_nothing();
  void cuts_update_linear_fem_data();
  void cuts_update_linear_fem();
  void linear_fem_is_made_anew_where_no_update_is_possible();
  void options_out_of_range_are_refused();
  void limits_of_solids_are_those_of_the_checks();
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

namespace {

/// The forces of the uncut cells on elements that are free, over the largest force on any element.
double unbalanced(const ElasticProblem& problem, const std::vector<ElementId>& handle,
                  const std::vector<double>& displacements) {
  const Simplices simplices = build_simplices(*problem.mesh, problem.cuts);
  const int n = simplices.dimension;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(Eigen::Index(displacements.size()));
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    const auto corners = simplices.corners_of(s);
    Eigen::VectorXd at(n * (n + 1));
    for (int i = 0; i < n * (n + 1); ++i) {
      at[i] = displacements[corners[std::size_t(i / n)] * std::size_t(n) + std::size_t(i % n)];
    }
    const Eigen::VectorXd force = stiffness(simplices, s, lame(problem.options.material)) * at;
    for (int i = 0; i < n * (n + 1); ++i) {
      forces[Eigen::Index{corners[std::size_t(i / n)]} * n + i % n] += force[i];
    }
  }
  const double largest = forces.lpNorm<Eigen::Infinity>();
  for (const auto* prescribed : {&problem.pins, &handle}) {
    for (const ElementId e : *prescribed) {
      forces.segment(Eigen::Index{e} * n, n).setZero();
    }
  }
  return forces.lpNorm<Eigen::Infinity>() / largest;
}

ElasticHandle handle_of_many(const Mesh& mesh, const std::vector<ElementId>& elements) {
  const auto n = std::size_t(mesh.space_dimension);
  ElasticHandle handle{elements, std::vector<double>(n * elements.size(), 0.0), {}};
  for (const ElementId e : elements) {
    handle.arms.insert(handle.arms.end(), mesh.rest.begin() + std::ptrdiff_t(n * e),
                       mesh.rest.begin() + std::ptrdiff_t(n * (e + 1)));
  }
  return handle;
}

}  // namespace

void ElasticTest::cuts_update_linear_fem_data() {
  QTest::addColumn<int>("dimension");
  QTest::addColumn<bool>("many");
  QTest::addColumn<bool>("pins_are_moved");
  for (const int dimension : {2, 3}) {
    for (const bool many : {false, true}) {
      const std::string name = std::to_string(dimension) + (many ? "D, a patch" : "D, one element");
      QTest::newRow(name.c_str()) << dimension << many << false;
      QTest::newRow((name + ", moved pins").c_str()) << dimension << many << true;
    }
  }
}

/// Random links are cut and restored. The answer is that of a new solver, bit for bit, and the forces of the cells that
/// are left balance, which nothing of the solver decides.
void ElasticTest::cuts_update_linear_fem() {
  QFETCH(const int, dimension);
  QFETCH(const bool, many);
  QFETCH(const bool, pins_are_moved);
  const MeshPointer mesh = dimension == 2 ? jittered(make_mesh(MeshKind::cloth, {12, 12, 1}))
                                          : jittered(make_mesh(MeshKind::tetra, {9, 5, 4}));
  const auto way = [&](const Point& rest) {
    return pins_are_moved ? Point(0, 0.02 * rest.y(), 0) : Point(Point::Zero());
  };
  ElasticProblem problem = pinned(mesh, layer(*mesh, *find_side("left")), way, 0.3);
  const std::vector<ElementId> right = layer(*mesh, *find_side("right"));
  const std::vector<ElementId> elements = many ? right : std::vector{right.front()};
  const ElasticHandle handle = many ? handle_of_many(*mesh, elements) : ElasticHandle::of(elements.front());
  const std::vector<double> pull{0.4, 0.3, 0.1};
  const auto answer = [&](ElasticSolver& solver) {
    solver.hold(handle);
    solver.move(ElasticMotion::by(std::span(pull).first(std::size_t(dimension))));
    return solver.displacements();
  };
  std::mt19937_64 random(4);
  auto solver = make_elastic(Algorithm::linear_fem, problem);
  const std::vector<double> whole = answer(*solver);
  int different = 0;
  for (int step = 0; step < 24; ++step) {
    const std::vector<LinkId> cut = problem.cuts.links();
    if (step % 3 == 2) {
      std::ranges::for_each(cut, [&](LinkId link) { random() % 2 == 0 ? problem.cuts.uncut(link) : void(); });
    } else {
      for (int i = 0; i < 4; ++i) {
        problem.cuts.cut(LinkId(random() % mesh->link_count()));
      }
    }
    std::unique_ptr<ElasticSolver> anew;
    try {
      anew = make_elastic(Algorithm::linear_fem, problem);
    } catch (const Error&) {
      QVERIFY_THROWS_EXCEPTION(Error, dynamic_cast<CutUpdate&>(*solver).recut(problem.cuts, {}));
      problem.cuts = Cuts(mesh);
      solver = make_elastic(Algorithm::linear_fem, problem);
      continue;
    }
    QVERIFY(dynamic_cast<CutUpdate&>(*solver).recut(problem.cuts, {}));
    QVERIFY(solver->displacements() == anew->displacements());
    const std::vector<double> found = answer(*solver);
    QVERIFY(found == answer(*anew));
    const double force = unbalanced(problem, elements, found);
    QVERIFY2(force < 1e-11, qPrintable(QString::number(force)));
    different += found != whole ? 1 : 0;
  }
  QVERIFY(different > 10);
  problem.cuts = Cuts(mesh);
  QVERIFY(dynamic_cast<CutUpdate&>(*solver).recut(problem.cuts, {}));
  QVERIFY(answer(*solver) == whole);
}

/// A cell that was cut when the solver was made may be flat, so it was not looked at. Without a cell, nothing resists.
void ElasticTest::linear_fem_is_made_anew_where_no_update_is_possible() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {4, 4, 1});
  ElasticProblem problem = pinned(mesh, layer(*mesh, *find_side("left")));
  problem.cuts.cut(0);
  const auto solver = make_elastic(Algorithm::linear_fem, problem);
  auto& update = dynamic_cast<CutUpdate&>(*solver);
  Cuts all(mesh);
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    all.cut(link);
  }
  QVERIFY(!update.recut(all, {}));
  QVERIFY(!update.recut(Cuts(mesh), {}));
  QVERIFY(update.recut(problem.cuts, {}));
}

void ElasticTest::options_out_of_range_are_refused() {
  check(ElasticOptions());
  ElasticOptions options;
  options.iterations = 0;
  QVERIFY_THROWS_EXCEPTION(Error, check(options));
  options = {};
  options.lattice[1] = 1;
  QVERIFY_THROWS_EXCEPTION(Error, check(options));
}

void ElasticTest::uniform_strain_is_exact_data() {
  QTest::addColumn<int>("dimension");
  QTest::addColumn<int>("method");
  for (const int dimension : {1, 2, 3}) {
    for (const Algorithm method : {Algorithm::linear_fem, Algorithm::neo_hookean}) {
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
  const auto solver = make_elastic(Algorithm(method), pinned(mesh, boundary(*mesh), field, 0.35));
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
      const SimplexEnergy here = energy_of_law(simplices, s, at, {}, material, Want::hessian);
      QVERIFY(!here.inverted);
      constexpr double step = 1e-6;  // the error of central differences is step² and rounding / step: 1e-10
      for (int i = 0; i < dimension * (dimension + 1); ++i) {
        CornerDisplacements forward = at, back = at;
        forward.reshaped()[i] += step;
        back.reshaped()[i] -= step;
        const auto ahead = energy_of_law(simplices, s, forward, {}, material, Want::gradient);
        const auto behind = energy_of_law(simplices, s, back, {}, material, Want::gradient);
        QVERIFY(std::abs((ahead.energy - behind.energy) / (2 * step) - here.gradient[i]) < 1e-8);
        const CornerVector column = (ahead.gradient - behind.gradient) / (2 * step);
        QVERIFY((column - here.hessian.col(i)).norm() < 1e-7 * (1 + here.hessian.norm()));
      }
    }
  }
}

namespace {

constexpr StrainLaw gent{StrainLaw::Kind::gent, 1.5, 0.5}, fung{StrainLaw::Kind::fung, 2, 0.7};

/// The slope of the energy by I₁, f', written as in the papers.
double slope_by_i1(const StrainLaw& law, double i1, double mu) {
  return law.kind == StrainLaw::Kind::gent ? mu / 2 * law.gent_limit / (law.gent_limit - (i1 - 3))
                                           : mu / 2 * std::exp(law.fung_exponent * (i1 - 3));
}

/// The principal stress by the area at rest along an axis with this stretch: 2 f' s + (λ' ln J − μ) / s.
double stress_along(double stretch, const std::array<double, 3>& all, const StrainLaw& law, const Lame& lame) {
  const double f = slope_by_i1(law, all[0] * all[0] + all[1] * all[1] + all[2] * all[2], lame.mu);
  const double correction =
      law.kind == StrainLaw::Kind::gent ? 2 * lame.mu / law.gent_limit : 2 * lame.mu * law.fung_exponent;
  const double log_volume = std::log(all[0] * all[1] * all[2]);
  return 2 * f * stretch + ((lame.lambda - correction) * log_volume - lame.mu) / stretch;
}

/// The root of a function that grows, by bisection.
double root_of(const std::function<double(double)>& value, double low, double high) {
  for (int turn = 0; turn < 100; ++turn) {
    const double middle = (low + high) / 2;
    (value(middle) > 0 ? high : low) = middle;
  }
  return low;
}

/// The stresses that an object's energy gives: its derivatives by F, of a simplex with F = diag(stretches).
std::vector<double> stresses_of(const std::vector<double>& stretches, const StrainLaw& law, const Lame& lame) {
  const int n = int(stretches.size());
  const MeshPointer mesh = of_dimension(n);
  const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
  CornerDisplacements at(n, n + 1), corners(n, n + 1);
  for (int a = 0; a <= n; ++a) {
    const Point rest = mesh->rest_position(simplices.corners_of(0)[std::size_t(a)]);
    for (int k = 0; k < n; ++k) {
      corners(k, a) = rest[k];
      at(k, a) = (stretches[std::size_t(k)] - 1) * rest[k];
    }
  }
  const CornerVector gradient = model_of(law)(simplices, 0, at, lame, Want::gradient).gradient;
  std::vector<double> stresses;
  for (int k = 0; k < n; ++k) {
    double work = 0;  // of moving all corners in proportion to this coordinate
    for (int a = 0; a <= n; ++a) {
      work += gradient[n * a + k] * corners(k, a);
    }
    stresses.push_back(work / simplices.volumes[0]);
  }
  return stresses;
}

}  // namespace

void ElasticTest::stiffening_derivatives_are_those_of_differences() {
  std::mt19937_64 random(5);
  const Lame material = lame({2, 0.45});
  for (const StrainLaw& law : {gent, fung}) {
    const SimplexModel model = model_of(law);
    for (const int dimension : {1, 2, 3}) {
      const MeshPointer mesh = of_dimension(dimension);
      const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
      for (int trial = 0; trial < 20; ++trial) {
        const std::size_t s = std::size_t(trial) % simplices.count();
        const CornerDisplacements at = 2 * some_corners(dimension, random);
        const SimplexEnergy here = model(simplices, s, at, material, Want::hessian);
        QVERIFY(!here.inverted);
        constexpr double step = 1e-6;
        for (int i = 0; i < dimension * (dimension + 1); ++i) {
          CornerDisplacements forward = at, back = at;
          forward.reshaped()[i] += step;
          back.reshaped()[i] -= step;
          const auto ahead = model(simplices, s, forward, material, Want::gradient);
          const auto behind = model(simplices, s, back, material, Want::gradient);
          QVERIFY(std::abs((ahead.energy - behind.energy) / (2 * step) - here.gradient[i]) < 1e-7);
          const CornerVector column = (ahead.gradient - behind.gradient) / (2 * step);
          QVERIFY((column - here.hessian.col(i)).norm() < 1e-6 * (1 + here.hessian.norm()));
        }
      }
    }
  }
}

void ElasticTest::stiffening_equals_linear_elasticity_at_small_strains() {
  for (const StrainLaw& law : {gent, fung}) {
    for (const int dimension : {1, 2, 3}) {
      const MeshPointer mesh = of_dimension(dimension);
      const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
      const CornerDisplacements rest = CornerDisplacements::Zero(dimension, dimension + 1);
      const SimplexEnergy at_rest = model_of(law)(simplices, 0, rest, lame({3, 0.4}), Want::hessian);
      const CornerMatrix linear = stiffness(simplices, 0, lame({3, 0.4}));
      QVERIFY((at_rest.hessian - linear).norm() < 1e-12 * linear.norm());
      QVERIFY(std::abs(at_rest.energy) < 1e-14 && at_rest.gradient.norm() < 1e-13);
    }
  }
}

/// Uniaxial stretch (a bar, and a solid with its sides free) and equibiaxial stretch (a sheet): the other stretches are
/// the roots of the equations that the stress along them is 0.
void ElasticTest::stretches_are_those_of_the_closed_form() {
  const Lame material = lame({3, 0.45});
  for (const StrainLaw& law : {gent, fung}) {
    for (const double stretch : {0.8, 0.9, 1.05, 1.2, 1.3}) {
      // The roots are between narrow stretches and those at which I₁ − 3 is 1.5, the limit.
      const double square = stretch * stretch;
      const double side = root_of(
          [&](double s) {
            return stress_along(s, {stretch, s, s}, law, material);
          },
          0.5, 0.999 * std::sqrt((4.5 - square) / 2));
      const double expected = stress_along(stretch, {stretch, side, side}, law, material);
      QVERIFY(std::abs(stresses_of({stretch}, law, material)[0] - expected) < 1e-11);
      const auto solid = stresses_of({stretch, side, side}, law, material);
      QVERIFY(std::abs(solid[0] - expected) < 1e-11 && std::abs(solid[1]) < 1e-11 && std::abs(solid[2]) < 1e-11);
      const double thickness = root_of(
          [&](double s) {
            return stress_along(s, {stretch, stretch, s}, law, material);
          },
          0.3, 0.999 * std::sqrt(4.5 - 2 * square));
      const double biaxial = stress_along(stretch, {stretch, stretch, thickness}, law, material);
      for (const double stress : stresses_of({stretch, stretch}, law, material)) {
        QVERIFY(std::abs(stress - biaxial) < 1e-11);
      }
    }
    // It stiffens: at a stretch of 1.3 the stress is well above the neo-Hookean one.
    QVERIFY(stresses_of({1.3}, law, material)[0] > 1.05 * stresses_of({1.3}, {}, material)[0]);
  }
}

/// The energy is infinite from the limit on, and a pull that a neo-Hookean bar follows is refused.
void ElasticTest::the_limit_of_strain_is_kept() {
  const Lame material = lame({3, 0.45});
  for (const int dimension : {1, 2, 3}) {
    for (const auto& [stretch, exists] : {std::pair(1.3, true), std::pair(2.5, false)}) {
      const MeshPointer mesh = of_dimension(dimension);
      const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
      CornerDisplacements at = CornerDisplacements::Zero(dimension, dimension + 1);
      for (int a = 0; a <= dimension; ++a) {
        at(0, a) = (stretch - 1) * mesh->rest_position(simplices.corners_of(0)[std::size_t(a)]).x();
      }
      QCOMPARE(!model_of(gent)(simplices, 0, at, material, Want::energy).inverted, exists);
      QVERIFY(!model_of(fung)(simplices, 0, at, material, Want::energy).inverted);
    }
  }
  const MeshPointer bar = make_mesh(MeshKind::tetra, {7, 2, 2});
  for (const auto& [law, far, reached] : {std::tuple(StrainLaw(), 8.0, true), std::tuple(gent, 8.0, false),
                                          std::tuple(gent, 2.0, true), std::tuple(fung, 2.0, true)}) {
    ElasticProblem problem = pinned(bar, layer(*bar, *find_side("left")), 0.45);
    problem.options.law = law;
    const auto solver = make_elastic(Algorithm::neo_hookean, problem);
    const std::vector<ElementId> end = layer(*bar, *find_side("right"));
    const std::vector<double> none(3 * end.size(), 0.0);
    solver->hold({end, none, none});
    solver->move(ElasticMotion::by(std::vector<double>{far, 0, 0}));
    QCOMPARE(solver->remark().empty(), reached);
  }
  QVERIFY_THROWS_EXCEPTION(Error, check(StrainLaw{StrainLaw::Kind::gent, 0.1, 1}, Material{1, 0.3}));
  QVERIFY_THROWS_EXCEPTION(Error, check(StrainLaw{StrainLaw::Kind::fung, 1, 0.8}, Material{1, 0.3}));
  check(StrainLaw{StrainLaw::Kind::fung, 1, 0.75}, Material{1, 0.3});
}

/// Flat, or reflected at a side: no finite energy gets there, whatever the material.
void ElasticTest::an_inverted_cell_has_no_energy() {
  const Lame material = lame({3, 0.45});
  for (const int dimension : {1, 2, 3}) {
    const MeshPointer mesh = of_dimension(dimension);
    const Simplices simplices = build_simplices(*mesh, Cuts(mesh));
    for (const double stretch : {0.0, -0.01, -1.0}) {
      CornerDisplacements at = CornerDisplacements::Zero(dimension, dimension + 1);
      for (int a = 0; a <= dimension; ++a) {
        at(0, a) = (stretch - 1) * mesh->rest_position(simplices.corners_of(0)[std::size_t(a)]).x();
      }
      for (const StrainLaw& law : {StrainLaw(), gent, fung}) {
        QVERIFY(model_of(law)(simplices, 0, at, material, Want::energy).inverted);
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
    const auto solver = make_elastic(Algorithm::linear_fem, pinned(mesh, both_ends(*mesh), field, poisson));
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
    const auto solver = make_elastic(Algorithm::linear_fem, pinned(mesh, both_ends(*mesh), field, poisson));
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
  const auto solver = make_elastic(Algorithm::linear_fem, pinned(mesh, layer(*mesh, *find_side("left")), poisson));
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
    const auto linear = make_elastic(Algorithm::linear_fem, problem);
    const auto whole = make_elastic(Algorithm::neo_hookean, problem);
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
  for (const Algorithm method : {Algorithm::linear_fem, Algorithm::neo_hookean, Algorithm::free_form}) {
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

void ElasticTest::what_was_held_is_free_again() {
  const MeshPointer mesh = of_dimension(3);
  const ElementId first = mesh->element_count() - 1;
  const std::array<double, 3> by{0.4, 0.3, -0.2};
  for (const Algorithm method :
       {Algorithm::linear_fem, Algorithm::neo_hookean, Algorithm::corotational, Algorithm::arap, Algorithm::xpbd,
        Algorithm::projective, Algorithm::quasi_newton, Algorithm::neo_hookean_xpbd}) {
    const auto solver = make_elastic(method, pinned(mesh, layer(*mesh, *find_side("left"))));
    solver->hold(ElasticHandle::of(first));
    solver->move(ElasticMotion::by(by));
    solver->hold(ElasticHandle::of(23));
    for (int move = 0; move < 20; ++move) {
      solver->move(ElasticMotion::by(std::array{0.0, 0.0, 0.01}));
    }
    QVERIFY2(std::abs(solver->displacements()[std::size_t{3} * first]) < 0.5 * by[0], info(method).name.data());
  }
}

/// The edge between them has no length then, and so no direction in which it could push.
void ElasticTest::a_hand_may_lie_on_a_pin() {
  const MeshPointer mesh = make_mesh(MeshKind::line, {4, 1, 1});
  const auto solver = make_elastic(Algorithm::xpbd, pinned(mesh, {0}));
  solver->hold(ElasticHandle::of(1));
  solver->move(ElasticMotion::by(std::array{-1.0}));
  QCOMPARE(solver->remark(), std::string());
  QCOMPARE(solver->displacements()[0], 0.0);
  for (const std::size_t e : {1U, 2U, 3U}) {  // the others follow the handle
    QVERIFY2(std::abs(solver->displacements()[e] + 1) < 1e-4, qPrintable(QString::number(solver->displacements()[e])));
  }
}

namespace {

template <class Cell>
void shuffle(std::vector<Cell>& cells, std::mt19937_64& random) {
  for (std::size_t i = cells.size(); i > 1; --i) {
    std::swap(cells[i - 1], cells[random() % i]);
  }
}

/// The same mesh with its links and cells in another order, and the corners of each cell too if asked, by even
/// permutations.
MeshPointer shuffled(const Mesh& mesh, bool corners) {
  MeshParts parts = parts_of(mesh);
  std::mt19937_64 random(3);
  shuffle(parts.links, random);
  shuffle(parts.triangles, random);
  shuffle(parts.tetrahedra, random);
  for (auto& face : parts.triangles) {
    std::ranges::rotate(face, face.begin() + std::ptrdiff_t(corners ? random() % 3 : 0));
  }
  for (auto& cell : parts.tetrahedra) {
    std::rotate(cell.begin(), cell.begin() + std::ptrdiff_t(corners ? random() % 3 : 0), cell.begin() + 3);
    if (corners && random() % 2 == 0) {
      std::swap(cell[0], cell[1]);
      std::swap(cell[2], cell[3]);
    }
  }
  return build_mesh(std::move(parts));
}

}  // namespace

void ElasticTest::the_order_of_cells_changes_nothing_data() {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("dimension");
  for (const AlgorithmInfo& one : elastic_algorithms()) {
    for (const int dimension : {1, 2, 3}) {
      if (fits(one.algorithm, *of_dimension(dimension))) {
        QTest::addRow("%s, %dD", std::string(one.name).c_str(), dimension) << int(one.algorithm) << dimension;
      }
    }
  }
}

/// A sweep over constraints in turn depends on their order, so XPBD must not take that of the cells in a file. Ten
/// iterations end before the object is at rest, where more of the order shows. Sums of the others differ by rounding.
void ElasticTest::the_order_of_cells_changes_nothing() {
  QFETCH(const int, method);
  QFETCH(const int, dimension);
  const MeshPointer mesh = of_dimension(dimension);
  const auto answer = [&](const MeshPointer& object) {
    ElasticProblem problem = pinned(object, layer(*object, *find_side("left")), 0.45);
    problem.options.iterations = 10;
    const auto solver = make_elastic(Algorithm(method), problem);
    solver->hold(ElasticHandle::of(object->element_count() - 1));
    const std::array<double, 3> by{0.3, 0.4, -0.2};
    for (int step = 1; step <= 3; ++step) {
      std::vector<double> part(by.begin(), by.begin() + dimension);
      std::ranges::for_each(part, [&](double& one) { one *= step / 3.0; });
      solver->move(ElasticMotion::by(part));
    }
    return solver->displacements();
  };
  const std::vector<double> expected = answer(mesh), other_order = answer(shuffled(*mesh, false));
  QVERIFY(largest_coordinate(expected) >= 0.3);
  if (const auto is = Algorithm(method); is == Algorithm::xpbd || is == Algorithm::neo_hookean_xpbd) {
    QVERIFY(same_bits(other_order, expected));
  }
  for (const std::vector<double>& one : {other_order, answer(shuffled(*mesh, true))}) {
    const double apart = largest_step(one, expected) / largest_coordinate(expected);
    QVERIFY2(apart < 1e-9, qPrintable(QString::number(apart)));
  }
}

/// The check refuses a solid above the limit that the table states, and names that limit.
void ElasticTest::limits_of_solids_are_those_of_the_checks() {
  const auto small = make_mesh(MeshKind::tetra, {3, 3, 3}), large = make_mesh(MeshKind::tetra, {47, 47, 46});
  const auto sentence = [&](Algorithm method) {
    try {
      check(method, *large);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const auto method : {Algorithm::linear_fem, Algorithm::neo_hookean, Algorithm::boundary_elements,
                            Algorithm::corotational, Algorithm::arap, Algorithm::xpbd, Algorithm::projective,
                            Algorithm::quasi_newton, Algorithm::neo_hookean_xpbd, Algorithm::free_form}) {
    check(method, *small);
    const auto most = max_solid_elements(method);
    QCOMPARE(most.has_value(), method != Algorithm::free_form);
    QCOMPARE(sentence(method).find("it is limited to " + std::to_string(most.value_or(0)) + " elements") !=
                 std::string::npos,
             most.has_value());
  }
}

CHAINMAIL_TEST(ElasticTest)

}  // namespace chainmail::test_elastic

#include "test_elastic.moc"
