#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <random>

#include "core/scenarios.h"
#include "core/spheres.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/surface_energy.h"
#include "measure/violation.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "program.h"
#include "solver/algorithms.h"

namespace chainmail::test_surface_material {

using namespace chainmail::test;

/// The energy of surfaces in space and its minimum, against theory of plates and finite elements in a plane.
class SurfaceMaterialTest : public QObject {
  Q_OBJECT

 private slots:
  void the_force_is_the_slope_of_the_energy_data();
  void the_force_is_the_slope_of_the_energy();
  void rest_and_rigid_motions_have_no_energy_data();
  void rest_and_rigid_motions_have_no_energy();
  void stretching_equals_the_material_in_three_dimensions();
  void a_flat_sheet_has_the_energy_of_a_plane();
  void bending_equals_the_theory_of_plates_data();
  void bending_equals_the_theory_of_plates();
  void the_orientation_of_triangles_does_not_matter();
  void a_strip_bends_as_a_cantilever();
  void a_flat_sheet_finds_the_minimum_of_finite_elements();
  void it_is_found_from_one_point();
  void a_mirrored_object_has_the_mirrored_minimum();
  void no_iteration_raises_the_energy();
  void thin_sheets_take_few_iterations();
  void a_cut_gives_the_minimum_of_the_cut_object();
  void a_cut_line_folds_freely();
  void regions_bind();
  void the_unit_of_length_does_not_matter();
  void threads_change_no_bit();
  void random_surfaces_have_the_slope_and_symmetry_of_an_energy();
};

namespace {

using Vectors = SurfaceEnergy::Vectors;
using Vector = Vectors::value_type;

/// A square sheet of width 1 in space: a lattice, cloth, or cloth with elements moved at random in its plane.
MeshPointer sheet(std::uint32_t n, MeshKind kind = MeshKind::grid, double jitter = 0, double unit = 1) {
  const MeshPointer regular = generate({.kind = kind, .size = {n, n}, .spacing = unit / (n - 1), .space_dimension = 3});
  if (jitter == 0) {
    return regular;
  }
  MeshParts parts;
  parts.space_dimension = 3;
  parts.triangles = regular->triangles;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-jitter, jitter);
  for (ElementId e = 0; e < n * n; ++e) {
    const bool moves_x = e % n != 0 && e % n != n - 1, moves_y = e / n != 0 && e / n != n - 1;
    const double x = number(random), y = number(random);
    parts.rest.push_back(regular->rest_position(e) + Point(moves_x ? x : 0, moves_y ? y : 0, 0) * unit / (n - 1));
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// Half a turn about its middle line.
MeshPointer moebius_strip() {
  constexpr std::uint32_t around = 24;
  MeshParts parts;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double turn = 2 * EIGEN_PI * i / around;
    for (const double across : {-0.3, 0.0, 0.3}) {
      const double out = 1 + across * std::cos(turn / 2);
      parts.rest.push_back({out * std::cos(turn), out * std::sin(turn), across * std::sin(turn / 2)});
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < 2; ++k) {
      const bool closes = i + 1 == around;
      const auto next = [&](std::uint32_t row) { return closes ? 2 - row : 3 * (i + 1) + row; };
      const ElementId a = 3 * i + k, b = a + 1;
      parts.triangles.push_back({a, b, next(k)});
      parts.triangles.push_back({b, next(k + 1), next(k)});
    }
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// Three leaves that share an edge.
MeshPointer three_leaves() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {0, 1, 0}, {1, 0.4, 0}, {-0.8, 0.3, 0.2}, {0.1, 0.5, 1}};
  parts.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

MeshPointer surface_of(const QString& name) {
  return name == "lattice"    ? sheet(5)
         : name == "cloth"    ? sheet(5, MeshKind::cloth, 0.3)
         : name == "sphere"   ? octahedral_sphere(3)
         : name == "one side" ? moebius_strip()
                              : three_leaves();
}
void add_surfaces() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"lattice", "cloth", "sphere", "one side", "leaves"}) {
    QTest::newRow(name) << QString(name);
  }
}

SurfaceEnergy energy_on(const MeshPointer& mesh, const ElasticOptions& elastic) {
  SurfaceEnergy energy;
  energy.build(mesh);
  energy.set_material(elastic);
  energy.set_cuts(Cuts(mesh));
  energy.set_extension_below(SurfaceEnergy::measured_below);
  return energy;
}
ElasticOptions thick(double thickness, double poisson = 0.3, const StrainLaw& law = {}) {
  ElasticOptions elastic;
  elastic.material.poisson = poisson;
  elastic.law = law;
  elastic.thickness = thickness;
  return elastic;
}

Vectors scattered(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-size, size);
  Vectors at(count);
  for (Vector& one : at) {
    const double x = number(random), y = number(random);
    one = {x, y, number(random)};
  }
  return at;
}

/// Returns how far the force is from the slope of the energy along a direction, relative.
double slope_error(SurfaceEnergy& energy, const Vectors& at, const Vectors& along, double step) {
  Vectors force, before = at, after = at;
  energy.evaluate(at, &force);
  double slope = 0, size = 0;
  for (std::size_t e = 0; e < at.size(); ++e) {
    slope -= force[e].dot(along[e]);
    size += force[e].norm() * along[e].norm();
    before[e] -= step * along[e];
    after[e] += step * along[e];
  }
  const double measured = (energy.evaluate(after, nullptr) - energy.evaluate(before, nullptr)) / (2 * step);
  return std::abs(measured - slope) / size;
}

Vectors displaced(const Mesh& mesh, const std::function<Point(const Point&)>& to) {
  Vectors at(mesh.element_count());
  for (ElementId e = 0; e < at.size(); ++e) {
    const Point by = to(mesh.rest_position(e)) - mesh.rest_position(e);
    at[e] = {by.x(), by.y(), by.z()};
  }
  return at;
}

/// A sheet whose left side is pinned, and a handle that moves.
struct Scene {
  explicit Scene(MeshPointer object, std::vector<ElementId> held = {})
      : mesh(std::move(object)), handle(std::move(held)) {
    pins = layer(*mesh, *find_side("left"));
    if (handle.empty()) {  // the four elements at a corner
      const ElementId last = mesh->element_count() - 1, width = mesh->lattice ? mesh->lattice->size[0] : 9;
      handle = {last - width - 1, last - width, last - 1, last};
    }
  }
  Body body() const {
    Body result(mesh, Precision::double_precision);
    result.set_softness(Softness{{0, 1000, 1000}, {}, EnergyKind::material});
    result.set_elastic(elastic);
    result.pin(pins);
    return result;
  }
  std::vector<double> moved(const Point& by) const {
    std::vector<double> at = mesh->rest;
    for (const ElementId e : handle) {
      for (std::size_t k = 0; k < 3; ++k) {
        at[3 * std::size_t{e} + k] += by[Eigen::Index(k)];
      }
    }
    return at;
  }
  /// Returns the body at the minimum, from these positions.
  Body solved(const std::vector<double>& from, double tolerance = 1e-8) const {
    Body result = body();
    result.set_positions(from);
    iterations = 0;
    const auto solver = EquilibriumSolver::make(3);
    if (!solver->solve(result, handle, tolerance, 2000)) {
      throw Error("surface", "the minimum was not found", "look at the solver");
    }
    iterations = solver->certificate(result)->iterations;
    return result;
  }

  MeshPointer mesh;
  ElasticOptions elastic = thick(0.02);
  std::vector<ElementId> pins, handle;
  mutable int iterations = 0;
};

std::vector<double> positions_of(const Body& body) {
  std::vector<double> at(body.mesh().rest.size());
  body.copy_positions(at);
  return at;
}
double energy_of(const Body& body) {
  return elastic_energy(body.mesh(), body.softness(), body.cuts(), body.positions(), body.elastic());
}
double rms_apart(const std::vector<double>& one, const std::vector<double>& other) {
  double sum = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    sum += (one[i] - other[i]) * (one[i] - other[i]) / double(one.size());
  }
  return std::sqrt(sum);
}

}  // namespace

void SurfaceMaterialTest::the_force_is_the_slope_of_the_energy_data() { add_surfaces(); }

void SurfaceMaterialTest::the_force_is_the_slope_of_the_energy() {
  QFETCH(QString, name);
  const MeshPointer mesh = surface_of(name);
  for (const StrainLaw::Kind kind : strain_laws) {
    SurfaceEnergy energy = energy_on(mesh, thick(0.1, 0.4, {kind}));
    for (const double size : {0.02, 0.1, 1.0}) {  // the last one compresses triangles to less than fades out
      const Vectors at = scattered(mesh->element_count(), size, 7);
      const double error = slope_error(energy, at, scattered(mesh->element_count(), 1, 8), 1e-7);
      QVERIFY2(error < 1e-6, qPrintable(QString("%1 at %2").arg(error).arg(size)));
    }
  }
}

void SurfaceMaterialTest::rest_and_rigid_motions_have_no_energy_data() { add_surfaces(); }

void SurfaceMaterialTest::rest_and_rigid_motions_have_no_energy() {
  QFETCH(QString, name);
  const MeshPointer mesh = surface_of(name);
  SurfaceEnergy energy = energy_on(mesh, thick(0.1));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const Vectors& at : {displaced(*mesh, [](const Point& rest) { return rest; }),
                            displaced(*mesh, [&](const Point& rest) { return Point(turn * rest + Point(3, 1, 2)); })}) {
    Vectors force;
    QVERIFY(std::abs(energy.evaluate(at, &force)) < 1e-13);
    QVERIFY(std::ranges::all_of(force, [](const Vector& one) { return one.norm() < 1e-12; }));
  }
  QVERIFY(energy.evaluate(scattered(mesh->element_count(), 1e-3, 1), nullptr) > 1e-9);
}

/// The density of the solid, with the stretch along the normal for which it is least.
void SurfaceMaterialTest::stretching_equals_the_material_in_three_dimensions() {
  const MeshPointer mesh = sheet(4);
  const double along = 1.3, across = 0.85, lean = 0.2;
  const Vectors at = displaced(*mesh, [&](const Point& rest) {
    return Point(along * rest.x() + lean * rest.y(), 0.3, across * rest.y());  // in another plane, too
  });
  for (const double poisson : {0.0, 0.3, 0.45}) {
    SurfaceEnergy energy = energy_on(mesh, thick(0.1, poisson));
    const auto [mu, lambda] = lame({1, poisson});
    double least = 1e300;
    for (double normal = 0.7; normal < 1.3; normal += 1e-5) {
      const double log = std::log(along * across * normal);
      const double squares = along * along + across * across + lean * lean + normal * normal;
      least = std::min(least, mu / 2 * (squares - 3) - mu * log + lambda / 2 * log * log);
    }
    const double found = energy.evaluate(at, nullptr) * energy.scale();
    QVERIFY2(std::abs(found - least) < 1e-8 * least, qPrintable(QString("%1 for %2").arg(found).arg(least)));
  }
}

void SurfaceMaterialTest::a_flat_sheet_has_the_energy_of_a_plane() {
  const MeshPointer space = sheet(5), plane = generate({.kind = MeshKind::grid, .size = {5, 5}, .spacing = 0.25});
  QCOMPARE(plane->space_dimension, 2);
  Body in_space(space, Precision::double_precision), in_plane(plane, Precision::double_precision);
  in_space.set_softness(Softness{{}, {}, EnergyKind::material});
  in_plane.set_softness(Softness{{}, {}, EnergyKind::material});
  in_space.set_elastic(thick(0.03, 0.4));
  in_plane.set_elastic(thick(0.03, 0.4));
  const Vectors at = scattered(25, 0.05, 3);
  std::vector<double> positions = space->rest, flat = plane->rest;
  for (std::size_t e = 0; e < 25; ++e) {
    for (std::size_t k = 0; k < 2; ++k) {
      positions[3 * e + k] += at[e][Eigen::Index(k)];
      flat[2 * e + k] += at[e][Eigen::Index(k)];
    }
  }
  in_space.set_positions(positions);
  in_plane.set_positions(flat);
  const double expected = 0.03 * energy_of(in_plane);
  QVERIFY(std::abs(energy_of(in_space) - expected) < 1e-12 * expected);
}

void SurfaceMaterialTest::bending_equals_the_theory_of_plates_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<double>("jitter");
  QTest::newRow("diagonals that alternate") << int(MeshKind::grid) << 0.0;
  QTest::newRow("parallel diagonals") << int(MeshKind::cloth) << 0.0;
  QTest::newRow("triangles of any shape") << int(MeshKind::cloth) << 0.3;
}

/// D/2 ((κ₁ + κ₂)² − 2 (1 − ν) κ₁ κ₂) per area, D = E t³ / 12 (1 − ν²) (Kirchhoff). The hinges know nothing beyond the
/// edge, where the plate has no moment: what is missing is a strip of about one triangle.
void SurfaceMaterialTest::bending_equals_the_theory_of_plates() {
  QFETCH(int, kind);
  QFETCH(double, jitter);
  const double thickness = 0.01, poisson = 0.3, curvature = 1e-4;
  const double plate = thickness * thickness / (12 * (1 - poisson * poisson));  // per thickness
  const Eigen::Matrix2d shapes[] = {Eigen::Matrix2d{{1, 0}, {0, 0}}, Eigen::Matrix2d{{0.5, 0.5}, {0.5, 0.5}},
                                    Eigen::Matrix2d{{1, 0}, {0, 1}}, Eigen::Matrix2d{{0, 1}, {1, 0}}};
  for (const Eigen::Matrix2d& shape : shapes) {
    for (const std::uint32_t n : {9U, 17U, 33U}) {
      const MeshPointer mesh = sheet(n, MeshKind(kind), jitter);
      SurfaceEnergy energy = energy_on(mesh, thick(thickness, poisson));
      const Vectors at = displaced(*mesh, [&](const Point& rest) {
        return Point(rest.x(), rest.y(), curvature / 2 * rest.head<2>().dot(shape * rest.head<2>()));
      });
      const double sum = shape.trace();
      const double exact = plate / 2 * curvature * curvature * (sum * sum - 2 * (1 - poisson) * shape.determinant());
      const double error = energy.evaluate(at, nullptr) * energy.scale() / exact - 1;
      QVERIFY2(std::abs(error) < 2.0 / (n - 1), qPrintable(QString("%1 with %2").arg(error).arg(n)));
    }
  }
}

void SurfaceMaterialTest::the_orientation_of_triangles_does_not_matter() {
  const MeshPointer mesh = sheet(6, MeshKind::cloth, 0.3);
  MeshParts parts;
  parts.space_dimension = 3;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    parts.rest.push_back(mesh->rest_position(e));
  }
  parts.triangles = mesh->triangles;
  for (std::size_t t = 0; t < parts.triangles.size(); t += 3) {
    std::swap(parts.triangles[t][0], parts.triangles[t][1]);
  }
  add_links_along_edges(parts);
  const MeshPointer turned = build_mesh(std::move(parts));
  QVERIFY(turned->triangles != mesh->triangles);
  SurfaceEnergy one = energy_on(mesh, thick(0.3)), other = energy_on(turned, thick(0.3));
  const Vectors at = scattered(mesh->element_count(), 0.05, 2);
  const double energy = one.evaluate(at, nullptr);
  QVERIFY(std::abs(other.evaluate(at, nullptr) - energy) < 1e-12 * energy);
}

/// A strip with ν = 0, clamped by its first two columns, whose end is lifted by δ: w = δ (3 x² L − x³) / (2 L³).
void SurfaceMaterialTest::a_strip_bends_as_a_cantilever() {
  std::vector<double> errors;
  for (const std::uint32_t n : {9U, 17U, 33U}) {
    const double spacing = 1.0 / (n - 1), lift = 1e-3;
    const std::uint32_t width = 5;
    const MeshPointer mesh =
        generate({.kind = MeshKind::grid, .size = {n, width}, .spacing = spacing, .space_dimension = 3});
    std::vector<ElementId> end;
    Scene scene(mesh, {n - 1});
    scene.handle.clear();
    for (std::uint32_t row = 0; row < width; ++row) {
      scene.pins.push_back(row * n + 1);
      scene.handle.push_back(row * n + n - 1);
    }
    std::ranges::sort(scene.pins);
    scene.elastic = thick(0.01, 0);
    const Body body = scene.solved(scene.moved({0, 0, lift}));
    const double length = 1 - spacing;
    double error = 0;
    for (std::uint32_t i = 1; i < n; ++i) {
      const double x = (i - 1) * spacing;
      const double exact = lift * x * x * (3 * length - x) / (2 * length * length * length);
      error = std::max(error, std::abs(body.positions()(2 * n + i, 2) - exact) / lift);
    }
    errors.push_back(error);
  }
  qInfo("%g %g %g", errors[0], errors[1], errors[2]);
  QVERIFY(errors[0] < 0.1);
  QVERIFY(errors[1] < 0.6 * errors[0] && errors[2] < 0.6 * errors[1]);  // of first order
}

/// Newton's method in a plane, which shares no code with the surface but the density. A thinner sheet has less energy
/// with wrinkles.
void SurfaceMaterialTest::a_flat_sheet_finds_the_minimum_of_finite_elements() {
  const std::uint32_t n = 7;
  Scene scene(sheet(n));
  scene.elastic.thickness = 0.3;
  const MeshPointer plane = generate({.kind = MeshKind::grid, .size = {n, n}, .spacing = 1.0 / (n - 1)});
  ElasticProblem problem{plane, Cuts(plane), scene.pins, std::vector<double>(2 * scene.pins.size(), 0.0),
                         scene.elastic};
  const auto solver = make_elastic(Algorithm::neo_hookean, problem);
  ElasticHandle held;
  held.elements = scene.handle;
  held.arms.assign(8, 0);
  held.displacements.assign(8, 0);
  solver->hold(held, {});
  for (const double share : {0.5, 1.0}) {
    const std::vector<double> by{0.1 * share, 0.05 * share};
    solver->move(ElasticMotion::by(by), {});
  }
  QVERIFY(solver->remark().empty());
  const Body body = scene.solved(scene.moved({0.1, 0.05, 0}));
  for (ElementId e = 0; e < n * n; ++e) {
    for (int k = 0; k < 2; ++k) {
      const double moved = body.positions()(e, k) - scene.mesh->rest[3 * std::size_t{e} + std::size_t(k)];
      const double right = solver->displacements()[2 * std::size_t{e} + std::size_t(k)];
      QVERIFY2(std::abs(moved - right) < 1e-7, qPrintable(QString("%1 for %2").arg(moved).arg(right)));
    }
    QVERIFY(std::abs(body.positions()(e, 2)) < 1e-7);
  }
  scene.elastic.thickness = 0.01;
  const Body thin = scene.solved(scene.moved({0.1, 0.05, 0}));
  QVERIFY(30 * energy_of(thin) < 0.99999 * energy_of(body));
}

void SurfaceMaterialTest::it_is_found_from_one_point() {
  for (const MeshKind kind : {MeshKind::grid, MeshKind::cloth}) {
    const Scene scene(sheet(9, kind));
    const Point by(0.05, 0.05, 0.3);
    const Body right = scene.solved(scene.moved(by));
    std::vector<double> at = scene.moved(by);
    for (ElementId e = 0; e < scene.mesh->element_count(); ++e) {
      for (std::size_t k = 0; !right.is_pinned(e) && !std::ranges::binary_search(scene.handle, e) && k < 3; ++k) {
        at[3 * std::size_t{e} + k] = 0.4;
      }
    }
    const Body found = scene.solved(at);
    QVERIFY(std::abs(energy_of(found) - energy_of(right)) < 1e-9 * energy_of(right));
    QVERIFY(rms_apart(positions_of(found), positions_of(right)) < 1e-6);
  }
}

void SurfaceMaterialTest::a_mirrored_object_has_the_mirrored_minimum() {
  const Scene scene(sheet(9, MeshKind::cloth, 0.3));
  const std::vector<double> one = positions_of(scene.solved(scene.moved({-0.1, 0.05, 0.3})));
  std::vector<double> other = positions_of(scene.solved(scene.moved({-0.1, 0.05, -0.3})));
  for (std::size_t e = 0; e < scene.mesh->element_count(); ++e) {
    other[3 * e + 2] *= -1;
  }
  QVERIFY(rms_apart(one, other) < 1e-7);
}

void SurfaceMaterialTest::no_iteration_raises_the_energy() {
  Scene scene(sheet(13));
  scene.elastic.thickness = 0.003;
  Body body = scene.body();
  body.set_positions(scene.moved({-0.4, 0.1, 0.4}));
  const auto solver = EquilibriumSolver::make(3, false);
  double last = energy_of(body);
  for (int i = 0; i < 120; ++i) {
    solver->iterate(body, scene.handle);
    const double now = energy_of(body);
    QVERIFY2(now <= last * (1 + 1e-11), qPrintable(QString("iteration %1: %2 after %3").arg(i).arg(now).arg(last)));
    last = now;
  }
}

/// With a multigrid as the first inverse, this took some thousand iterations.
void SurfaceMaterialTest::thin_sheets_take_few_iterations() {
  Scene scene(sheet(17));
  scene.elastic.thickness = 0.01;
  scene.solved(scene.moved({0, 0, 0.2}));
  qInfo("%d iterations", scene.iterations);
  QVERIFY(scene.iterations <= 100);
}

void SurfaceMaterialTest::a_cut_gives_the_minimum_of_the_cut_object() {
  const Scene scene(sheet(9));
  const Point by(-0.05, 0, 0.25);
  Body body = scene.body();
  body.set_positions(scene.moved(by));
  const auto solver = EquilibriumSolver::make(3);
  QVERIFY(solver->solve(body, scene.handle, 1e-9, 2000));
  const std::vector<double> whole = positions_of(body);
  std::vector<LinkId> cut;
  for (ElementId e = 4 + 9 * 3; e < 81; e += 9) {
    cut.push_back(*find_link(*scene.mesh, e, e + 1));
  }
  body.cut(cut);
  QVERIFY(solver->solve(body, scene.handle, 1e-9, 2000));
  Body fresh = scene.body();
  fresh.cut(cut);
  fresh.set_positions(scene.moved(by));
  QVERIFY(EquilibriumSolver::make(3)->solve(fresh, scene.handle, 1e-9, 2000));
  QVERIFY(rms_apart(positions_of(body), positions_of(fresh)) < 1e-6);
  QVERIFY(rms_apart(positions_of(body), whole) > 1e-3);
  body.uncut(cut);
  QVERIFY(solver->solve(body, scene.handle, 1e-9, 2000));
  QVERIFY(rms_apart(positions_of(body), whole) < 1e-6);
}

/// Two squares whose triangles on both sides of their common edge are cut away.
void SurfaceMaterialTest::a_cut_line_folds_freely() {
  const MeshPointer mesh = sheet(5);
  SurfaceEnergy energy = energy_on(mesh, thick(0.1));
  const Vectors folded = displaced(*mesh, [](const Point& rest) {
    return rest.x() < 0.6 ? rest : Point(0.5 + 0.5 * (rest.x() - 0.5), rest.y(), std::sqrt(0.75) * (rest.x() - 0.5));
  });
  QVERIFY(energy.evaluate(folded, nullptr) > 1e-4);
  Cuts cuts(mesh);
  std::vector<LinkId> links;
  for (ElementId e = 2; e < 25; e += 5) {
    links.push_back(*find_link(*mesh, e, e + 1));
  }
  std::ranges::for_each(links, [&](LinkId link) { cuts.cut(link); });
  QVERIFY(!energy.set_cuts(cuts).empty());
  QVERIFY(std::abs(energy.evaluate(folded, nullptr)) < 1e-13);
  energy.set_cuts(Cuts(mesh));
  SurfaceEnergy fresh = energy_on(mesh, thick(0.1));
  QCOMPARE(energy.evaluate(folded, nullptr), fresh.evaluate(folded, nullptr));
}

void SurfaceMaterialTest::regions_bind() {
  const Scene scene(sheet(7));
  Body body = scene.body();
  body.set_softness(Softness{{0.9, 1.1, 0.3}, {}, EnergyKind::material});
  body.set_positions(scene.moved({0.1, 0, 0.2}));
  const auto solver = EquilibriumSolver::make(3);
  QVERIFY(solver->solve(body, scene.handle, 1e-6, 3000));
  const auto certificate = solver->certificate(body);
  QVERIFY(certificate && certificate->binds);
  QVERIFY(certificate->violation < 1e-6);
  qInfo("%d iterations", certificate->iterations);
}

void SurfaceMaterialTest::the_unit_of_length_does_not_matter() {
  std::vector<double> once;
  for (const double unit : {1.0, 1e-20, 1e20}) {
    const Scene scene(sheet(7, MeshKind::grid, 0, unit));
    std::vector<double> at = positions_of(scene.solved(scene.moved({-0.1 * unit, 0, 0.2 * unit})));
    std::ranges::for_each(at, [unit](double& one) { one /= unit; });
    QVERIFY(once.empty() || rms_apart(at, once) < 1e-7);
    once = at;
  }
}

void SurfaceMaterialTest::threads_change_no_bit() {
  const Scene scene(sheet(91));  // large enough for helpers
  std::vector<double> once;
  for (const int threads : {1, 2, 4}) {
    Body body = scene.body();
    body.set_positions(scene.moved({-0.1, 0.05, 0.2}));
    const auto solver = EquilibriumSolver::make(3);
    solver->set_threads(threads);
    for (int i = 0; i < 3; ++i) {
      solver->iterate(body, scene.handle);
    }
    const std::vector<double> at = positions_of(body);
    QVERIFY(once.empty() || at == once);
    once = at;
  }
}

void SurfaceMaterialTest::random_surfaces_have_the_slope_and_symmetry_of_an_energy() {
  QVERIFY(check_property(
      "any surface",
      [] {
        const auto seed = *rc::gen::inRange<unsigned>(0, 1000);
        const MeshPointer mesh = *rc::gen::arbitrary<bool>() ? octahedral_sphere(*rc::gen::inRange(1, 4))
                                                             : sheet(*rc::gen::inRange(3U, 7U), MeshKind::cloth, 0.3);
        const double poisson = *rc::gen::element(0.0, 0.3, 0.49);
        Cuts cuts(mesh);
        for (const LinkId link :
             *rc::gen::container<std::vector<LinkId>>(3, rc::gen::inRange<LinkId>(0, mesh->link_count()))) {
          cuts.cut(link);
        }
        const Vectors at = scattered(mesh->element_count(), 0.01 * *rc::gen::inRange(1, 20), seed);
        const auto at_thickness = [&](double thickness, const Vectors& where) {
          SurfaceEnergy energy = energy_on(mesh, thick(thickness, poisson));
          energy.set_cuts(cuts);
          return energy.evaluate(where, nullptr);
        };
        SurfaceEnergy energy = energy_on(mesh, thick(0.2, poisson));
        energy.set_cuts(cuts);
        RC_ASSERT(slope_error(energy, at, scattered(mesh->element_count(), 1, seed + 1), 1e-7) < 1e-6);
        // It is that of stretching plus the thickness squared times that of bending, both positive.
        const double one = at_thickness(0.1, at), two = at_thickness(0.2, at), three = at_thickness(0.3, at);
        RC_ASSERT(two >= one && one >= (two - one) / 3);
        RC_ASSERT(std::abs((three - one) - (two - one) * 8 / 3) < 1e-9 * three);
        // A mirror image of a flat surface has the same energy.
        if (mesh->box[1].z() == mesh->box[0].z()) {
          Vectors mirrored = at;
          std::ranges::for_each(mirrored, [](Vector& moved) { moved[2] *= -1; });
          RC_ASSERT(std::abs(at_thickness(0.2, mirrored) - two) < 1e-12 * two);
        }
      },
      50));
}

CHAINMAIL_TEST(SurfaceMaterialTest)

}  // namespace chainmail::test_surface_material

#include "test_surface_material.moc"
