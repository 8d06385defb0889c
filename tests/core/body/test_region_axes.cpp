#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <functional>
#include <numbers>

#include "body/region_axes.h"
#include "core/families.h"
#include "core/simulations.h"
#include "equilibrium/link_energy.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_region_axes {

using namespace chainmail::test;

namespace {

/// A rotation about an axis, in degrees.
Point turn(const Point& axis, double degrees) { return axis.normalized() * (degrees * std::numbers::pi / 180); }

Eigen::Matrix3d matrix_of(const Point& rotation) { return RegionAxes(AxesKind::given, rotation).matrix(); }

/// The object of a mesh after a rotation about the origin.
MeshPointer turned_mesh(const MeshPointer& mesh, const Point& rotation) {
  MeshParts parts = placed(*mesh, [&](const Point& position) { return Point(matrix_of(rotation) * position); });
  parts.space_dimension = mesh->space_dimension;
  parts.triangles.assign(mesh->triangles.begin(), mesh->triangles.begin() + std::ptrdiff_t(mesh->own_triangles));
  parts.tetrahedra = mesh->tetrahedra;
  return build_mesh(std::move(parts));
}

/// What is done to an object: pins, cuts and drags, all turned by `rotation`, with regions in `axes`.
struct Scene {
  MeshPointer mesh;
  std::vector<ElementId> pins, handle;
  std::vector<LinkId> cuts;
  std::vector<Pose> moves;
};

std::unique_ptr<Deformer> played(const Scene& scene, Algorithm algorithm, Precision precision, const RegionAxes& axes,
                                 const Point& rotation) {
  auto solver = std::make_unique<Deformer>(rotation == Point::Zero() ? scene.mesh : turned_mesh(scene.mesh, rotation),
                                           algorithm, precision);
  solver->body().set_softness(Softness{{0.8, 1.2, 0.1}, {}, standard_energy, axes});
  solver->body().pin(scene.pins);
  solver->body().cut(scene.cuts);
  Handle handle(solver->body(), scene.handle);
  const Pose grabbed = handle.grabbed();
  for (const Pose& move : scene.moves) {
    solver->move(handle, {grabbed.pivot + matrix_of(rotation) * move.pivot, matrix_of(rotation) * move.rotation});
  }
  return solver;
}

/// Returns the largest distance between an answer and that of the turned object, turned back (mean rest lengths).
double difference(const Deformer& one, const Deformer& turned, const Point& rotation) {
  const Mesh& mesh = one.body().mesh();
  double largest = 0;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point back = matrix_of(rotation).transpose() * point_of(turned.body().mesh(), turned.body().positions(), e);
    largest = std::max(largest, (back - point_of(mesh, one.body().positions(), e)).norm());
  }
  return largest / mesh.mean_link_length;
}

double violation_of(const Deformer& solver) {
  const Body& body = solver.body();
  return measure_violation(body.mesh(), body.softness(), body.cuts(), body.positions()).max;
}

Scene plane_scene() {
  const MeshPointer mesh = jittered_triangles(13, 9, 7);
  Scene scene{mesh, {0, 13, 26}, {60, 61, 73}, {10, 40, 41, 90}, {}};
  scene.moves = {{Point(2, 1, 0), Point::Zero()}, {Point(4, -1.5, 0), turn(Point(0, 0, 1), 20)}};
  return scene;
}

Scene space_scene() {
  const MeshPointer mesh = generate({MeshKind::tetra, {9, 5, 4}, 1, {}});
  Scene scene{mesh, {0, 9, 45}, {170}, {20, 100, 230}, {}};
  scene.moves = {{Point(1.5, 1, 0.5), Point::Zero()}, {Point(4, 2.5, -1), Point::Zero()}};
  return scene;
}

}  // namespace

/// Valid regions along axes of the object.
class RegionAxesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_turned_object_answers_as_the_object_does_data();
  void a_turned_object_answers_as_the_object_does();
  void a_rotated_handle_is_where_its_motion_puts_it_after_a_cut();
  void without_a_frame_a_turned_object_answers_differently();
  void principal_axes_turn_with_the_object();
  void principal_axes_of_a_symmetric_object_are_those_of_the_world();
  void an_identity_frame_gives_the_same_bits();
  void world_coordinates_come_back();
  void far_from_the_origin_exact_keeps_its_digits();
  void relaxation_and_equilibrium_turn_with_the_object();
  void a_snapshot_of_another_frame_is_restored();
  void undo_restores_the_frame_exactly();
  void elastic_methods_work_along_the_axes_of_the_world();
  void a_frame_that_leaves_the_plane_is_refused();
};

void RegionAxesTest::a_turned_object_answers_as_the_object_does_data() {
  QTest::addColumn<bool>("in_space");
  QTest::addColumn<Algorithm>("algorithm");
  QTest::addColumn<double>("degrees");
  for (const bool in_space : {false, true}) {
    for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
      for (const double degrees : {45.0, 30.0, 90.0}) {
        QTest::addRow("%s, %s, %g°", in_space ? "space" : "plane", std::string(info(algorithm).name).c_str(), degrees)
            << in_space << algorithm << degrees;
      }
    }
  }
}

void RegionAxesTest::a_turned_object_answers_as_the_object_does() {
  QFETCH(const bool, in_space);
  QFETCH(const Algorithm, algorithm);
  QFETCH(const double, degrees);
  const Scene scene = in_space ? space_scene() : plane_scene();
  const Point rotation = turn(in_space ? Point(1, 2, 3) : Point(0, 0, 1), degrees);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const auto one = played(scene, algorithm, precision, {}, Point::Zero());
    const auto other = played(scene, algorithm, precision, {AxesKind::given, rotation}, rotation);
    QVERIFY2(difference(*one, *other, rotation) < 1e-4,
             qPrintable(QString::number(difference(*one, *other, rotation))));
    QVERIFY(std::abs(violation_of(*one) - violation_of(*other)) < 1e-4);
    if (algorithm == Algorithm::exact && scene.handle.size() == 1) {
      QVERIFY(violation_of(*other) < 1e-5);
    }
    const auto energy = [](const Deformer& solver) {
      const Body& body = solver.body();
      return elastic_energy(body.mesh(), body.softness(), body.cuts(), body.positions());
    };
    QVERIFY(std::abs(energy(*one) - energy(*other)) < 1e-3 * energy(*one));
  }
}

/// A cut while dragging: the next pass begins anew, with a handle that has rotated already.
void RegionAxesTest::a_rotated_handle_is_where_its_motion_puts_it_after_a_cut() {
  const Scene scene = space_scene();
  const auto solver = std::make_unique<Deformer>(scene.mesh, Algorithm::exact, Precision::double_precision);
  Body& body = solver->body();
  body.set_softness(Softness{{0.7, 1.3, 0.4}, {}, standard_energy, {AxesKind::given, turn(Point(1, 2, 3), 40)}});
  Handle handle(body, {160, 169, 170});
  for (const double degrees : {4.0, 9.0}) {
    const Pose target{handle.grabbed().pivot + Point(0.1, 0.02, -0.03) * degrees, turn(Point(2, 0, 1), degrees)};
    solver->move(handle, target);
    QVERIFY2(solver->remark().empty(), solver->remark().c_str());
    for (std::size_t i = 0; i < handle.elements().size(); ++i) {
      const Point at = point_of(*scene.mesh, body.positions(), handle.elements()[i]);
      const double off = (at - handle.target(i, handle.motion(target))).norm();
      QVERIFY2(off < 1e-12, qPrintable(QString::number(off)));
    }
    body.cut(scene.cuts);
  }
}

void RegionAxesTest::without_a_frame_a_turned_object_answers_differently() {
  for (const Scene& scene : {plane_scene(), space_scene()}) {
    const Point rotation = turn(Point(0, 0, 1), 45);
    for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
      const auto one = played(scene, algorithm, Precision::double_precision, {}, Point::Zero());
      const auto other = played(scene, algorithm, Precision::double_precision, {}, rotation);
      QVERIFY(difference(*one, *other, rotation) > 0.1);
    }
  }
}

void RegionAxesTest::principal_axes_turn_with_the_object() {
  for (const Scene& scene : {plane_scene(), space_scene()}) {
    const bool in_space = scene.mesh->space_dimension == 3;
    for (const double degrees : {0.0, 30.0, 45.0, 90.0, 200.0}) {
      const Point rotation = turn(in_space ? Point(1, 2, 3) : Point(0, 0, 1), degrees);
      const PrincipalAxes own = principal_axes(*scene.mesh);
      const PrincipalAxes other = principal_axes(*turned_mesh(scene.mesh, rotation));
      QVERIFY(own.are_unique && other.are_unique);
      // The axes of the one are those of the other, in any order and with any sign.
      const Eigen::Matrix3d common =
          (own.axes.matrix().transpose() * matrix_of(rotation).transpose() * other.axes.matrix()).cwiseAbs();
      QVERIFY(common.colwise().maxCoeff().minCoeff() > 1 - 1e-9);
      QVERIFY(other.axes.matrix().diagonal().minCoeff() >= 0);
      const auto one = played(scene, Algorithm::exact, Precision::double_precision, own.axes, Point::Zero());
      const auto turned = played(scene, Algorithm::exact, Precision::double_precision, other.axes, rotation);
      QVERIFY(difference(*one, *turned, rotation) < 1e-4);
    }
  }
}

void RegionAxesTest::principal_axes_of_a_symmetric_object_are_those_of_the_world() {
  const MeshPointer cube = generate({MeshKind::block, {4, 4, 4}, 1, {}});
  for (const MeshPointer& mesh : {cube, turned_mesh(cube, turn(Point(1, 2, 3), 40)), sphere(16, 9)}) {
    const PrincipalAxes axes = principal_axes(*mesh);
    QVERIFY(!axes.are_unique);
    QVERIFY(mesh->element_count() != 64 || !axes.axes.is_turned());
  }
  const MeshPointer bar = generate({MeshKind::block, {9, 3, 3}, 1, {}});
  QVERIFY(!principal_axes(*bar).axes.is_turned());
  const PrincipalAxes leaning = principal_axes(*turned_mesh(bar, turn(Point(0, 0, 1), 30)));
  QVERIFY(!leaning.are_unique);
  QVERIFY((leaning.axes.rotation() - turn(Point(0, 0, 1), 30)).norm() < 1e-9);
  QVERIFY(!principal_axes(*generate({MeshKind::grid, {8, 8, 1}, 1, {}})).axes.is_turned());
  QVERIFY(!principal_axes(*generate({MeshKind::block, {9, 5, 3}, 1, {}})).axes.is_turned());
}

void RegionAxesTest::an_identity_frame_gives_the_same_bits() {
  const Scene scene = space_scene();
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue, Algorithm::enhanced}) {
    const auto one = played(scene, algorithm, Precision::single_precision, {}, Point::Zero());
    const auto other =
        played(scene, algorithm, Precision::single_precision, principal_axes(*scene.mesh).axes, Point::Zero());
    QVERIFY(other->body().stored_mesh() == scene.mesh || principal_axes(*scene.mesh).axes.is_turned());
    const auto plain =
        played(scene, algorithm, Precision::single_precision, {AxesKind::given, Point::Zero()}, Point::Zero());
    for (ElementId e = 0; e < scene.mesh->element_count(); ++e) {
      QVERIFY(point_of(*scene.mesh, one->body().positions(), e) == point_of(*scene.mesh, plain->body().positions(), e));
    }
  }
}

void RegionAxesTest::world_coordinates_come_back() {
  const Scene scene = space_scene();
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
    auto solver = std::make_unique<Deformer>(scene.mesh, algorithm, Precision::double_precision);
    Body& body = solver->body();
    body.set_softness(Softness{{}, {}, standard_energy, {AxesKind::given, turn(Point(3, 1, 2), 50)}});
    QCOMPARE(body.positions()(7, 0), scene.mesh->rest[21]);
    std::vector<double> positions(scene.mesh->rest);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] += 0.01 * double(i % 7);
    }
    body.set_positions(positions);
    std::vector<double> read(positions.size());
    body.copy_positions(read);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      QVERIFY(std::abs(read[i] - positions[i]) < 1e-13);
    }
    // A move to where the element is moves nothing.
    QCOMPARE(solver->move(50, point_of(*scene.mesh, body.positions(), 50)).stopped, false);
    QVERIFY(std::abs(body.positions()(50, 1) - positions[151]) < 1e-13);
  }
}

void RegionAxesTest::far_from_the_origin_exact_keeps_its_digits() {
  const Scene scene = space_scene();
  MeshParts parts = placed(*scene.mesh, [](const Point& at) { return Point(at + Point(1e6, -2e6, 3e6)); });
  const MeshPointer mesh = build_mesh(std::move(parts));
  const auto axes = [](double degrees) {
    return Softness{{}, {}, standard_energy, {AxesKind::given, turn(Point(1, 2, 3), degrees)}};
  };
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::single_precision);
  solver->body().set_softness(axes(30));
  solver->move(50, mesh->rest_position(50) + Point(0.5, 0.3, 0.1));
  const double before = solver->body().positions().between(49, 50, 0);
  QVERIFY(std::abs(point_of(*mesh, solver->body().positions(), 50).x() - mesh->rest_position(50).x() - 0.5) < 1e-6);
  solver->body().set_softness(axes(70));
  QVERIFY(std::abs(solver->body().positions().between(49, 50, 0) - before) < 1e-6);
}

void RegionAxesTest::relaxation_and_equilibrium_turn_with_the_object() {
  const Point rotation = turn(Point(1, 2, 3), 30);
  for (const RelaxationScheme scheme :
       {RelaxationScheme::mean, RelaxationScheme::link, RelaxationScheme::equilibrium}) {
    const auto settled = [&](const RegionAxes& axes, const Point& by) {
      const Scene scene = space_scene();
      auto solver = played(scene, Algorithm::exact, Precision::double_precision, axes, by);
      solver->set_relaxation(scheme);
      solver->wake_all();
      if (info(scheme).sweeps) {
        for (int i = 0; i < 20; ++i) {
          solver->relax_slice(1, 1'000'000, scene.handle);
        }
      } else {
        solver->hold(scene.handle);
        solver->relax(2000, {1, scheme, 1e-9});
      }
      return solver;
    };
    const auto one = settled({}, Point::Zero()), other = settled({AxesKind::given, rotation}, rotation);
    QVERIFY2(difference(*one, *other, rotation) < 1e-4,
             qPrintable(QString::number(difference(*one, *other, rotation))));
    QVERIFY(violation_of(*other) < 1e-5);
  }
}

void RegionAxesTest::a_snapshot_of_another_frame_is_restored() {
  const Scene scene = space_scene();
  const auto from = played(scene, Algorithm::exact, Precision::double_precision,
                           {AxesKind::given, turn(Point(1, 0, 2), 25)}, Point::Zero());
  const auto to = played(scene, Algorithm::natural_queue, Precision::double_precision,
                         {AxesKind::given, turn(Point(0, 1, 2), -70)}, Point::Zero());
  ElementBlocks all(scene.mesh->element_count());
  all.insert_all();
  const Snapshot snapshot = from->body().snapshot(all);
  to->body().restore(snapshot, all);
  QVERIFY(difference(*from, *to, Point::Zero()) < 1e-12);
  // What a file has comes back to the bit.
  for (const Deformer* one : {from.get(), to.get()}) {
    const Snapshot held = one->body().snapshot(all);
    QVERIFY(held.axes.is_turned());
    QVERIFY(snapshot_of(runs_of(held, *scene.mesh), *scene.mesh, Precision::double_precision) == held);
  }
}

void RegionAxesTest::undo_restores_the_frame_exactly() {
  const Scene scene = plane_scene();
  Simulation simulation(scene.mesh, Algorithm::natural_queue, Precision::single_precision);
  simulation.apply(commands::Grab{{60}});
  simulation.apply(commands::Drag{scene.mesh->rest_position(60) + Point(3, 1, 0)});
  simulation.apply(commands::Release{});
  const auto axes = [&](double degrees) {
    return commands::SetSoftness{std::make_shared<const Softness>(
        Softness{{}, {}, standard_energy, {AxesKind::given, turn({0, 0, 1}, degrees)}})};
  };
  std::vector<std::vector<double>> states;
  const auto keep = [&](commands::StateId id) {
    simulation.apply(commands::KeepState{id});
    states.emplace_back(scene.mesh->rest.size());
    simulation.body().copy_positions(states.back());
  };
  keep(0);
  simulation.apply(axes(30));
  QVERIFY(!simulation.changed().empty());
  keep(1);
  simulation.apply(commands::Grab{{20}});
  simulation.apply(commands::Drag{scene.mesh->rest_position(20) + Point(-2, 2, 0)});
  simulation.apply(commands::Release{});
  keep(2);
  simulation.apply(axes(60));
  keep(3);
  for (const commands::StateId id : {2, 0, 3, 1, 2}) {
    simulation.apply(commands::RestoreState{id});
    std::vector<double> now(scene.mesh->rest.size());
    simulation.body().copy_positions(now);
    QVERIFY(now == states[std::size_t(id)]);
    QCOMPARE(simulation.body().region_axes().is_turned(), id != 0);
  }
}

void RegionAxesTest::elastic_methods_work_along_the_axes_of_the_world() {
  const Scene scene = space_scene();
  const auto one = played(scene, Algorithm::linear_fem, Precision::double_precision, {}, Point::Zero());
  const auto other = played(scene, Algorithm::linear_fem, Precision::double_precision,
                            {AxesKind::given, turn(Point(1, 2, 3), 30)}, Point::Zero());
  QCOMPARE(difference(*one, *other, Point::Zero()), 0.0);
  // ChainMail goes on from there along its axes.
  other->set_algorithm(Algorithm::exact);
  QVERIFY(other->body().region_axes().is_turned());
  QVERIFY(difference(*one, *other, Point::Zero()) < 1e-12);
  other->set_algorithm(Algorithm::linear_fem);
  QVERIFY(!other->body().region_axes().is_turned());
}

void RegionAxesTest::a_frame_that_leaves_the_plane_is_refused() {
  Simulation simulation(plane_scene().mesh, Algorithm::exact, Precision::single_precision);
  const auto set = [&](const Point& rotation) {
    simulation.apply(commands::SetSoftness{
        std::make_shared<const Softness>(Softness{{}, {}, standard_energy, {AxesKind::given, rotation}})});
  };
  QVERIFY_THROWS_EXCEPTION(Error, set({1, 0, 0}));
  QVERIFY_THROWS_EXCEPTION(Error, set({0, 0, std::nan("")}));
  QVERIFY(!simulation.body().region_axes().is_turned());
  set({0, 0, 1});
  QVERIFY(simulation.body().region_axes().is_turned());
}

CHAINMAIL_TEST(RegionAxesTest)

}  // namespace chainmail::test_region_axes

#include "test_region_axes.moc"
