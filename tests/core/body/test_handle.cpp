#include <Eigen/Geometry>
#include <QtTest>
#include <set>

#include "core/elastic/elastic_problems.h"
#include "core/exact/exact_oracle.h"
#include "core/scenarios.h"
#include "core/simulations.h"
#include "elastic/free_form.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_handle {

using namespace chainmail::test;

namespace {

std::vector<ElementId> draw_handle(const Mesh& mesh, std::size_t most) {
  const auto drawn = *rc::gen::container<std::vector<ElementId>>(rc::gen::inRange<ElementId>(0, mesh.element_count()));
  std::set<ElementId> elements(drawn.begin(), drawn.begin() + std::ptrdiff_t(std::min(drawn.size(), most)));
  elements.insert(*rc::gen::inRange<ElementId>(0, mesh.element_count()));
  elements.insert(mesh.element_count() / 2);
  return {elements.begin(), elements.end()};
}

Point draw_axis(const Mesh& mesh) {
  return mesh.space_dimension == 3 ? Point(*rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4), 1) : axis_across(mesh);
}

/// Elements of a square of `width` in a grid of W x H.
std::vector<ElementId> square(std::uint32_t grid, std::uint32_t first, std::uint32_t width) {
  std::vector<ElementId> elements;
  for (std::uint32_t y = 0; y < width; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      elements.push_back(first + y * grid + x);
    }
  }
  return elements;
}

double largest_violation_outside(const Deformer& solver, const std::vector<ElementId>& handle) {
  const Mesh& mesh = solver.body().mesh();
  double largest = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto [a, b] = mesh.links[link];
    if (!solver.body().cuts().is_cut(link) &&
        !(std::ranges::count(handle, a) != 0 && std::ranges::count(handle, b) != 0)) {
      largest = std::max(largest, link_violation(mesh, solver.body().softness(), solver.body().positions(), link));
    }
  }
  return largest;
}

std::string sentence_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

/// A handle of many elements moves as one rigid body, with every method.
class HandleTest : public QObject {
  Q_OBJECT

 private slots:
  void a_rotation_is_that_of_a_matrix();
  void the_handle_is_where_its_motion_puts_it_data();
  void the_handle_is_where_its_motion_puts_it();
  void no_motion_moves_nothing();
  void exact_agrees_with_bellman_and_ford();
  void a_rotation_of_exact_ends_where_it_contradicts_itself();
  void pins_stop_exact();
  void a_translation_keeps_the_regions();
  void elastic_answers_are_those_of_displaced_pins_data();
  void elastic_answers_are_those_of_displaced_pins();
  void boundary_elements_follow_a_translation();
  void free_form_fits_the_handle_and_the_pins();
  void any_motion_stays_finite();
  void a_bad_handle_is_refused_data();
  void a_bad_handle_is_refused();
  void a_released_handle_may_deform();
  void a_rotated_handle_violates_its_own_links();
  void handles_in_turns_reach_their_targets();
  void a_rotation_that_does_not_converge_keeps_its_pose();
};

void HandleTest::a_rotation_is_that_of_a_matrix() {
  for (const double degrees : {0.0, 1e-9, 30.0, -90.0, 180.0, 359.0, 540.0}) {
    const Rotation rotation{Point(1, -2, 2), degrees};
    const Eigen::Matrix3d expected =
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Point(1, -2, 2) / 3).toRotationMatrix();
    QVERIFY((turn_of(rotation.vector()) + Eigen::Matrix3d::Identity() - expected).norm() < 1e-14);
  }
  QCOMPARE(turn_of(Point::Zero()).norm(), 0.0);
  const Rotation both = composed({Point(0, 0, 1), 90}, {Point(1, 0, 0), 90});
  const Eigen::Matrix3d turned = turn_of(both.vector()) + Eigen::Matrix3d::Identity();
  QVERIFY((turned * Point(1, 0, 0) - Point(0, 0, 1)).norm() < 1e-15);  // x to y about z, then y to z about x
  QCOMPARE(composed({Point(0, 0, 1), 300}, {Point(0, 0, 1), 300}).degrees, 600.0);
}

void HandleTest::the_handle_is_where_its_motion_puts_it_data() {
  QTest::addColumn<int>("algorithm");
  for (const AlgorithmInfo& one : every_algorithm()) {
    if (one.algorithm != Algorithm::chainmail_3d) {
      QTest::newRow(std::string(one.name).c_str()) << int(one.algorithm);
    }
  }
}

/// Drags a handle in a solid twice, so that the second drag begins with a deformed shape.
void HandleTest::the_handle_is_where_its_motion_puts_it() {
  QFETCH(int, algorithm);
  const auto mesh = make_mesh(MeshKind::tetra, {5, 5, 5});
  for (const Precision precision : precisions) {
    Deformer solver(mesh, Algorithm(algorithm), precision);
    solver.body().set_softness({{0.25, 2, 1}, {}});
    solver.body().pin(layer(*mesh, *find_side("bottom")));
    const std::vector<std::vector<ElementId>> handles{{95, 96, 97, 120, 121}, {97, 98, 99, 122, 124}};
    for (const auto& elements : handles) {
      std::vector<Point> before;
      for (const ElementId element : elements) {
        before.push_back(position_of(solver, *mesh, element));
      }
      Point pivot = Point::Zero();
      for (const Point& one : before) {
        pivot += one / double(before.size());
      }
      Handle handle(solver.body(), elements);
      for (const double share : {0.5, 1.0}) {
        const Point by = share * Point(0.25, 0.125, -0.25);
        const Rotation rotation{Point(1, 2, 2), share * 12};
        solver.move(handle, {handle.grabbed().pivot + by, rotation.vector()});
        QVERIFY2(solver.remark().empty(), solver.remark().c_str());
        const Eigen::AngleAxisd turn(share * 12 * std::numbers::pi / 180, Point(1, 2, 2) / 3);
        for (std::size_t i = 0; i < elements.size(); ++i) {
          const Point expected = pivot + by + turn * (before[i] - pivot);
          QVERIFY((position_of(solver, *mesh, elements[i]) - expected).norm() <= 32 * half_ulp(precision) * 4);
        }
      }
      for (const ElementId pin : layer(*mesh, *find_side("bottom"))) {
        QCOMPARE(position_of(solver, *mesh, pin), mesh->rest_position(pin));
      }
      if (solver.body().mesh().element_count() > 0 && info(Algorithm(algorithm)).holds_links) {
        QVERIFY(largest_violation_outside(solver, elements) < counts_as_violated);
      }
    }
  }
}

void HandleTest::no_motion_moves_nothing() {
  for (const AlgorithmInfo& one : algorithms()) {
    const auto mesh = make_mesh(MeshKind::grid, {9, 9, 1}, {}, 0.1);
    Deformer solver(mesh, one.algorithm, Precision::double_precision);
    solver.move(40, mesh->rest_position(40) + Point(0.3, 0.17, 0));
    const auto before = positions_of(solver, *mesh);
    Handle handle(solver.body(), {3, 12, 41, 50});
    solver.move(handle, handle.grabbed());
    if (one.algorithm == Algorithm::exact || one.algorithm == Algorithm::natural_queue) {
      QVERIFY(same_bits(before, positions_of(solver, *mesh)));
    }
    for (const ElementId element : {3u, 12u, 41u, 50u}) {
      for (std::size_t k = 0; k < 2; ++k) {
        QCOMPARE(positions_of(solver, *mesh)[2 * element + k], before[2 * element + k]);
      }
    }
  }
}

void HandleTest::exact_agrees_with_bellman_and_ford() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    solver->body().cut(draw_links(*mesh));
    const auto answer = bellman_and_ford(mesh, softness, solver->body().cuts());
    const auto elements = draw_handle(*mesh, 6);
    Handle handle(solver->body(), elements);
    for (const DragStep& drag_step : *any_drag_steps(12)) {
      const auto before = positions_of(*solver, *mesh);
      Pose pose{handle.pose().pivot + drag_step.by(), handle.pose().rotation};
      if (mesh->space_dimension > 1 && drag_step.element % 3 == 0) {
        pose.rotation += Rotation{draw_axis(*mesh), drag_step.element % 40 - 20.0}.vector();
      }
      solver->move(handle, pose);
      RC_ASSERT(!solver->remark().empty() || handle.pose() == pose);
      const auto after = positions_of(*solver, *mesh);
      // The handle's own positions are given. All others must be clamped to what paths from all of them allow.
      const auto bounds = answer.about(elements, after);
      const double size = largest_displacement(*mesh, after) + largest_step(before, after) + 8;
      // As in the test of one element; at the limit of a rotation, bounds may contradict each other by roundings.
      const double rounding = (4 * mesh->element_count() + 256) * half_ulp(precision) * size;
      for (std::size_t i = 0; i < after.size(); ++i) {
        const double expected = std::min(std::max(before[i], bounds.low[i]), bounds.high[i]);
        const bool is_held = std::ranges::binary_search(elements, ElementId(i / std::size_t(mesh->space_dimension)));
        RC_ASSERT(is_held || std::abs(after[i] - expected) <= rounding);
      }
    }
  };
  QVERIFY(check_property("a handle of many moves all others as Bellman and Ford find it", holds));
}

void HandleTest::a_rotation_of_exact_ends_where_it_contradicts_itself() {
  const auto mesh = make_mesh(MeshKind::grid, {20, 20, 1});
  const auto elements = square(20, 7 * 20 + 7, 6);
  for (const Precision precision : precisions) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
    Handle handle(solver->body(), elements);
    const Point pivot = handle.grabbed().pivot;
    const PassCount count = solver->move(handle, {pivot + Point(1, 0, 0), Rotation{Point(0, 0, 1), 40}.vector()});
    QVERIFY(count.stopped);
    QVERIFY(!solver->remark().empty());
    const double reached = handle.pose().rotation.z();
    QVERIFY(reached > 0.05 && reached < 40 * std::numbers::pi / 180);
    QCOMPARE((handle.pose().pivot - pivot).x(), 1.0);  // the translation went on
    QVERIFY(largest_violation_outside(*solver, elements) < counts_as_violated);
    // A little further, the bounds of some element contradict each other; where it stopped, none do.
    const auto answer = bellman_and_ford(mesh, {}, solver->body().cuts());
    const auto worst = [&](double angle) {
      auto placed = positions_of(*solver, *mesh);
      for (std::size_t i = 0; i < elements.size(); ++i) {
        const Point at =
            handle.pose().pivot + Eigen::AngleAxisd(angle, Point(0, 0, 1)) * (mesh->rest_position(elements[i]) - pivot);
        placed[2 * elements[i]] = at.x();
        placed[2 * elements[i] + 1] = at.y();
      }
      const auto bounds = answer.about(elements, placed);
      double most = 0;
      for (std::size_t i = 0; i < bounds.low.size(); ++i) {
        most = std::max(most, bounds.low[i] - bounds.high[i]);
      }
      return most;
    };
    QVERIFY(worst(reached) <= 2e-5);
    QVERIFY(worst(reached + 1e-4) > 2e-5);
    // Back to where it was grabbed: the regions know that the handle can.
    solver->move(handle, {pivot, Point::Zero()});
    QVERIFY(solver->remark().empty());
    QVERIFY(largest_violation_outside(*solver, {}) < counts_as_violated);
  }
}

void HandleTest::pins_stop_exact() {
  const auto mesh = make_mesh(MeshKind::grid, {12, 5, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
  solver->body().pin(layer(*mesh, *find_side("left")));
  Handle handle(solver->body(), layer(*mesh, *find_side("right")));
  // Eleven links stretch by a fifth each, and the handle goes on along y.
  const PassCount count = solver->move(handle, {handle.grabbed().pivot + Point(10, 0.5, 0), Point::Zero()});
  QVERIFY(count.stopped);
  QVERIFY(solver->remark().empty());
  const Point by = handle.pose().pivot - handle.grabbed().pivot;
  QVERIFY(std::abs(by.x() - 11 * 0.2) < 1e-12);
  QVERIFY(std::abs(by.y() - 0.5) < 1e-12);
  QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max < 1e-12);
  QVERIFY(!solver->move(handle, handle.grabbed()).stopped);
}

void HandleTest::a_translation_keeps_the_regions() {
  const auto mesh = make_mesh(MeshKind::grid, {40, 40, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
  Handle handle(solver->body(), square(40, 15 * 40 + 15, 10));
  const auto to = [&](double x) {
    return solver->move(handle, {handle.grabbed().pivot + Point(x, 0, 0), Point::Zero()});
  };
  QVERIFY(to(1).visits > 0);
  QCOMPARE(to(0.75).visits, std::uint64_t{0});
  QCOMPARE(to(1).visits, std::uint64_t{0});
  QVERIFY(to(2).visits > 0);  // elements further out
}

void HandleTest::elastic_answers_are_those_of_displaced_pins_data() {
  QTest::addColumn<int>("method");
  QTest::addColumn<int>("dimension");
  QTest::addColumn<bool>("deformed");
  for (const int dimension : {2, 3}) {
    for (const bool deformed : {false, true}) {
      const char* state = deformed ? "pins displaced" : "from rest";
      QTest::addRow("linear FEM, %dD, %s", dimension, state) << int(Algorithm::linear_fem) << dimension << deformed;
      QTest::addRow("neo-Hookean, %dD, %s", dimension, state) << int(Algorithm::neo_hookean) << dimension << deformed;
    }
  }
}

/// To hold elements at their displacements, it must not matter whether they are pinned there or belong to a handle.
void HandleTest::elastic_answers_are_those_of_displaced_pins() {
  QFETCH(int, method);
  QFETCH(int, dimension);
  QFETCH(bool, deformed);
  const auto mesh =
      jittered(dimension == 2 ? make_mesh(MeshKind::cloth, {7, 6, 1}) : make_mesh(MeshKind::tetra, {5, 4, 4}));
  const Field of_pins = [&](const Point& at) { return deformed ? Point(0.02 * at.y(), 0.05, 0) : Point(0, 0, 0); };
  const auto pins = layer(*mesh, *find_side("left"));
  auto held = layer(*mesh, *find_side("right"));
  held.push_back(held.front() - 1);
  std::ranges::sort(held);
  std::erase_if(held, [&](ElementId one) { return std::ranges::binary_search(pins, one); });

  const auto n = std::size_t(dimension);
  ElasticHandle handle{held, {}, {}};
  const Point pivot = mesh->rest_position(held.front());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Point(0, 0, 1)).toRotationMatrix() - Eigen::Matrix3d::Identity();
  const Point by(0.1, 0.2, dimension == 3 ? -0.1 : 0);
  const auto shape = [&](const Point& at) { return Point(0.01 * at.y(), 0, 0); };  // when it is grabbed
  for (const ElementId element : held) {
    const Point at = mesh->rest_position(element);
    for (std::size_t k = 0; k < n; ++k) {
      handle.displacements.push_back(shape(at)[int(k)]);
      handle.arms.push_back((at + shape(at) - pivot)[int(k)]);
    }
  }
  const auto moved = make_elastic(Algorithm(method), pinned(mesh, pins, of_pins, 0.3));
  moved->hold(handle);
  const ElasticMotion motion{turn.topLeftCorner(dimension, dimension), by.head(dimension)};
  moved->move(ElasticMotion{motion.turn / 2, motion.translation / 2});
  moved->move(motion);
  QVERIFY2(moved->remark().empty(), moved->remark().c_str());

  std::vector<ElementId> all = pins;
  all.insert(all.end(), held.begin(), held.end());
  std::ranges::sort(all);
  const Field field = [&](const Point& at) {
    const bool is_pin = std::ranges::any_of(pins, [&](ElementId pin) { return mesh->rest_position(pin) == at; });
    const Point arm = at + shape(at) - pivot;
    return is_pin ? of_pins(at) : Point(shape(at) + turn * arm + by);
  };
  const auto pinned_there = make_elastic(Algorithm(method), pinned(mesh, all, field, 0.3));
  QVERIFY(largest_step(moved->displacements(), pinned_there->displacements()) < 1e-9);
  QVERIFY(largest_coordinate(moved->displacements()) > 0.2);
}

/// If the pins are displaced like the handle, the whole object is.
void HandleTest::boundary_elements_follow_a_translation() {
  const auto mesh = make_mesh(MeshKind::tetra, {4, 4, 4});
  const Point by(0.1, -0.2, 0.3);
  const auto solver = make_elastic(Algorithm::boundary_elements, pinned(
                                                                     mesh, layer(*mesh, *find_side("bottom")),
                                                                     [&](const Point&) { return by; }, 0.3));
  const auto top = layer(*mesh, *find_side("top"));
  ElasticHandle handle{top, {}, {}};
  for (const ElementId element : top) {
    for (int k = 0; k < 3; ++k) {
      handle.displacements.push_back(0);
      handle.arms.push_back(mesh->rest_position(element)[k]);
    }
  }
  solver->hold(handle);
  solver->move({SmallMatrix::Zero(3, 3), by});
  QVERIFY(furthest_from(*mesh, solver->displacements(), [&](const Point&) { return by; }) < 1e-9);
  // A turn of the handle displaces its elements as prescribed, and the elements between it and the pins by less.
  const Eigen::Matrix3d turn = turn_of(Point(0, 0.2, 0));
  solver->move({turn, by});
  for (const ElementId element : top) {
    for (int k = 0; k < 3; ++k) {
      const double expected = (turn * mesh->rest_position(element) + by)[k];
      QVERIFY(std::abs(solver->displacements()[3 * element + std::size_t(k)] - expected) < 1e-12);
    }
  }
}

/// Of all motions of the control points, free-form deformation takes the one with the least sum of its squares and of
/// weighted squares of what handle and pins miss: there the gradient of that sum is 0.
void HandleTest::free_form_fits_the_handle_and_the_pins() {
  const auto mesh = make_mesh(MeshKind::grid, {9, 7, 1});
  ElasticProblem problem = pinned(mesh, {0, 8});
  problem.options.lattice = {4, 3, 2};
  const auto solver = make_elastic(Algorithm::free_form, problem);
  ElasticHandle handle{{30, 31, 40, 50, 62}, {}, {}};
  for (const ElementId element : handle.elements) {
    handle.displacements.insert(handle.displacements.end(), {0.01 * element, 0.1});
    const Point arm = mesh->rest_position(element) - mesh->rest_position(40);
    handle.arms.insert(handle.arms.end(), {arm.x(), arm.y()});
  }
  solver->hold(handle);
  const Eigen::Matrix2d turn = turn_of(Point(0, 0, 0.4)).topLeftCorner<2, 2>();
  solver->move({turn, Eigen::Vector2d(0.5, -0.25)});
  const BernsteinVolume volume(*mesh, {4, 3, 2});
  Eigen::MatrixXd controls(volume.count(), 2);
  for (Eigen::Index c = 0; c < volume.count(); ++c) {
    const Eigen::Map<const Eigen::Vector2d> at(solver->control_points().data() + 2 * c);
    controls.row(c) = (at - volume.rest(c)).transpose();
  }
  Eigen::MatrixXd gradient = controls;
  const auto add = [&](ElementId element, const Eigen::Vector2d& to) {
    const Eigen::VectorXd weights = volume.weights(element);
    gradient += 1e6 * weights * (weights.transpose() * controls - to.transpose());
    QVERIFY((weights.transpose() * controls - to.transpose()).norm() < 0.05);
  };
  add(0, Eigen::Vector2d::Zero());
  add(8, Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < handle.elements.size(); ++i) {
    const Eigen::Vector2d arm(handle.arms[2 * i], handle.arms[2 * i + 1]);
    const Eigen::Vector2d shape(handle.displacements[2 * i], handle.displacements[2 * i + 1]);
    const Eigen::Vector2d to = shape + turn * arm + Eigen::Vector2d(0.5, -0.25);
    add(handle.elements[i], to);
    QCOMPARE(solver->displacements()[2 * handle.elements[i]], to.x());
  }
  QVERIFY(gradient.norm() < 1e-6);
}

/// Large handles, whole objects included, and rotations of any size.
void HandleTest::any_motion_stays_finite() {
  std::mt19937_64 random(11);
  for (const MeshFamily& family : families()) {
    for (const AlgorithmInfo& one : algorithms_for(*family.mesh)) {
      for (const Precision precision : precisions) {
        Deformer solver(family.mesh, one.algorithm, precision);
        for (const std::uint32_t share : {1u, 2u, 3u}) {
          std::vector<ElementId> elements;
          for (ElementId e = 0; e < family.mesh->element_count(); e += share) {
            elements.push_back(e);
          }
          Handle handle(solver.body(), elements);
          for (int i = 0; i < 6; ++i) {
            Pose pose = handle.grabbed();
            for (int k = 0; k < family.mesh->space_dimension; ++k) {
              pose.pivot[family.mesh->axes[std::size_t(k)]] += uniform(random, -5, 5);
            }
            if (family.mesh->space_dimension == 3) {
              pose.rotation = Point(uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3));
            }
            solver.move(handle, pose);
            const auto positions = positions_of(solver, *family.mesh);
            QVERIFY(std::ranges::all_of(positions, [](double x) { return std::abs(x) < 1000; }));
          }
          QVERIFY(!one.holds_links || largest_violation_outside(solver, elements) < counts_as_violated);
        }
      }
    }
  }
}

void HandleTest::a_bad_handle_is_refused_data() {
  QTest::addColumn<std::vector<ElementId>>("elements");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("none") << std::vector<ElementId>{} << "handle: it has no elements; grab at least one element";
  QTest::newRow("unknown") << std::vector<ElementId>{3, 25}
                           << "element 25: there is no such element; use an id below 25";
  QTest::newRow("twice") << std::vector<ElementId>{4, 7, 4}
                         << "element 4: it is grabbed twice; name each element of the handle once";
  QTest::newRow("pinned") << std::vector<ElementId>{7, 2}
                          << "element 2: it is pinned and may not move; unpin it, or grab another element";
}

void HandleTest::a_bad_handle_is_refused() {
  QFETCH(std::vector<ElementId>, elements);
  QFETCH(QString, sentence);
  Simulation simulation(make_mesh(MeshKind::grid, {5, 5, 1}), Algorithm::exact, Precision::double_precision);
  simulation.apply(commands::Pin{{2}});
  simulation.apply(commands::Grab{std::vector<ElementId>{11, 12}});
  simulation.apply(commands::Drag{Point(1, 0, 0), {}, true});
  const SavedState before(simulation);
  QCOMPARE(QString::fromStdString(sentence_of([&] { simulation.apply(commands::Grab{elements}); })), sentence);
  QVERIFY(SavedState(simulation) == before);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<commands::Drag, const char*>> drags{
      {{Point::Zero(), {Point::Zero(), 10}, true}, "rotation: it has no axis"},
      {{Point::Zero(), {Point(0, 0, 1), nan}, true}, "rotation: its angle or its axis is not a finite number"},
      {{Point::Zero(), {Point(0, nan, 1), 10}, true}, "rotation: its angle or its axis is not a finite number"},
      {{Point::Zero(), {Point(1, 0, 0), 10}, true}, "rotation: about x, it would leave the space of the object"},
      {{Point(nan, 0, 0), {}, true}, "element 11: its target is out of the range of the precision"}};
  for (const auto& [drag, start] : drags) {
    const std::string said = sentence_of([&, command = drag] { simulation.apply(command); });
    QVERIFY2(said.starts_with(start), said.c_str());
    QVERIFY(SavedState(simulation) == before);
  }
}

/// After a release, relaxation may move the elements of the handle apart, and a change of softness does not bring its
/// shape back.
void HandleTest::a_released_handle_may_deform() {
  Simulation simulation(make_mesh(MeshKind::grid, {9, 9, 1}), Algorithm::natural_queue, Precision::double_precision);
  simulation.apply(commands::SetSoftness{{{0.5, 1.5, 0.75}, {}}});
  simulation.apply(commands::Grab{square(9, 30, 3)});
  simulation.apply(commands::Drag{Point(1, 0.5, 0), {Point(0, 0, 1), 30}, true});
  const auto held = positions_of(simulation);
  simulation.relax(20, {1, simulation.relaxation().scheme});
  for (const ElementId element : square(9, 30, 3)) {
    QCOMPARE(positions_of(simulation)[2 * element], held[2 * element]);
  }
  simulation.apply(commands::Release{});
  simulation.relax(20, {1, simulation.relaxation().scheme});
  const auto relaxed = positions_of(simulation);
  QVERIFY(largest_step(std::vector(held.begin() + 60, held.begin() + 66),
                       std::vector(relaxed.begin() + 60, relaxed.begin() + 66)) > 0.01);
  simulation.apply(commands::SetSoftness{{{0.25, 2, 1}, {}}});  // softer: no link is violated
  QVERIFY(same_bits(positions_of(simulation), relaxed));
}

/// Exact ChainMail keeps all links valid when a handle moves, but not those inside a handle that rotates.
void HandleTest::a_rotated_handle_violates_its_own_links() {
  Simulation simulation(make_mesh(MeshKind::grid, {9, 9, 1}), Algorithm::exact, Precision::double_precision);
  simulation.apply(commands::Grab{std::vector<ElementId>{40, 41}});
  simulation.apply(commands::Drag{Point(0.5, 0.5, 0), {}, true});
  QVERIFY(simulation.valid());
  simulation.apply(commands::Drag{Point(0.5, 0.5, 0), {Point(0, 0, 1), 15}, true});
  QVERIFY(!simulation.valid());
  simulation.measure_all();
  QVERIFY(std::abs(simulation.statistics().violation.max - (std::sin(15 * std::numbers::pi / 180) - 0.1)) < 1e-12);
  QCOMPARE(simulation.statistics().violation.fraction, 1.0 / 144);
}

/// Two handles in turns, with relaxation between them: each finds its elements where the other one or relaxation left
/// them, and still brings its middle to the target.
void HandleTest::handles_in_turns_reach_their_targets() {
  const auto mesh = make_mesh(MeshKind::grid, {11, 11, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    for (const Precision precision : precisions) {
      Deformer solver(mesh, one.algorithm, precision);
      std::array<Handle, 2> handles{Handle(solver.body(), {13, 14, 24, 25}), Handle(solver.body(), {72, 73, 83, 94})};
      for (int i = 0; i < 12; ++i) {
        Handle& handle = handles[std::size_t(i % 2)];
        const Point by(i % 3 - 1, i % 2 == 0 ? 0 : 0.5, 0);
        solver.move(handle, {handle.grabbed().pivot + by, Point::Zero()});
        Point middle = Point::Zero();
        for (const ElementId element : handle.elements()) {
          middle += position_of(solver, *mesh, element) / 4;
        }
        QVERIFY((middle - handle.grabbed().pivot - by).norm() < 256 * half_ulp(precision) * 20);
        if (one.holds_links) {
          QVERIFY(largest_violation_outside(solver, {handle.elements().begin(), handle.elements().end()}) <
                  counts_as_violated);
        }
        solver.wake_all();
        (void)solver.relax_slice(0.7, 1'000'000, {});
      }
    }
  }
}

/// After a rotation that fails on its way, the handle is where the last step that converged left it.
void HandleTest::a_rotation_that_does_not_converge_keeps_its_pose() {
  const auto mesh = make_mesh(MeshKind::tetra, {4, 4, 4});
  Deformer solver(mesh, Algorithm::neo_hookean, Precision::double_precision);
  solver.body().pin(layer(*mesh, *find_side("bottom")));
  Handle handle(solver.body(), layer(*mesh, *find_side("top")));
  // Into the pins, where cells would be flat.
  const Pose target{handle.grabbed().pivot - Point(0, 3, 0),
                    Rotation{Point(0, 1, 0), 0.3 * 180 / std::numbers::pi}.vector()};
  solver.move(handle, target);
  QVERIFY(!solver.remark().empty());
  QVERIFY(handle.pose().rotation.norm() < target.rotation.norm());
  QVERIFY(handle.pose().pivot.y() > target.pivot.y());
}

CHAINMAIL_TEST(HandleTest)

}  // namespace chainmail::test_handle

#include "test_handle.moc"
