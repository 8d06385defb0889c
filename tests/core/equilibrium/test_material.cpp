#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <random>

#include "body/body_view.h"
#include "core/scenarios.h"
#include "elastic/energy.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/linear_prediction.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/material_energy.h"
#include "equilibrium/simplex_batches.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "program.h"
#include "solver/algorithms.h"

namespace chainmail::test_material {

using namespace chainmail::test;

/// The energy of the material and its minimum, against finite elements that share no code with it but the cells.
class MaterialTest : public QObject {
  Q_OBJECT

 private slots:
  void the_force_is_the_slope_of_the_energy_data();
  void the_force_is_the_slope_of_the_energy();
  void the_energy_equals_finite_elements();
  void instructions_change_no_bit();
  void batches_have_the_density_of_single_simplices();
  void a_tetrahedron_has_the_energy_of_its_formula();
  void a_slice_of_a_long_body_is_a_sheet_of_another_ratio();
  void the_minimum_equals_finite_elements_data();
  void the_minimum_equals_finite_elements();
  void it_is_found_from_any_start_data();
  void it_is_found_from_any_start();
  void materials_that_stiffen_equal_finite_elements_data();
  void materials_that_stiffen_equal_finite_elements();
  void the_unit_of_length_does_not_matter();
  void it_is_found_after_half_the_width_in_one_move();
  void a_prediction_goes_on_with_the_last_frame();
  void a_later_move_begins_near_its_end();
  void where_a_drag_ends_does_not_depend_on_its_way();
  void positions_that_are_set_end_a_drag();
  void no_iteration_raises_the_energy();
  void a_change_of_the_material_moves_the_minimum();
  void what_was_cancelled_is_prepared_later();
  void a_cut_gives_the_minimum_of_the_cut_object();
  void a_cut_changes_the_energy_by_its_cells_data();
  void a_cut_changes_the_energy_by_its_cells();
  void a_turned_object_has_no_energy();
  void links_without_cells_keep_their_length();
  void regions_bind_where_they_bind();
  void a_handle_of_one_element_equals_finite_elements();
  void threads_change_no_bit();
  void random_scenes_equal_finite_elements();
};

namespace {

template <int D>
using Vectors = typename MaterialEnergy<D>::Vectors;

MeshPointer block(MeshKind kind, std::uint32_t width) { return generate({kind, {width, width, width}, 1, {}}); }

/// An object held at its left side, and a patch around its last element that moves.
struct Scene {
  explicit Scene(MeshPointer object, double patch = 1.1) : mesh(std::move(object)) {
    pins = layer(*mesh, *find_side("left"));
    const ElementId last = mesh->element_count() - 1;
    for (ElementId e = 0; e <= last; ++e) {
      if ((rest(e) - rest(last)).norm() <= patch && std::ranges::find(pins, e) == pins.end()) {
        handle.push_back(e);
      }
    }
  }

  Eigen::VectorXd rest(ElementId e) const {
    const Eigen::Index n = mesh->space_dimension;
    return Eigen::Map<const Eigen::VectorXd>(mesh->rest.data() + Eigen::Index{e} * n, n);
  }
  Body body() const {
    Body result(mesh, Precision::double_precision);
    Softness softness{{0, 1000, 1000}, {}, EnergyKind::material};
    result.set_softness(softness);
    ElasticOptions options{material};
    options.law = law;
    result.set_elastic(options);
    result.pin(pins);
    return result;
  }
  /// Returns the positions at rest, with the handle moved.
  std::vector<double> moved(std::span<const double> by) const {
    std::vector<double> at = mesh->rest;
    for (const ElementId e : handle) {
      for (std::size_t k = 0; k < by.size(); ++k) {
        at[e * by.size() + k] += by[k];
      }
    }
    return at;
  }
  /// Returns the positions that neo-Hookean finite elements find.
  std::vector<double> finite_elements(std::span<const double> by, const Cuts& cuts) const {
    ElasticProblem problem{mesh, cuts, pins, std::vector<double>(pins.size() * by.size(), 0.0), {material}};
    problem.options.law = law;
    const auto solver = make_elastic(Algorithm::neo_hookean, problem);
    ElasticHandle held;
    held.elements = handle;
    held.arms.assign(handle.size() * by.size(), 0);
    held.displacements.assign(handle.size() * by.size(), 0);
    solver->hold(held, {});
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {  // Newton's method does not always reach the end in one step
      std::vector<double> part(by.begin(), by.end());
      std::ranges::for_each(part, [share](double& one) { one *= share; });
      solver->move(ElasticMotion::by(part), {});
    }
    if (!solver->remark().empty()) {
      throw Error("finite elements", solver->remark(), "drag less far");
    }
    std::vector<double> at = mesh->rest;
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] += solver->displacements()[i];
    }
    return at;
  }
  std::vector<double> finite_elements(std::span<const double> by) const { return finite_elements(by, Cuts(mesh)); }

  MeshPointer mesh;
  Material material{1, 0.3};
  StrainLaw law;
  std::vector<ElementId> pins, handle;
};

/// Moves the handle this far from rest, as a pass does.
void move_handle(Body& body, const Scene& scene, const std::array<double, 3>& by) {
  body.with_view([&]<class View>(const View& view) {
    for (const ElementId e : scene.handle) {
      for (int k = 0; k < View::Dimension; ++k) {
        view.set_position(e, k, scene.mesh->rest[std::size_t{e} * 3 + std::size_t(k)] + by[std::size_t(k)]);
      }
    }
  });
  body.note_move();
}

std::vector<double> positions_of(const Body& body) {
  std::vector<double> at(body.mesh().rest.size());
  body.copy_positions(at);
  return at;
}

/// Returns the root of the mean square of the differences, relative to that of the displacements.
double relative_error(const std::vector<double>& found, const std::vector<double>& right, const Mesh& mesh) {
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    apart += (found[i] - right[i]) * (found[i] - right[i]);
    size += (right[i] - mesh.rest[i]) * (right[i] - mesh.rest[i]);
  }
  return std::sqrt(apart / size);
}

double energy_of(const Body& body) {
  return elastic_energy(body.mesh(), body.softness(), body.cuts(), body.positions(), body.elastic());
}

/// Solves from these positions, and returns the relative error against finite elements.
double error_from(const Scene& scene, const std::vector<double>& start, std::span<const double> by) {
  Body body = scene.body();
  body.set_positions(start);
  const bool reached = EquilibriumSolver::make(scene.mesh->space_dimension)->solve(body, scene.handle, 1e-8, 5000);
  return reached ? relative_error(positions_of(body), scene.finite_elements(by), *scene.mesh) : 1;
}

template <int D>
void check_slope(const Mesh& mesh, const StrainLaw& law, double size) {
  MaterialEnergy<D> energy;
  energy.build(MeshPointer(std::shared_ptr<void>(), &mesh));
  energy.set_material({.material = {1, 0.4}, .law = law});
  energy.set_cuts(Cuts());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  Vectors<D> at(mesh.element_count()), along(mesh.element_count()), force;
  for (ElementId e = 0; e < at.size(); ++e) {
    for (int k = 0; k < D; ++k) {
      at[e][k] = size * number(random);
      along[e][k] = number(random);
    }
  }
  energy.evaluate(at, &force);
  double slope = 0;
  Vectors<D> before = at, after = at;
  constexpr double step = 1e-5;
  for (ElementId e = 0; e < at.size(); ++e) {
    slope -= force[e].dot(along[e]);
    before[e] -= step * along[e];
    after[e] += step * along[e];
  }
  const double measured = (energy.evaluate(after, nullptr) - energy.evaluate(before, nullptr)) / (2 * step);
  QVERIFY2(std::abs(measured - slope) < 1e-5 * (std::abs(slope) + 1),
           qPrintable(QString("%1 against %2").arg(measured).arg(slope)));
}

/// Batches of any simplices, some of them without volume.
template <int D>
struct Batches {
  explicit Batches(double size) : at(300) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    for (FourNumbers& one : at) {
      std::generate_n(one.at.begin(), D, [&] { return size * number(random); });
    }
    for (SimplexBatch<D>& batch : batches) {
      for (std::size_t lane = 0; lane < SimplexBatch<D>::lanes; ++lane) {
        for (auto& corner : batch.corner) {
          corner[lane] = std::uint32_t(random() % at.size());
        }
        for (auto& gradient : batch.gradient) {
          std::ranges::for_each(gradient, [&](FourNumbers& axis) { axis.at[lane] = number(random); });
        }
        batch.volume.at[lane] = random() % 5 != 0 ? 1 + number(random) / 2 : 0;
      }
    }
  }
  /// Returns the energy, the least ratio of volumes, and the forces.
  std::vector<double> evaluate(const BatchDensity& density, BatchInstructions instructions) const {
    std::vector<FourNumbers> force(at.size());
    const BatchSum sum = evaluate_batches<D>(batches, density, at.data(), force.data(), instructions);
    const BatchSum energy = evaluate_batches<D>(batches, density, at.data(), nullptr, instructions);
    std::vector<double> result{sum.energy, sum.least, energy.energy, energy.least};
    std::ranges::for_each(force,
                          [&](const FourNumbers& one) { result.insert(result.end(), one.at.begin(), one.at.end()); });
    return result;
  }

  std::vector<SimplexBatch<D>> batches{500};
  std::vector<FourNumbers> at;
};

template <int D>
void check_instructions(StrainLaw::Kind kind, double size) {
  const Lame moduli = lame({1, 0.4});
  ExtendedDensity extended({kind, 1, 1}, moduli, D);
  extended.set_least_volume(0.1);
  const BatchDensity density{kind == StrainLaw::Kind::neo_hookean, moduli, &extended};
  const Batches<D> batches(size);
  const std::vector<double> one = batches.evaluate(density, BatchInstructions::portable);
  QVERIFY(std::ranges::all_of(one, [](double number) { return std::isfinite(number); }) && one[1] < 1);
  QVERIFY(one[0] == one[2] && one[1] == one[3]);
  QVERIFY(one == batches.evaluate(density, batch_instructions()));
}

template <int D>
void check_density(double poisson, double size) {
  const Lame moduli = lame({1, poisson});
  ExtendedDensity extended({}, moduli, D);
  extended.set_least_volume(0.1);
  const Batches<D> batches(size);
  const std::vector<double> fast = batches.evaluate({true, moduli, &extended}, batch_instructions());
  const std::vector<double> single = batches.evaluate({false, moduli, &extended}, batch_instructions());
  const double largest = std::abs(*std::ranges::max_element(single, {}, [](double one) { return std::abs(one); }));
  for (std::size_t i = 0; i < fast.size(); ++i) {
    QVERIFY2(std::abs(fast[i] - single[i]) <= 1e-12 * largest,
             qPrintable(QString("%1, not %2").arg(fast[i]).arg(single[i])));
  }
}

}  // namespace

void MaterialTest::the_force_is_the_slope_of_the_energy_data() {
  QTest::addColumn<int>("law");
  QTest::addColumn<double>("size");
  for (const double size : {0.1, 1.5}) {  // the second one inverts most cells
    QTest::addRow("neo-Hookean, %g", size) << int(StrainLaw::Kind::neo_hookean) << size;
    QTest::addRow("Gent, %g", size) << int(StrainLaw::Kind::gent) << size;
    QTest::addRow("Fung, %g", size) << int(StrainLaw::Kind::fung) << size;
  }
}

void MaterialTest::the_force_is_the_slope_of_the_energy() {
  QFETCH(int, law);
  QFETCH(double, size);
  const StrainLaw one{StrainLaw::Kind(law)};
  check_slope<1>(*generate({MeshKind::line, {7}, 1, {}}), one, size);
  check_slope<2>(*block(MeshKind::grid, 4), one, size);
  check_slope<3>(*block(MeshKind::tetra, 4), one, size);
  check_slope<3>(*block(MeshKind::block, 4), one, size);
}

void MaterialTest::the_energy_equals_finite_elements() {
  const Scene scene(block(MeshKind::tetra, 4));
  const std::vector<double> by{0.3, -0.2, 0.1};
  Body body = scene.body();
  body.set_positions(scene.moved(by));
  const Simplices simplices = build_simplices(*scene.mesh, Cuts(scene.mesh));
  double sum = 0;
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    CornerDisplacements at(3, 4);
    for (int k = 0; k < 4; ++k) {
      const ElementId e = simplices.corners_of(s)[std::size_t(k)];
      for (int axis = 0; axis < 3; ++axis) {
        at(axis, k) = body.positions()(e, axis) - scene.mesh->rest[std::size_t{e} * 3 + std::size_t(axis)];
      }
    }
    sum += energy_of_law(simplices, s, at, {}, lame(scene.material), Want::energy).energy;
  }
  QVERIFY(sum > 0);
  QVERIFY(std::abs(energy_of(body) - sum) < 1e-12 * sum);
}

void MaterialTest::instructions_change_no_bit() {
  if (batch_instructions() == BatchInstructions::portable) {
    QSKIP("this processor has no other instructions");
  }
  for (const StrainLaw::Kind kind : {StrainLaw::Kind::neo_hookean, StrainLaw::Kind::gent, StrainLaw::Kind::fung}) {
    for (const double size : {1e-6, 0.1, 1.5}) {  // the last one inverts many
      check_instructions<1>(kind, size);
      check_instructions<2>(kind, size);
      check_instructions<3>(kind, size);
    }
  }
}

void MaterialTest::batches_have_the_density_of_single_simplices() {
  for (const double poisson : {0.0, 0.3, 0.49}) {
    for (const double size : {0.1, 1.5}) {
      check_density<1>(poisson, size);
      check_density<2>(poisson, size);
      check_density<3>(poisson, size);
    }
  }
}

/// μ/2 (I₁ − 3) − μ ln J + λ/2 ln² J, to the last digits: the logarithm of batches is our own.
void MaterialTest::a_tetrahedron_has_the_energy_of_its_formula() {
  const Lame moduli = lame({1, 0.49});
  const ExtendedDensity extended({}, moduli, 3);
  SimplexBatch<3> batch{};
  batch.volume.at[0] = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    batch.corner[k + 1].fill(std::uint32_t(k + 1));
    batch.gradient[k][k].at.fill(1);
  }
  for (int i = 80; i < 160; ++i) {
    const double stretch = i / 100.0, logarithm = std::log(stretch * stretch * stretch);
    std::vector<FourNumbers> at(4);
    for (std::size_t k = 0; k < 3; ++k) {
      at[k + 1].at[k] = stretch - 1;
    }
    const double energy =
        evaluate_batches<3>(std::span(&batch, 1), {true, moduli, &extended}, at.data(), nullptr).energy;
    const double shape = 1.5 * moduli.mu * (stretch * stretch - 1), turn = moduli.mu * logarithm;
    const double volume = moduli.lambda / 2 * logarithm * logarithm;
    const double largest = std::max({std::abs(shape), std::abs(turn), volume});
    QVERIFY2(std::abs(energy - (shape - turn + volume)) <= 2e-14 * largest, qPrintable(QString::number(stretch)));
  }
}

/// Hooke's law in plane strain, ν, is that in plane stress with ν / (1 − ν) and E / (1 − ν²): the manual says so.
void MaterialTest::a_slice_of_a_long_body_is_a_sheet_of_another_ratio() {
  const MeshPointer mesh = block(MeshKind::grid, 4);
  const double poisson = 0.3;
  const auto [mu, lambda] = lame({1, poisson});
  const Eigen::Matrix2d strain{{3e-5, 1e-5}, {1e-5, -2e-5}};
  const double exact = 9 * (mu * strain.squaredNorm() + lambda / 2 * strain.trace() * strain.trace());  // area 9
  Scene scene(mesh);
  scene.material = {1 / (1 - poisson * poisson), poisson / (1 - poisson)};
  Body body = scene.body();
  std::vector<double> at = mesh->rest;
  for (std::size_t e = 0; e < mesh->element_count(); ++e) {
    Eigen::Map<Eigen::Vector2d> one(at.data() + 2 * e);
    one += strain * Eigen::Vector2d(one);
  }
  body.set_positions(at);
  QVERIFY(std::abs(energy_of(body) - exact) < 1e-3 * exact);
  scene.material = {1, poisson};
  body.set_elastic({scene.material});
  QVERIFY(std::abs(energy_of(body) - exact) > 1e-2 * exact);  // plane stress
}

void MaterialTest::the_minimum_equals_finite_elements_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("width");
  QTest::addColumn<double>("poisson");
  QTest::newRow("tetrahedra") << int(MeshKind::tetra) << 6 << 0.3;
  QTest::newRow("without contraction") << int(MeshKind::tetra) << 6 << 0.0;
  QTest::newRow("nearly incompressible") << int(MeshKind::tetra) << 6 << 0.49;
  QTest::newRow("cubes") << int(MeshKind::block) << 6 << 0.3;
  QTest::newRow("sheet in a plane") << int(MeshKind::grid) << 9 << 0.45;
}

void MaterialTest::the_minimum_equals_finite_elements() {
  QFETCH(int, kind);
  QFETCH(int, width);
  QFETCH(double, poisson);
  Scene scene(block(MeshKind(kind), std::uint32_t(width)));
  scene.material.poisson = poisson;
  std::vector<double> by{0.8, -0.6, 0.3};
  by.resize(std::size_t(scene.mesh->space_dimension));
  QVERIFY(error_from(scene, scene.moved(by), by) < 1e-6);
}

void MaterialTest::it_is_found_from_any_start_data() {
  QTest::addColumn<int>("start");
  QTest::newRow("all at one point") << 0;
  QTest::newRow("mirrored") << 1;
  QTest::newRow("scattered") << 2;
}

void MaterialTest::it_is_found_from_any_start() {
  QFETCH(int, start);
  const Scene scene(block(MeshKind::tetra, 7));
  const std::vector<double> by{0.8, -0.6, 0.3};
  std::vector<double> at = scene.moved(by);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 6);
  for (ElementId e = 0; e < scene.mesh->element_count(); ++e) {
    if (std::ranges::find(scene.pins, e) != scene.pins.end() ||
        std::ranges::find(scene.handle, e) != scene.handle.end()) {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      at[e * 3 + k] = start == 0 ? 3 : start == 2 ? number(random) : k == 2 ? 6 - at[e * 3 + k] : at[e * 3 + k];
    }
  }
  QVERIFY(error_from(scene, at, by) < 1e-6);
}

void MaterialTest::materials_that_stiffen_equal_finite_elements_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("law");
  for (const auto& [kind, name] : {std::pair(MeshKind::tetra, "solid"), std::pair(MeshKind::grid, "sheet")}) {
    QTest::addRow("Gent, %s", name) << int(kind) << int(StrainLaw::Kind::gent);
    QTest::addRow("Fung, %s", name) << int(kind) << int(StrainLaw::Kind::fung);
  }
}

void MaterialTest::materials_that_stiffen_equal_finite_elements() {
  QFETCH(int, kind);
  QFETCH(int, law);
  Scene scene(block(MeshKind(kind), 6));
  scene.material.poisson = 0.4;
  scene.law = {StrainLaw::Kind(law), 1, 1};
  std::vector<double> by{1.2, -0.6, 0.3};
  by.resize(std::size_t(scene.mesh->space_dimension));
  Body body = scene.body();
  body.set_positions(scene.moved(by));
  QVERIFY(EquilibriumSolver::make(scene.mesh->space_dimension)->solve(body, scene.handle, 1e-8, 5000));
  const std::vector<double> found = positions_of(body), right = scene.finite_elements(by);
  QVERIFY(relative_error(found, right, *scene.mesh) < 1e-6);
  scene.law = {};
  QVERIFY(relative_error(found, scene.finite_elements(by), *scene.mesh) > 1e-3);  // the law counts
}

/// An atom in light years or a galaxy in metres. The preconditioner works in float, and the squares of such lengths are
/// outside its range.
void MaterialTest::the_unit_of_length_does_not_matter() {
  const auto found = [](double unit) {
    const Scene scene(generate({MeshKind::tetra, {5, 5, 5}, unit, {}}), 1.1 * unit);
    const std::vector<double> by{0.8 * unit, -0.6 * unit, 0.3 * unit};
    Body body = scene.body();
    body.set_positions(scene.moved(by));
    const bool reached = EquilibriumSolver::make(3)->solve(body, scene.handle, 1e-8, 1000);
    std::vector<double> at = positions_of(body);
    std::ranges::for_each(at, [unit](double& one) { one /= unit; });
    return reached ? at : std::vector<double>(at.size());
  };
  const MeshPointer mesh = generate({MeshKind::tetra, {5, 5, 5}, 1, {}});
  const std::vector<double> right = found(1);
  for (const double unit : {1e-20, 1e20}) {
    const double error = relative_error(found(unit), right, *mesh);
    QVERIFY2(error < 1e-6, qPrintable(QString("%1 for %2").arg(error).arg(unit)));
  }
}

void MaterialTest::it_is_found_after_half_the_width_in_one_move() {
  for (const double poisson : {0.3, 0.45}) {
    Scene scene(block(MeshKind::tetra, 9), 1.5);
    scene.material.poisson = poisson;
    const std::vector<double> by{3.2, -2.4, 0};
    QVERIFY(error_from(scene, scene.moved(by), by) < 1e-6);
  }
}

void MaterialTest::a_prediction_goes_on_with_the_last_frame() {
  using Frame = Vectors<1>;
  const auto frame = [](double held, double free) {
    Frame result(2);
    result[0][0] = held;
    result[1][0] = free;
    return result;
  };
  const std::vector<std::uint8_t> fixed{1, 0};
  LinearPrediction<1> prediction;
  const auto predicted = [&](Frame at, Frame motion, bool has_converged = true) {
    const bool predicts = prediction.predict(at, motion, fixed, has_converged, {});
    return std::tuple(predicts, at[0][0], at[1][0], motion[0][0]);
  };
  QVERIFY(predicted(frame(0, 0), frame(2, 0)) == std::tuple(false, 0.0, 0.0, 2.0));  // the first frame
  QVERIFY(predicted(frame(2, 1), frame(1, 0)) == std::tuple(true, 3.0, 1.5, 0.0));
  QVERIFY(predicted(frame(3, 2), frame(-1, 0)) == std::tuple(true, 2.0, 1.0, 0.0));    // back to the frame before
  QVERIFY(predicted(frame(2, 1), frame(-9, 0)) == std::tuple(true, 0.0, -1.0, -7.0));  // at most twice as far
  QVERIFY(predicted(frame(-7, 0), frame(1, 0), false) == std::tuple(false, -7.0, 0.0, 1.0));
  QVERIFY(predicted(frame(-6, 1), frame(1, 0)) == std::tuple(false, -6.0, 1.0, 1.0));  // the last one had not converged
  prediction.forget();
  QVERIFY(predicted(frame(-5, 2), frame(1, 0)) == std::tuple(false, -5.0, 2.0, 1.0));
}

void MaterialTest::a_later_move_begins_near_its_end() {
  const Scene scene(block(MeshKind::tetra, 9), 1.5);
  const auto error_of_one_iteration = [&](int before) {  // frames that converged before
    Body body = scene.body();
    const auto solver = EquilibriumSolver::make(3);
    for (int frame = 3 - before; frame <= 3; ++frame) {
      move_handle(body, scene, {0.4 * frame, -0.3 * frame, 0});
      frame < 3 ? void(solver->solve(body, scene.handle, 1e-4, 1000)) : solver->iterate(body, scene.handle);
    }
    return relative_error(positions_of(body), scene.finite_elements(std::vector<double>{1.2, -0.9, 0}), *scene.mesh);
  };
  const double extended = error_of_one_iteration(1), predicted = error_of_one_iteration(2);
  QVERIFY2(predicted < extended / 4, qPrintable(QString("%1 against %2").arg(predicted).arg(extended)));
}

void MaterialTest::where_a_drag_ends_does_not_depend_on_its_way() {
  const Scene scene(block(MeshKind::tetra, 7), 1.5);
  Body body = scene.body();
  const auto solver = EquilibriumSolver::make(3);
  for (const double share : {0.2, 0.5, 0.9, 1.6, 1.2, 1.1, 1.0}) {  // farther, and back
    move_handle(body, scene, {1.2 * share, -0.9 * share, 0.3 * share * share});
    solver->solve(body, scene.handle, share == 1 ? 1e-8 : 1e-2, 1000);
  }
  const std::vector<double> right = scene.finite_elements(std::vector<double>{1.2, -0.9, 0.3});
  QVERIFY(relative_error(positions_of(body), right, *scene.mesh) < 1e-6);
}

void MaterialTest::positions_that_are_set_end_a_drag() {
  const Scene scene(block(MeshKind::tetra, 7), 1.5);
  Body body = scene.body();
  const auto solver = EquilibriumSolver::make(3);
  for (const double share : {0.5, 1.0}) {
    move_handle(body, scene, {share, 0, 0});
    solver->solve(body, scene.handle, 1e-4, 1000);
  }
  Body other = scene.body();
  other.set_positions(positions_of(body));
  body.set_positions(positions_of(body));
  const auto fresh = EquilibriumSolver::make(3);
  fresh->iterate(other, scene.handle);
  solver->iterate(body, scene.handle);
  move_handle(body, scene, {1.5, 0, 0});
  move_handle(other, scene, {1.5, 0, 0});
  fresh->iterate(other, scene.handle);
  solver->iterate(body, scene.handle);
  QVERIFY(positions_of(body) == positions_of(other));
}

void MaterialTest::no_iteration_raises_the_energy() {
  const Scene scene(block(MeshKind::tetra, 7), 1.5);
  Body body = scene.body();
  body.set_positions(scene.moved(std::vector<double>{2.4, -1.8, 0}));
  const auto solver = EquilibriumSolver::make(3);
  double last = energy_of(body);
  for (int i = 0; i < 40; ++i) {
    solver->iterate(body, scene.handle);
    const double now = energy_of(body);
    QVERIFY2(now <= last * (1 + 1e-12), qPrintable(QString("iteration %1: %2 after %3").arg(i).arg(now).arg(last)));
    last = now;
  }
  QVERIFY(solver->residual() < 1e-3);
}

void MaterialTest::a_change_of_the_material_moves_the_minimum() {
  Scene scene(block(MeshKind::tetra, 5));
  const std::vector<double> by{0.8, -0.6, 0.3};
  Body body = scene.body();
  body.set_positions(scene.moved(by));
  const auto solver = EquilibriumSolver::make(3);
  QVERIFY(solver->solve(body, scene.handle, 1e-8, 1000));
  const std::vector<double> before = positions_of(body);
  scene.material.poisson = 0.45;
  body.set_elastic({scene.material});
  QVERIFY(solver->solve(body, scene.handle, 1e-8, 1000));
  const std::vector<double> right = scene.finite_elements(by);
  QVERIFY(relative_error(positions_of(body), right, *scene.mesh) < 1e-6);
  QVERIFY(relative_error(before, right, *scene.mesh) > 1e-3);
}

/// Cancels at each place where the work can be cancelled: while all is prepared, and after a change of the material.
void MaterialTest::what_was_cancelled_is_prepared_later() {
  Scene scene(block(MeshKind::tetra, 6));
  const std::vector<double> by{0.8, -0.6, 0.3};
  int cancelled = 0;
  const auto solve = [&](int reports) {
    Body body = scene.body();
    body.set_positions(scene.moved(by));
    const auto solver = EquilibriumSolver::make(3);
    for (const double poisson : {0.3, 0.45}) {
      body.set_elastic({Material{1, poisson}});
      Progress work;
      work = Progress::watched([&, left = reports](double, const std::string&) mutable {
        if (--left == 0) {
          work.cancel();
        }
      });
      try {
        solver->iterate(body, scene.handle, work);
      } catch (const Cancelled&) {
        ++cancelled;
      }
      solver->solve(body, scene.handle, 1e-9, 1000);
    }
    return positions_of(body);
  };
  const std::vector<double> right = solve(0);
  QCOMPARE(cancelled, 0);
  int last = -1;
  for (int reports = 1; last != cancelled; ++reports) {
    last = cancelled;
    QVERIFY2(relative_error(solve(reports), right, *scene.mesh) < 1e-6, std::to_string(reports).c_str());
  }
  QVERIFY(cancelled > 15);
}

void MaterialTest::a_cut_gives_the_minimum_of_the_cut_object() {
  const Scene scene(block(MeshKind::tetra, 7), 1.5);
  const std::vector<double> by{1.5, -1, 0};
  Body body = scene.body();
  body.set_positions(scene.moved(by));
  const auto solver = EquilibriumSolver::make(3);
  QVERIFY(solver->solve(body, scene.handle, 1e-8, 5000));
  std::vector<LinkId> cut;  // half of a plane
  for (LinkId link = 0; link < scene.mesh->link_count(); ++link) {
    const Eigen::VectorXd a = scene.rest(scene.mesh->links[link][0]), b = scene.rest(scene.mesh->links[link][1]);
    if ((a[0] - 2.5) * (b[0] - 2.5) < 0 && a[1] + b[1] > 6) {
      cut.push_back(link);
    }
  }
  const std::vector<double> whole = positions_of(body);
  body.cut(cut);
  QVERIFY(solver->solve(body, scene.handle, 1e-8, 5000));
  QVERIFY(!solver->has_prepared());  // the multigrid was repaired
  QVERIFY(relative_error(positions_of(body), scene.finite_elements(by, body.cuts()), *scene.mesh) < 1e-6);
  QVERIFY(relative_error(positions_of(body), whole, *scene.mesh) > 1e-3);
  body.uncut(cut);
  QVERIFY(solver->solve(body, scene.handle, 1e-8, 5000));
  QVERIFY(relative_error(positions_of(body), whole, *scene.mesh) < 1e-6);
}

void MaterialTest::a_cut_changes_the_energy_by_its_cells_data() {
  QTest::addColumn<MeshKind>("kind");
  QTest::newRow("tetrahedra") << MeshKind::tetra;
  QTest::newRow("hexahedra") << MeshKind::block;
}

/// Cuts of all links of an element, of every other one, which leaves loose links, and their undoing, without a whole
/// evaluation in between.
void MaterialTest::a_cut_changes_the_energy_by_its_cells() {
  QFETCH(MeshKind, kind);
  const MeshPointer mesh = block(kind, 5);
  std::mt19937 random(3);
  const auto made = [&] {
    MaterialEnergy<3> energy;
    energy.build(mesh);
    energy.set_material({});
    return energy;
  };
  Vectors<3> at(mesh->element_count());
  for (auto& one : at) {
    for (int k = 0; k < 3; ++k) {
      one[k] = std::uniform_real_distribution<double>(-0.3, 0.3)(random);
    }
  }
  MaterialEnergy<3> kept = made();
  Vectors<3> force, expected;
  Cuts cuts(mesh);
  double value = kept.evaluate(at, &force);
  for (int round = 0; round < 8; ++round) {
    for (int twice = 0; twice < 2; ++twice) {
      const ElementId lone = random() % mesh->element_count();
      for (EntryId entry = mesh->first_entry[lone]; entry < mesh->first_entry[lone + 1]; ++entry) {
        const LinkId link = mesh->entry_link[entry];
        const bool is_cut = round % 3 == 0 || (round % 3 == 1 && entry % 2 == 0);
        is_cut ? cuts.cut(link) : cuts.uncut(link);
      }
      kept.set_cuts(cuts);
    }
    value += kept.add_changes(at, force);
    MaterialEnergy<3> anew = made();
    anew.set_cuts(cuts);
    const double whole = anew.evaluate(at, &expected);
    QVERIFY2(std::abs(value - whole) <= 1e-12 * whole, qPrintable(QString("%1, not %2").arg(value).arg(whole)));
    double largest = 0, apart = 0;
    for (ElementId e = 0; e < at.size(); ++e) {
      largest = std::max(largest, expected[e].norm());
      apart = std::max(apart, (force[e] - expected[e]).norm());
    }
    QVERIFY2(apart <= 1e-12 * largest, qPrintable(QString("%1 of %2").arg(apart).arg(largest)));
    QVERIFY(kept.least_volume() <= anew.least_volume());
  }
}

void MaterialTest::a_turned_object_has_no_energy() {
  Scene scene(block(MeshKind::tetra, 5));
  std::vector<double> at = scene.mesh->rest;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (ElementId e = 0; e < scene.mesh->element_count(); ++e) {
    Eigen::Map<Eigen::Vector3d> one(at.data() + 3 * std::size_t{e});
    one = turn * one + Eigen::Vector3d(10, 20, 30);
  }
  Body body = scene.body();
  body.set_positions(at);
  QVERIFY(std::abs(energy_of(body)) < 1e-12);
  at[3 * 62] += 0.3;  // an element in the middle
  body.set_positions(at);
  QVERIFY(EquilibriumSolver::make(3, false)->solve(body, scene.handle, 1e-8, 1000));  // regions do not turn
  QVERIFY(std::abs(energy_of(body)) < 1e-9);
}

void MaterialTest::links_without_cells_keep_their_length() {
  // The links of a column of elements stay when all cells along it are gone.
  const Scene scene(block(MeshKind::tetra, 4));
  Body body = scene.body();
  const ElementId corner = 3;  // on the right side
  std::vector<LinkId> cut;
  const auto [first, last] = std::pair(scene.mesh->first_entry[corner], scene.mesh->first_entry[corner + 1]);
  for (EntryId entry = first + 1; entry < last; ++entry) {
    cut.push_back(scene.mesh->entry_link[entry]);
  }
  body.cut(cut);
  std::vector<double> at = scene.mesh->rest;
  at[3 * std::size_t{corner}] += 2;
  body.set_positions(at);
  QVERIFY(EquilibriumSolver::make(3)->solve(body, scene.handle, 1e-8, 1000));
  const ElementId other = scene.mesh->neighbours[first];
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double apart = body.positions()(corner, k) - body.positions()(other, k);
    square += apart * apart;
  }
  QVERIFY(std::abs(std::sqrt(square) - rest_length(*scene.mesh, scene.mesh->entry_link[first])) < 1e-6);
}

void MaterialTest::regions_bind_where_they_bind() {
  const Scene scene(block(MeshKind::tetra, 6), 1.5);
  Body body = scene.body();
  body.set_softness(Softness{{0.8, 1.3, 0.3}, {}, EnergyKind::material});
  const std::vector<double> by{1.2, -0.9, 0};
  body.set_positions(scene.moved(by));
  const auto solver = EquilibriumSolver::make(3);
  const bool reached = solver->solve(body, scene.handle, 1e-6, 3000);
  const auto certificate = solver->certificate(body);
  QVERIFY(certificate && certificate->binds);
  qInfo("%d iterations, residual %g, violation %g", certificate->iterations, certificate->residual,
        certificate->violation);
  QVERIFY(reached);
  QVERIFY(certificate->violation < 1e-6);
  // No valid state near it has less energy.
  const double least = energy_of(body);
  const std::vector<double> at = positions_of(body);
  std::mt19937 random(5);
  std::normal_distribution<double> number(0, 1);
  int tried = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> near = at;
    const ElementId e = ElementId(random() % scene.mesh->element_count());
    if (body.is_pinned(e) || std::ranges::find(scene.handle, e) != scene.handle.end()) {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      near[3 * e + k] += 0.003 * number(random);
    }
    body.set_positions(near);
    if (measure_violation(*scene.mesh, body.softness(), body.cuts(), body.positions()).fraction == 0) {
      ++tried;
      QVERIFY(energy_of(body) >= least * (1 - 1e-7));
    }
  }
  QVERIFY(tried > 50);
  // Released, the regions' forces end, and it goes back to rest.
  body.set_positions(at);
  QVERIFY(solver->solve(body, scene.handle, 1e-6, 3000));
  QVERIFY(solver->solve(body, {}, 1e-6, 3000));
  QVERIFY(energy_of(body) < 1e-12);
}

void MaterialTest::a_handle_of_one_element_equals_finite_elements() {
  Scene scene(block(MeshKind::tetra, 7));
  const std::vector<double> by{0.8, -0.6, 0.3};
  for (const ElementId handle :
       {scene.mesh->element_count() - 1, scene.mesh->element_count() / 2}) {  // a corner, the middle
    scene.handle = {handle};
    QVERIFY(error_from(scene, scene.moved(by), by) < 1e-6);
  }
}

void MaterialTest::threads_change_no_bit() {
  const Scene scene(block(MeshKind::tetra, 26), 3);  // large enough for helpers, and for several parts of each loop
  std::vector<double> once;
  for (const int threads : {1, 2, 4}) {
    Body body = scene.body();
    body.set_positions(scene.moved(std::vector<double>{2, -1, 1}));
    const auto solver = EquilibriumSolver::make(3);
    solver->set_threads(threads);
    for (int i = 0; i < 6; ++i) {
      solver->iterate(body, scene.handle);
      if (i == 2) {
        body.cut(std::vector<LinkId>{20'000, 20'001, 20'002, 20'003, 20'004});
      }
    }
    const std::vector<double> at = positions_of(body);
    QVERIFY(once.empty() || at == once);
    once = at;
  }
}

void MaterialTest::random_scenes_equal_finite_elements() {
  int compared = 0;
  QVERIFY(check_property(
      "random pins, cuts and handles have the minimum of finite elements",
      [&] {
        Scene scene(block(*rc::gen::element(MeshKind::tetra, MeshKind::block), *rc::gen::inRange<std::uint32_t>(3, 6)));
        scene.material.poisson = *rc::gen::element(0.0, 0.3, 0.45);
        const ElementId count = scene.mesh->element_count();
        const auto more = *rc::gen::container<std::vector<ElementId>>(4, rc::gen::inRange<ElementId>(0, count));
        for (const ElementId e : more) {
          if (std::ranges::find(scene.pins, e) == scene.pins.end() &&
              std::ranges::find(scene.handle, e) == scene.handle.end()) {
            scene.pins.push_back(e);
          }
        }
        std::ranges::sort(scene.pins);
        std::vector<double> by;
        for (int k = 0; k < 3; ++k) {
          by.push_back(0.01 * *rc::gen::inRange(-25, 26));
        }
        RC_PRE(std::ranges::any_of(by, [](double one) { return one != 0; }));
        Body body = scene.body();
        body.set_positions(scene.moved(by));
        const auto solver = EquilibriumSolver::make(3);
        solver->iterate(body, scene.handle);
        body.cut(*rc::gen::container<std::vector<LinkId>>(3, rc::gen::inRange<LinkId>(0, scene.mesh->link_count())));
        std::vector<double> expected;
        try {
          expected = scene.finite_elements(by, body.cuts());
        } catch (const Error&) {
          return;  // a part without pins
        }
        RC_ASSERT(solver->solve(body, scene.handle, 1e-8, 5000));
        // Elements that no cell holds stay at rest in finite elements.
        const CellSimplices cells = build_cell_simplices(*scene.mesh);
        std::vector<bool> in_cell(count);
        for (std::size_t s = 0; s < cells.simplices.count(); ++s) {
          const bool whole = std::ranges::none_of(cells.links_of(cells.cell_of[s]),
                                                  [&](LinkId link) { return body.cuts().is_cut(link); });
          for (const ElementId e : cells.simplices.corners_of(s)) {
            in_cell[e] = in_cell[e] || whole;
          }
        }
        const std::vector<double> found = positions_of(body);
        for (ElementId e = 0; e < count; ++e) {
          for (std::size_t k = 0; in_cell[e] && k < 3; ++k) {
            RC_ASSERT(std::abs(found[3 * e + k] - expected[3 * e + k]) < 1e-5);
          }
        }
        ++compared;
      },
      60));
  QVERIFY(compared > 20);
}

CHAINMAIL_TEST(MaterialTest)

}  // namespace chainmail::test_material

#include "test_material.moc"
