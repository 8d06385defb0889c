#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "body/body_view.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/local_relaxation.h"
#include "equilibrium/simplex_batches.h"
#include "mesh/cells.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/scattered.h"
#include "program.h"

namespace chainmail::test_local_relaxation {

using namespace chainmail::test;

/// The minimum over fewer unknowns, against the equilibrium of all elements.
class LocalRelaxationTest : public QObject {
  Q_OBJECT

 private slots:
  void the_force_is_the_slope_of_the_energy();
  void cubes_of_each_level_hold_the_object_data();
  void cubes_of_each_level_hold_the_object();
  void fine_everywhere_it_is_the_equilibrium_data();
  void fine_everywhere_it_is_the_equilibrium();
  void the_error_is_small_data();
  void the_error_is_small();
  void a_cut_opens();
  void cubes_know_the_cuts_of_before();
  void many_cuts_between_two_drags_need_new_cubes();
  void it_is_for_open_regions_of_all_links();
  void an_object_without_whole_cells_stays_at_rest();
  void two_branches_in_one_cube_are_apart();
  void no_cell_is_inverted();
  void two_runs_have_the_same_bits();
  void loops_there_and_back_end_where_they_began();
  void the_unit_of_length_does_not_matter();
  void a_rod_bends();
  void it_starts_where_the_object_is();
  void parts_far_apart_take_as_much_memory_as_near_ones();
  void flat_cells_do_not_count();
  void an_object_whose_volume_is_no_number_is_left_to_others();
};

namespace {

using Grid = std::array<std::uint32_t, 3>;  // elements along each axis

MeshPointer block(const Grid& size, MeshKind kind = MeshKind::tetra) { return generate({kind, size, 1, {}}); }

/// A block of tetrahedra without those whose centres are outside, and with its elements changed.
template <class Inside, class Move>
MeshPointer carved(const Grid& size, Inside inside, Move move) {
  const MeshPointer mesh = block(size);
  MeshParts parts;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    parts.rest.push_back(move(mesh->rest_position(e), e));
  }
  for (const auto& cell : mesh->tetrahedra) {
    Point centre = Point::Zero();
    for (const ElementId e : cell) {
      centre += mesh->rest_position(e) / 4;
    }
    if (inside(centre)) {
      parts.tetrahedra.push_back(cell);
    }
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

MeshPointer jittered(const Grid& size) {
  return carved(
      size, [](const Point&) { return true; },
      [&](Point at, ElementId e) {
        for (int k = 0; k < 3; ++k) {
          const bool is_inner = at[k] > 0.5 && at[k] < double(size[std::size_t(k)]) - 1.5;
          const std::uint64_t seed = scatter_step * (3 * std::uint64_t{e} + std::uint64_t(k));
          at[k] += is_inner ? 0.4 * (double(scattered(seed) >> 11) * 0x1p-53 - 0.5) : 0;
        }
        return at;
      });
}

/// A fork: two prongs along x, one layer of cells apart.
MeshPointer fork() {
  return carved(
      {33, 20, 17}, [](const Point& c) { return c[0] < 8 || c[1] < 9 || c[1] > 10; },
      [](const Point& at, ElementId) { return at; });
}

/// An object, pinned at its left side, and a handle that follows a curve.
struct Scene {
  MeshPointer mesh;
  std::vector<ElementId> held;
  double far = 3;

  /// Holds the elements near a place.
  Scene(MeshPointer object, const Point& middle, double radius, double distance) : mesh(object), far(distance) {
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      if ((mesh->rest_position(e) - middle).norm() <= radius) {
        held.push_back(e);
      }
    }
  }
  Body body() const {
    Body result(mesh, Precision::double_precision);
    result.set_softness(Softness{{0, 1000, 1000}, {}, EnergyKind::material});
    result.pin(layer(*mesh, *find_side("left")));
    return result;
  }
  void move(Body& body, double part) const {
    const std::array<double, 3> by{0.3 * far * part * (1 - part), 0.2 * far * part * part, far * part};
    body.with_view([&]<class View>(const View& view) {
      if constexpr (View::Dimension == 3) {
        for (const ElementId e : held) {
          for (int k = 0; k < 3; ++k) {
            view.set_position(e, k, mesh->rest[std::size_t{e} * 3 + std::size_t(k)] + by[std::size_t(k)]);
          }
        }
      }
    });
    body.note_move();
  }
};

Scene block_scene() { return {block({33, 25, 25}), Point(24, 12, 24), 2.1, 3}; }

std::vector<double> displacements(const Body& body) {
  std::vector<double> at(body.mesh().rest.size());
  body.copy_positions(at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] -= body.mesh().rest[i];
  }
  return at;
}

double difference(const std::vector<double>& is, const std::vector<double>& should) {
  double apart = 0, all = 0;
  for (std::size_t i = 0; i < is.size(); ++i) {
    apart += std::pow(is[i] - should[i], 2);
    all += std::pow(should[i], 2);
  }
  return std::sqrt(apart / all);
}

/// The links across a plane beside the handle of the block.
std::vector<LinkId> wound_of(const Mesh& mesh) {
  std::vector<LinkId> wound;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const Point a = mesh.rest_position(mesh.links[link][0]), b = mesh.rest_position(mesh.links[link][1]);
    if ((a[0] < 27.5) != (b[0] < 27.5) && std::abs(a[1] - 12) < 7.5 && a[2] > 13.5) {
      wound.push_back(link);
    }
  }
  return wound;
}

std::vector<double> equilibrium(const Scene& scene, double part, std::span<const LinkId> cuts = {}) {
  Body body = scene.body();
  body.cut(cuts);
  const auto solver = EquilibriumSolver::make(3, false);
  for (const double share : {0.5, 1.0}) {
    scene.move(body, share * part);
    solver->solve(body, scene.held, 1e-4, 200);
  }
  return displacements(body);
}

struct Answer {
  std::vector<double> at;
  LocalRelaxation::Result last;
};
/// Drags in ten frames.
Answer dragged(const Scene& scene, const LocalRelaxation::Options& options = {}) {
  Body body = scene.body();
  LocalRelaxation relaxation(body, options);
  Answer answer;
  for (int i = 1; i <= 10; ++i) {
    scene.move(body, i / 10.0);
    answer.last = relaxation.update(body, scene.held);
  }
  relaxation.finish(body);
  answer.at = displacements(body);
  return answer;
}

double least_volume(const Mesh& mesh, const std::vector<double>& displacements) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& cell : mesh.tetrahedra) {
    std::array<Point, 4> rest, now;
    for (std::size_t i = 0; i < 4; ++i) {
      rest[i] = mesh.rest_position(cell[i]);
      now[i] = rest[i] + Point::Map(displacements.data() + std::size_t{cell[i]} * 3);
    }
    const auto volume = [](const auto& at) { return (at[1] - at[0]).cross(at[2] - at[0]).dot(at[3] - at[0]); };
    least = std::min(least, volume(now) / volume(rest));
  }
  return least;
}

/// A tetrahedron with edges along the axes, in one lane of a batch, whose energy is continued below half its volume.
struct OneTetrahedron {
  OneTetrahedron() {
    for (std::size_t lane = 0; lane < SimplexBatch<3>::lanes; ++lane) {
      least.at[lane] = 0.5;
      for (std::size_t i = 0; i < 4; ++i) {
        batch.corner[i][lane] = std::uint32_t(i);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        batch.gradient[i][i].at[lane] = 1;
      }
    }
    batch.volume.at[2] = 1.0 / 6;
  }
  /// Returns the energy.
  double evaluate(std::vector<FourNumbers>* force, BatchInstructions instructions = batch_instructions()) const {
    FourNumbers ratios;
    const BatchDensity density{true, moduli, &extended, &least, &ratios};
    return evaluate_batches<3>({&batch, 1}, density, at.data(), force != nullptr ? force->data() : nullptr,
                               instructions)
        .energy;
  }

  Lame moduli = lame({1, 0.3});
  ExtendedDensity extended{{}, moduli, 3};
  SimplexBatch<3> batch{};
  FourNumbers least;
  std::vector<FourNumbers> at{4};
};

}  // namespace

/// Also below the ratio where a parabola begins.
void LocalRelaxationTest::the_force_is_the_slope_of_the_energy() {
  OneTetrahedron one;
  one.extended.set_least_volume(0.1);  // not that of this tetrahedron
  for (const double squeeze : {0.0, 0.3, 0.7, 1.4}) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        one.at[i].at[k] = 0.1 * std::sin(double(3 * i + 5 * k + 1));
      }
    }
    one.at[3].at[2] -= squeeze;
    std::vector<FourNumbers> force(4), portable(4);
    QVERIFY(one.evaluate(&force) == one.evaluate(&portable, BatchInstructions::portable));
    for (std::size_t i = 0; i < 4; ++i) {
      QVERIFY(force[i].at == portable[i].at);
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr double step = 1e-5;
        OneTetrahedron before = one, after = one;
        before.at[i].at[k] -= step;
        after.at[i].at[k] += step;
        const double slope = (before.evaluate(nullptr) - after.evaluate(nullptr)) / (2 * step);
        QVERIFY(std::abs(slope - force[i].at[k]) < 1e-8);
      }
    }
  }
}

void LocalRelaxationTest::cubes_of_each_level_hold_the_object_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::newRow("lattice") << block({9, 14, 11});
  QTest::newRow("hexahedra") << block({9, 8, 7}, MeshKind::block);
  QTest::newRow("jittered") << jittered({9, 14, 11});
  QTest::newRow("fork") << fork();
}

/// The volume of the object is that in the cubes, on each level; each element is interpolated to where it is.
void LocalRelaxationTest::cubes_of_each_level_hold_the_object() {
  QFETCH(const MeshPointer, mesh);
  const CubeSpace space(mesh);
  double volume = 0;
  for (std::uint32_t t = 0; t < space.tetrahedra().size(); ++t) {
    volume += CubeSpace::volume_of(space.points_of(t));
  }
  for (int l = 1; l <= space.top(); ++l) {
    double sum = 0;
    for (const CubeSpace::Part& part : space.level(l).parts) {
      sum += double(part.all());
    }
    QVERIFY(std::abs(sum - volume) < 1e-4 * volume);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      if (space.home(e) == CubeSpace::none) {
        continue;
      }
      const CubeSpace::Part& part = space.level(l).parts[space.ancestor(space.home(e), l)];
      const CubeSpace::Cube& cube = space.level(l).cubes[part.cube];
      const auto at = space.interpolate(space.point(e), l, cube);
      for (std::size_t k = 0; k < 3; ++k) {
        double sum_k = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          sum_k += at.weight[i] * space.level(l).width * (cube.at[k] + int(at.corner[i] >> k & 1));
        }
        QVERIFY(std::abs(sum_k - space.point(e)[k]) < 1e-9);
      }
    }
  }
}

void LocalRelaxationTest::fine_everywhere_it_is_the_equilibrium_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::newRow("lattice") << block({13, 9, 9});
  QTest::newRow("hexahedra") << block({13, 9, 9}, MeshKind::block);
  QTest::newRow("jittered") << jittered({13, 9, 9});
}

void LocalRelaxationTest::fine_everywhere_it_is_the_equilibrium() {
  QFETCH(const MeshPointer, mesh);
  const Scene scene(mesh, Point(12, 4, 8), 1.6, 2);
  LocalRelaxation::Options options;
  options.theta = 0;
  options.max_iterations = 30;
  QVERIFY(difference(dragged(scene, options).at, equilibrium(scene, 1)) < 0.005);
}

void LocalRelaxationTest::the_error_is_small_data() {
  QTest::addColumn<MeshPointer>("mesh");
  QTest::newRow("lattice") << block({33, 25, 25});
  QTest::newRow("not of whole cubes") << block({32, 24, 23});
  QTest::newRow("hexahedra") << block({33, 25, 25}, MeshKind::block);
  QTest::newRow("jittered") << jittered({33, 25, 25});
}

void LocalRelaxationTest::the_error_is_small() {
  QFETCH(const MeshPointer, mesh);
  const double high = mesh->box[1][2];
  const Scene scene(mesh, Point(24, 12, high), 2.1, 3);
  LocalRelaxation::Options options;
  options.has_twin = true;
  const Answer answer = dragged(scene, options);
  const double error = difference(answer.at, equilibrium(scene, 1));
  QVERIFY2(error < 0.06, std::to_string(error).c_str());
  QVERIFY(answer.last.nodes < mesh->element_count() / 3);
  QVERIFY(answer.last.estimate.has_value());
  QVERIFY2(*answer.last.estimate > 0.2 * error && *answer.last.estimate < 2 * error,
           std::to_string(*answer.last.estimate / error).c_str());
}

void LocalRelaxationTest::a_cut_opens() {
  const Scene scene = block_scene();
  const std::vector<LinkId> wound = wound_of(*scene.mesh);
  Body body = scene.body();
  LocalRelaxation relaxation(body, {});
  for (int i = 1; i <= 10; ++i) {
    if (i == 6) {
      body.cut(wound);
    }
    scene.move(body, i / 10.0);
    relaxation.update(body, scene.held);
  }
  relaxation.finish(body);
  const auto cut = equilibrium(scene, 1, wound);
  const double error = difference(displacements(body), cut), opened = difference(equilibrium(scene, 1), cut);
  QVERIFY2(error < 0.06 && opened > 2 * error, (std::to_string(error) + ' ' + std::to_string(opened)).c_str());
  // It closes as it was.
  body.uncut(wound);
  relaxation.update(body, scene.held);
  relaxation.finish(body);
  QVERIFY(difference(displacements(body), equilibrium(scene, 1)) < 0.06);
}

/// Then both sides have coarse cubes of their own, and nothing need stay fine.
void LocalRelaxationTest::cubes_know_the_cuts_of_before() {
  const Scene scene = block_scene();
  const std::vector<LinkId> wound = wound_of(*scene.mesh);
  const auto should = equilibrium(scene, 1, wound);
  std::array<std::size_t, 2> nodes{};
  for (const bool before : {false, true}) {
    Body body = scene.body();
    if (before) {
      body.cut(wound);
    }
    LocalRelaxation relaxation(body, {});
    body.cut(wound);
    for (int i = 1; i <= 10; ++i) {
      scene.move(body, i / 10.0);
      nodes[before ? 1 : 0] = relaxation.update(body, scene.held).nodes;
    }
    relaxation.finish(body);
    const double error = difference(displacements(body), should);
    QVERIFY2(error < 0.06, qPrintable(QString::number(error)));
  }
  QVERIFY2(nodes[1] < 0.8 * double(nodes[0]), (std::to_string(nodes[0]) + ' ' + std::to_string(nodes[1])).c_str());
}

/// Those of a moving handle are followed, and a few others; restored links need new cubes.
void LocalRelaxationTest::many_cuts_between_two_drags_need_new_cubes() {
  const Scene scene = block_scene();
  const std::vector<LinkId> wound = wound_of(*scene.mesh), few(wound.begin(), wound.begin() + 100);
  QVERIFY(wound.size() > 600);
  Body body = scene.body();
  LocalRelaxation relaxation(body, {});
  body.cut(few);
  QVERIFY(relaxation.fits(body));
  body.cut(wound);
  QVERIFY(!relaxation.fits(body));
  scene.move(body, 0.1);
  relaxation.update(body, scene.held);
  QVERIFY(relaxation.fits(body));
  relaxation.release();
  QVERIFY(!relaxation.fits(body));
  const LocalRelaxation again(body, {});
  QVERIFY(again.fits(body));
  body.uncut(std::vector<LinkId>{wound[0]});
  QVERIFY(!again.fits(body));
  body.uncut(wound);
  body.cut(few);
  QVERIFY(relaxation.fits(body) && !again.fits(body));
}

void LocalRelaxationTest::it_is_for_open_regions_of_all_links() {
  const Scene scene = block_scene();
  Body body = scene.body();
  QVERIFY(LocalRelaxation::is_for(body));
  Softness softness = body.softness();
  softness.links.set(7, {0.9, 1.1, 0.1});
  body.set_softness(softness);
  QVERIFY(!LocalRelaxation::is_for(body));
}

void LocalRelaxationTest::an_object_without_whole_cells_stays_at_rest() {
  const Scene scene = block_scene();
  Body body = scene.body();
  std::vector<LinkId> all(scene.mesh->link_count());
  std::iota(all.begin(), all.end(), LinkId{0});
  body.cut(all);
  LocalRelaxation relaxation(body, {});
  scene.move(body, 1);
  relaxation.update(body, scene.held);
  relaxation.finish(body);
  const auto at = displacements(body);
  for (ElementId e = 0; e < scene.mesh->element_count(); ++e) {
    const double away = Point::Map(at.data() + std::size_t{e} * 3).norm();
    QVERIFY(std::ranges::binary_search(scene.held, e) ? std::abs(away - std::hypot(0.2 * 3, 3)) < 1e-12 : away < 1e-12);
  }
}

void LocalRelaxationTest::two_branches_in_one_cube_are_apart() {
  const MeshPointer mesh = fork();
  const CubeSpace space(mesh);
  const auto& level = space.level(2);
  bool has_two = false;
  for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
    has_two = has_two || level.cubes[c + 1].part - level.cubes[c].part == 2;
  }
  QVERIFY(has_two);
  const Scene scene(mesh, Point(30, 4, 16), 2.1, 4);
  const double error = difference(dragged(scene).at, equilibrium(scene, 1));
  QVERIFY2(error < 0.06, std::to_string(error).c_str());
}

/// A move by half the width at once, and back through the object.
void LocalRelaxationTest::no_cell_is_inverted() {
  Scene scene = block_scene();
  scene.far = 10;
  Body body = scene.body();
  LocalRelaxation relaxation(body, {});
  for (const double part : {1.0, 1.0, 1.0, -0.4, -0.4, -0.4, 0.5, 0.5, 0.5}) {
    scene.move(body, part);
    const auto result = relaxation.update(body, scene.held);
    relaxation.finish(body);
    if (result.iterations == 1) {
      QVERIFY(result.least_ratio > 0);
    }
  }
  QVERIFY2(least_volume(*scene.mesh, displacements(body)) > 0,
           std::to_string(least_volume(*scene.mesh, displacements(body))).c_str());
}

void LocalRelaxationTest::two_runs_have_the_same_bits() {
  const Scene scene = block_scene();
  const auto one = dragged(scene).at, other = dragged(scene).at;
  QVERIFY(std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0);
}

void LocalRelaxationTest::loops_there_and_back_end_where_they_began() {
  const Scene scene = block_scene();
  Body body = scene.body();
  LocalRelaxation relaxation(body, {});
  const auto drag = [&](int from, int to) {
    for (int i = from; i != to; i += from < to ? 1 : -1) {
      scene.move(body, i / 20.0);
      relaxation.update(body, scene.held);
    }
    scene.move(body, to / 20.0);
    relaxation.update(body, scene.held);
    relaxation.finish(body);
    return displacements(body);
  };
  const auto first = drag(1, 12);
  std::vector<double> last;
  for (int loop = 0; loop < 10; ++loop) {
    drag(12, 20);
    last = drag(20, 12);
  }
  QVERIFY2(difference(last, first) < 0.02, std::to_string(difference(last, first)).c_str());
}

void LocalRelaxationTest::the_unit_of_length_does_not_matter() {
  const Scene scene = block_scene();
  constexpr double scale = 1.0 / 1024;
  Scene small(generate({MeshKind::tetra, {33, 25, 25}, scale, {}}), Point(24, 12, 24) * scale, 2.1 * scale, 3 * scale);
  auto at = dragged(small).at;
  std::ranges::for_each(at, [](double& one) { one /= scale; });
  QVERIFY(difference(at, dragged(scene).at) < 1e-6);
}

/// Cubes are never wider than a rod, which would be too stiff in them.
void LocalRelaxationTest::a_rod_bends() {
  const Scene scene(block({65, 5, 5}), Point(64, 2, 4), 1.1, 10);
  const double error = difference(dragged(scene, {.max_iterations = 30}).at, equilibrium(scene, 1));
  QVERIFY2(error < 0.06, std::to_string(error).c_str());
}

/// Others may have moved the object before.
void LocalRelaxationTest::it_starts_where_the_object_is() {
  const Scene scene = block_scene();
  const auto wanted = equilibrium(scene, 1);
  const auto after_one_iteration = [&](bool is_there) {
    Body body = scene.body();
    scene.move(body, 1);
    if (is_there) {
      EquilibriumSolver::make(3, false)->solve(body, scene.held, 1e-4, 200);
    }
    LocalRelaxation relaxation(body, {.max_iterations = 1});
    relaxation.update(body, scene.held);
    relaxation.finish(body);
    return difference(displacements(body), wanted);
  };
  const double there = after_one_iteration(true), at_rest = after_one_iteration(false);
  QVERIFY2(there < 0.1 && there < at_rest / 2, qPrintable(QString("%1 against %2").arg(there).arg(at_rest)));
}

void LocalRelaxationTest::parts_far_apart_take_as_much_memory_as_near_ones() {
  for (const double apart : {1e3, 1e7, 1e90}) {
    const MeshPointer mesh = carved(
        {17, 9, 9}, [](const Point& c) { return c[0] < 10 || c[0] > 11; },
        [&](const Point& at, ElementId) -> Point { return at[0] > 10.5 ? Point(at + Point::Constant(apart)) : at; });
    const CubeSpace space(mesh);
    const auto& size = space.level(1).size;
    QVERIFY(double(size[0]) * size[1] * size[2] <= double(mesh->tetrahedra.size()));
    const Scene scene(mesh, Point(8, 4, 4), 1.6, 1);
    const auto at = dragged(scene).at;
    QVERIFY(std::ranges::all_of(at, [](double one) { return std::isfinite(one); }));
  }
}

void LocalRelaxationTest::an_object_whose_volume_is_no_number_is_left_to_others() {
  for (const double size : {1e80, 1e120, 1e307}) {
    const MeshPointer mesh = carved(
        {18, 18, 18}, [](const Point&) { return true; },
        [size](const Point& at, ElementId) -> Point { return size * at; });
    QCOMPARE(LocalRelaxation::is_for(Scene(mesh, Point::Zero(), 1, 1).body()), size < 1e100);
  }
}

/// As in the energy of all elements, where a flat layer of cells beside the handle holds nothing together.
void LocalRelaxationTest::flat_cells_do_not_count() {
  const MeshPointer mesh = carved(
      {17, 13, 13}, [](const Point&) { return true; },
      [](const Point& at, ElementId) -> Point {
        const bool onto_next = at[0] == 12 && at[1] >= 3 && at[1] <= 9 && at[2] >= 8;
        return onto_next ? Point(at + (1 - 1e-10) * Point::UnitX()) : at;
      });
  const Scene scene(mesh, Point(14, 6, 11), 1.6, 1);
  const std::vector<double> is = dragged(scene).at, should = equilibrium(scene, 1);
  double largest = 0;
  for (std::size_t i = 0; i < is.size(); ++i) {
    largest = std::max(largest, std::abs(is[i] - should[i]));
  }
  QVERIFY2(largest < 0.04, std::to_string(largest).c_str());
}

CHAINMAIL_TEST(LocalRelaxationTest)

}  // namespace chainmail::test_local_relaxation

#include "test_local_relaxation.moc"
