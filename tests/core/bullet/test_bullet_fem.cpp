#include <Eigen/LU>
#include <QtTest>
#include <algorithm>
#include <cmath>

#include "bullet/deformable_fem.h"
#include "core/pinned.h"
#include "core/scenarios.h"
#include "elastic/simplices.h"

using namespace chainmail;
using namespace chainmail::test;

/// Bullet's finite elements as a method. Where they rest is compared with our own linear FEM and with the forces of the
/// published energy.
class BulletFemTest : public QObject {
  Q_OBJECT

 private slots:
  void small_strains_are_those_of_linear_fem();
  void at_rest_the_forces_of_the_published_energy_balance();
  void the_last_frames_velocity_goes_on();
  void a_cancelled_move_moves_nothing();
  void cells_with_cut_links_are_left_out();
  void a_mirrored_object_is_the_mirror_of_the_first();
  void a_plane_is_refused();
};

namespace {

Algorithm bullet_fem_number() {
  static const Algorithm added = add_algorithm(bullet_fem());
  return added;
}

std::vector<ElementId> at_end(const Mesh& mesh, int side) {
  std::vector<ElementId> found;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (mesh.rest_position(e)[0] == mesh.box[std::size_t(side)][0]) {
      found.push_back(e);
    }
  }
  return found;
}

MeshPointer bar() { return make_mesh(MeshKind::tetra, {6, 3, 3}); }

Solver solver_of(const MeshPointer& mesh, Algorithm algorithm, std::uint32_t iterations = 2000) {
  Solver solver(mesh, algorithm, Precision::double_precision);
  ElasticOptions options;
  options.iterations = iterations;
  solver.body().set_elastic(options);
  solver.body().pin(at_end(*mesh, 0));
  return solver;
}

void pull(Solver& solver, Handle& handle, const Point& by) {
  solver.move(handle, {handle.pose().pivot + by, handle.pose().rotation});
}

/// The force of each element by the energy of Smith, de Goes and Kim (2018, equation 14), and the largest force of one
/// cell on a corner.
std::pair<std::vector<Point>, double> forces_of(const Solver& solver, const Mesh& mesh) {
  const Lame material = lame(solver.body().elastic().material);
  const double mu = 4 * material.mu / 3, lambda = material.lambda + 5 * material.mu / 6;
  const Simplices cells = build_simplices(mesh, solver.body().cuts());
  std::vector<Point> forces(mesh.element_count(), Point::Zero());
  double largest = 0;
  for (std::size_t s = 0; s < cells.count(); ++s) {
    const auto corners = cells.corners_of(s);
    Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
    for (int c = 0; c < 4; ++c) {
      f += position_of(solver, mesh, corners[std::size_t(c)]) * cells.gradients_of(s).col(c).transpose();
    }
    const double j = f.determinant();
    const double offset = 1 + 3 * mu / (4 * lambda);
    const Eigen::Matrix3d stress =
        mu * (1 - 1 / (f.squaredNorm() + 1)) * f + lambda * (j - offset) * j * f.inverse().transpose();
    for (int c = 0; c < 4; ++c) {
      const Point force = -cells.volumes[s] * (stress * cells.gradients_of(s).col(c));
      forces[corners[std::size_t(c)]] += force;
      largest = std::max(largest, force.norm());
    }
  }
  return {forces, largest};
}

}  // namespace

void BulletFemTest::small_strains_are_those_of_linear_fem() {
  const MeshPointer mesh = bar();
  Solver solver = solver_of(mesh, bullet_fem_number()), linear = solver_of(mesh, *find_algorithm("fem"));
  Handle one(solver.body(), at_end(*mesh, 1)), other(linear.body(), at_end(*mesh, 1));
  const Point by(0.01, 0.02, -0.01);
  pull(solver, one, by);
  pull(linear, other, by);
  QVERIFY2(solver.remark().empty(), solver.remark().c_str());
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    QVERIFY((position_of(solver, *mesh, e) - position_of(linear, *mesh, e)).norm() < 0.03 * by.norm());
  }
}

void BulletFemTest::at_rest_the_forces_of_the_published_energy_balance() {
  const MeshPointer mesh = bar();
  Solver solver = solver_of(mesh, bullet_fem_number());
  Handle handle(solver.body(), at_end(*mesh, 1));
  pull(solver, handle, {-1, 2, 0.5});
  QVERIFY2(solver.remark().empty(), solver.remark().c_str());
  const auto [forces, largest] = forces_of(solver, *mesh);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const double x = mesh->rest_position(e)[0];
    if (x != mesh->box[0][0] && x != mesh->box[1][0]) {
      QVERIFY2(forces[e].norm() < 1e-3 * largest, qPrintable(QString::number(forces[e].norm() / largest)));
    }
  }
}

/// Two moves of a frame each to the same target are one move of two frames.
void BulletFemTest::the_last_frames_velocity_goes_on() {
  const MeshPointer mesh = bar();
  Solver once = solver_of(mesh, bullet_fem_number(), 2), twice = solver_of(mesh, bullet_fem_number(), 1);
  Handle one(once.body(), at_end(*mesh, 1)), other(twice.body(), at_end(*mesh, 1));
  pull(once, one, {0.2, 1, 0});
  pull(twice, other, {0.2, 1, 0});
  const std::vector<double> first = positions_of(twice, *mesh);
  pull(twice, other, Point::Zero());
  QVERIFY(largest_step(positions_of(twice, *mesh), first) > 1e-3);
  QVERIFY(largest_step(positions_of(twice, *mesh), positions_of(once, *mesh)) < 1e-4);  // single precision
  // Elements that something else has put elsewhere are at rest there.
  twice.body().set_positions(mesh->rest);
  Solver fresh = solver_of(mesh, bullet_fem_number(), 1);
  move_by(twice, *mesh, mesh->element_count() - 1, {0, 0.5, 0});
  move_by(fresh, *mesh, mesh->element_count() - 1, {0, 0.5, 0});
  QVERIFY(same_bits(positions_of(twice, *mesh), positions_of(fresh, *mesh)));
}

void BulletFemTest::a_cancelled_move_moves_nothing() {
  const MeshPointer mesh = bar();
  const ElementId last = mesh->element_count() - 1;
  Solver solver = solver_of(mesh, bullet_fem_number(), 3), other = solver_of(mesh, bullet_fem_number(), 3);
  move_by(solver, *mesh, last, {0.2, 1, 0});
  move_by(other, *mesh, last, {0.2, 1, 0});
  JobState job;
  job.cancelled = true;
  solver.set_progress(Progress(job));
  QVERIFY_THROWS_EXCEPTION(Cancelled, solver.move(last, mesh->rest_position(last)));
  solver.set_progress({});
  QVERIFY(same_bits(positions_of(solver, *mesh), positions_of(other, *mesh)));
  for (Solver* one : {&solver, &other}) {
    one->move(last, mesh->rest_position(last) + Point(0.4, 1, 0));
  }
  QVERIFY(same_bits(positions_of(solver, *mesh), positions_of(other, *mesh)));
}

/// Behind a cut through the whole object, nothing moves.
void BulletFemTest::cells_with_cut_links_are_left_out() {
  const MeshPointer mesh = bar();
  Solver solver = solver_of(mesh, bullet_fem_number());
  const double middle = (mesh->box[0][0] + mesh->box[1][0]) / 2;
  std::vector<LinkId> cut;
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    const auto& [a, b] = mesh->links[link];
    if ((mesh->rest_position(a)[0] < middle) != (mesh->rest_position(b)[0] < middle)) {
      cut.push_back(link);
    }
  }
  solver.body().cut(cut);
  solver.body().pin(at_end(*mesh, 0));
  Handle handle(solver.body(), at_end(*mesh, 1));
  pull(solver, handle, {0.5, 1, 0});
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const double way = (position_of(solver, *mesh, e) - mesh->rest_position(e)).norm();
    QVERIFY2(mesh->rest_position(e)[0] < middle ? way < 1e-5 : way > 0.1, qPrintable(QString::number(way)));
  }
}

/// Its tetrahedra have the other orientation.
void BulletFemTest::a_mirrored_object_is_the_mirror_of_the_first() {
  const MeshPointer mesh = bar();
  const auto mirrored = [](const Point& at) { return Point(at[0], -at[1], at[2]); };
  const Simplices cells = build_simplices(*mesh, {});
  MeshParts parts;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    parts.rest.push_back(mirrored(mesh->rest_position(e)));
  }
  for (std::size_t s = 0; s < cells.count(); ++s) {
    std::ranges::copy(cells.corners_of(s), parts.tetrahedra.emplace_back().begin());
  }
  const MeshPointer other_mesh = build_mesh(std::move(parts));
  Solver solver = solver_of(mesh, bullet_fem_number()), other = solver_of(other_mesh, bullet_fem_number());
  Handle one(solver.body(), at_end(*mesh, 1)), two(other.body(), at_end(*other_mesh, 1));
  pull(solver, one, {0.2, 1, 0});
  pull(other, two, {0.2, -1, 0});
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    QVERIFY((mirrored(position_of(other, *other_mesh, e)) - position_of(solver, *mesh, e)).norm() < 1e-3);
  }
}

void BulletFemTest::a_plane_is_refused() {
  const MeshPointer mesh = make_mesh(MeshKind::cloth, {4, 4, 1});
  Solver solver = solver_of(mesh, bullet_fem_number());
  QCOMPARE(refusal([&] { solver.move(15, mesh->rest_position(15)); }),
           std::string("Bullet FEM: it has elements for objects in space only; use another algorithm for this object"));
}

QTEST_APPLESS_MAIN(BulletFemTest)
#include "test_bullet_fem.moc"
