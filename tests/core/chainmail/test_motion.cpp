#include <QtTest>

#include "core/scenarios.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_motion {

using namespace chainmail::test;

/// What must be true for any move of any mesh: no skew in the first deformation, and no element that moves further than
/// the handle.
class MotionTest : public QObject {
  Q_OBJECT

 private slots:
  void at_rest_a_zero_move_moves_nothing();
  void from_a_valid_state_a_zero_move_moves_nothing();
  void after_a_drag_a_zero_move_anywhere_moves_nothing();
  void a_move_inside_every_region_moves_the_grabbed_element_alone();
  void from_a_valid_state_nothing_outruns_the_hand();
  void on_uncut_grids_natural_queue_never_outruns_the_hand();
  void on_uncut_grids_natural_queue_stays_valid();
  void the_mirror_image_of_a_drag_gives_the_mirror_image();
  void a_translated_object_deforms_alike();
  void nothing_moves_on_an_axis_without_motion_in_1d();
  void a_target_that_is_no_number_is_refused();
};

namespace {

/// A solver with a random mesh in a random valid state. `reach` says how close links are to their limits.
struct ValidState {
  explicit ValidState(double reach)
      : mesh(draw_family().mesh),
        precision(*any_precision()),
        softness(draw_softness(*mesh)),
        solver(std::make_unique<Deformer>(mesh, *any_algorithm(), precision)) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    solver->body().set_softness(softness);
    solver->body().set_positions(random_valid_state(*mesh, softness, reach, random));
  }

  MeshPointer mesh;
  Precision precision;
  Softness softness;
  std::unique_ptr<Deformer> solver;
};

/// Returns the unit in the last place of the precision, relative to 1.
double ulp(Precision precision) { return precision == Precision::single_precision ? 0x1p-23 : 0x1p-52; }

/// Returns the possible rounding of a pass: at most an ulp of the largest coordinate per link. No mesh here has a path
/// of more than 40 links.
double rounding_of_a_pass(Precision precision, const std::vector<double>& positions) {
  return 40 * ulp(precision) * (1 + largest_coordinate(positions));
}

}  // namespace

void MotionTest::at_rest_a_zero_move_moves_nothing() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, *any_algorithm(), Precision::double_precision);
    // Any softness except rigid, because then the rest shape has no slack for rounding.
    solver->body().set_softness({{*rc::gen::inRange(0, 100) / 100.0, *rc::gen::inRange(101, 300) / 100.0, 0.01}, {}});
    const ElementId element = (*any_drag_step()).of(*mesh);
    const auto before = positions_of(*solver, *mesh);
    const PassCount count = move_by(*solver, *mesh, element, Point(0, 0, 0));
    RC_ASSERT(count.moved == 0u);
    RC_ASSERT(count.checked == mesh->neighbours_of(element).size());
    RC_ASSERT(before == positions_of(*solver, *mesh));  // except for the sign of a zero
  };
  QVERIFY(check_property("at rest a zero move looks at the neighbours and moves none", holds));
}

void MotionTest::from_a_valid_state_a_zero_move_moves_nothing() {
  const auto holds = [] {
    const ValidState state(0.9);
    const auto before = positions_of(*state.solver, *state.mesh);
    move_by(*state.solver, *state.mesh, (*any_drag_step()).of(*state.mesh), Point(0, 0, 0));
    const auto after = positions_of(*state.solver, *state.mesh);
    // A rigid link has no slack, so the state itself is valid only up to rounding.
    RC_ASSERT(largest_step(before, after) <= rounding_of_a_pass(state.precision, before));
  };
  QVERIFY(check_property("from a valid state a zero move moves nothing", holds));
}

void MotionTest::after_a_drag_a_zero_move_anywhere_moves_nothing() {
  // Softness and moves are in eighths, so every sum is exact and nothing at all may move.
  const auto holds = [] {
    const auto mesh = make_mesh(MeshKind::grid, {9, 7, 1});
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, *any_precision());
    solver->body().set_softness({{0.75, 1.25, 0.125}, {}});
    for (const DragStep& drag_step : *any_drag_steps()) {
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
    }
    const auto before = positions_of(*solver, *mesh);
    move_by(*solver, *mesh, (*any_drag_step()).of(*mesh), Point(0, 0, 0));
    RC_ASSERT(same_bits(before, positions_of(*solver, *mesh)));
  };
  QVERIFY(check_property("after drags of a grid a zero move of any element moves nothing", holds));
}

void MotionTest::a_move_inside_every_region_moves_the_grabbed_element_alone() {
  const auto holds = [] {
    const ValidState state(0.5);
    const Mesh& mesh = *state.mesh;
    const auto before = positions_of(*state.solver, mesh);
    const ElementId element = (*any_drag_step()).of(mesh);
    Point target = position_of(*state.solver, mesh, element);
    for (int k = 0; k < mesh.space_dimension; ++k) {
      constexpr double far = 100;  // mesh units; an element without links may go anywhere
      const auto region = valid_interval(mesh, state.softness, before, element, k);
      const double low = std::max(region[0], -far), high = std::min(region[1], far);
      // Anywhere inside, away from the borders because of rounding. In the middle if the interval is empty.
      const double share = *rc::gen::inRange(1, 100) / 100.0;
      target[mesh.axes[k]] = low + share * (high - low);
      RC_PRE(high - low > 1000 * ulp(state.precision) * (1 + largest_coordinate(before)));
    }
    const PassCount count = state.solver->move(element, target);
    RC_ASSERT(count.moved == 0u);
    const auto after = positions_of(*state.solver, mesh);
    for (std::size_t i = 0; i < before.size(); ++i) {
      RC_ASSERT(before[i] == after[i] || i / mesh.space_dimension == element);
    }
  };
  QVERIFY(check_property("a move inside every neighbour's region moves only the grabbed element", holds));
}

void MotionTest::from_a_valid_state_nothing_outruns_the_hand() {
  // For any mesh, algorithm and cuts, a valid link passes on at most the step of its sponsor.
  const auto holds = [] {
    const ValidState state(0.9);
    state.solver->body().cut(draw_links(*state.mesh));
    const auto before = positions_of(*state.solver, *state.mesh);
    const auto drag_step = *any_drag_step();
    move_by(*state.solver, *state.mesh, drag_step.of(*state.mesh), drag_step.by());
    const auto after = positions_of(*state.solver, *state.mesh);
    const int n = state.mesh->space_dimension;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const double of_handle = std::abs(drag_step.by()[state.mesh->axes[i % n]]);
      RC_ASSERT(std::abs(after[i] - before[i]) <= of_handle + rounding_of_a_pass(state.precision, after));
    }
  };
  QVERIFY(check_property("from a valid state no element moves further than the handle on any axis", holds));
}

void MotionTest::on_uncut_grids_natural_queue_never_outruns_the_hand() {
  const auto holds = [] {
    const auto mesh = draw_grid();
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, precision);
    solver->body().set_softness({*any_link_softness(), {}});
    double rounding = 0;  // an earlier pass leaves its rounding in the state
    for (const DragStep& drag_step : *any_drag_steps()) {
      const auto before = positions_of(*solver, *mesh);
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
      const auto after = positions_of(*solver, *mesh);
      rounding += rounding_of_a_pass(precision, after);
      for (std::size_t i = 0; i < after.size(); ++i) {
        const double of_handle = std::abs(drag_step.by()[mesh->axes[i % mesh->space_dimension]]);
        RC_ASSERT(std::abs(after[i] - before[i]) <= of_handle + rounding);
      }
    }
  };
  QVERIFY(check_property("on uncut grids Natural Queue moves no element further than the handle", holds));
}

void MotionTest::on_uncut_grids_natural_queue_stays_valid() {
  const auto holds = [] {
    const auto mesh = draw_grid();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
    const Softness softness{*any_link_softness(), {}};
    solver->body().set_softness(softness);
    for (const DragStep& drag_step : *any_drag_steps()) {
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
      // Rounding in rest lengths: 1e-9 is far above it, and far below visible violations.
      RC_ASSERT(measure_violation(*mesh, softness, solver->body().cuts(), solver->body().positions()).max <= 1e-9);
    }
  };
  QVERIFY(check_property("on uncut grids Natural Queue leaves every link valid", holds));
}

void MotionTest::the_mirror_image_of_a_drag_gives_the_mirror_image() {
  // Mirrored on all axes about the origin: each sum and comparison has its exact mirror image.
  const auto holds = [] {
    const auto& family = draw_family();
    const Mesh& mesh = *family.mesh;
    MeshParts parts = placed(mesh, [](const Point& p) { return Point(-p); });
    parts.first_entry = mesh.first_entry;
    parts.neighbours = mesh.neighbours;
    parts.space_dimension = mesh.space_dimension;
    const auto image = build_mesh(std::move(parts));
    const auto algorithm = *any_algorithm();
    const auto precision = *any_precision();
    const auto one = std::make_unique<Deformer>(family.mesh, algorithm, precision);
    const auto other = std::make_unique<Deformer>(image, algorithm, precision);
    for (const DragStep& drag_step : *any_drag_steps()) {
      move_by(*one, mesh, drag_step.of(mesh), drag_step.by());
      move_by(*other, *image, drag_step.of(mesh), -drag_step.by());
    }
    const auto there = positions_of(*one, mesh), back = positions_of(*other, *image);
    for (std::size_t i = 0; i < there.size(); ++i) {
      RC_ASSERT(there[i] == -back[i]);
    }
  };
  QVERIFY(check_property("a mirrored object with mirrored moves is the mirror image", holds));
}

void MotionTest::a_translated_object_deforms_alike() {
  // Softness, moves and the shift are in eighths, so the sums are exact.
  const auto grid = make_mesh(MeshKind::grid, {8, 8, 1});
  const Point way(64, -32, 0);
  const auto moved = build_mesh(placed(*grid, [&](const Point& p) { return p + way; }));
  for (const AlgorithmInfo& info : algorithms_for(*moved)) {
    const auto here = std::make_unique<Deformer>(grid, info.algorithm, Precision::single_precision);
    const auto there = std::make_unique<Deformer>(moved, info.algorithm, Precision::single_precision);
    for (Deformer* solver : {here.get(), there.get()}) {
      solver->body().set_softness({{0.75, 1.25, 0.125}, {}});
    }
    move_by(*here, *grid, 27, Point(3.5, -2.25, 0));
    move_by(*there, *moved, 27, Point(3.5, -2.25, 0));
    for (ElementId e = 0; e < grid->element_count(); ++e) {
      QVERIFY(position_of(*here, *grid, e) + way == position_of(*there, *moved, e));
    }
  }
}

void MotionTest::nothing_moves_on_an_axis_without_motion_in_1d() {
  const auto mesh = make_mesh(MeshKind::line, {9, 1, 1}, 2);
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  move_by(*solver, *mesh, 4, Point(5, 0, 0));
  for (ElementId e = 0; e < 9; ++e) {
    QCOMPARE(solver->body().positions()(e, 1), 0.0);
  }
}

void MotionTest::a_target_that_is_no_number_is_refused() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::single_precision);
  const auto before = positions_of(*solver, *mesh);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {  // the last one is infinite in float
    QVERIFY_EXCEPTION_THROWN(solver->move(5, Point(1, bad, 0)), Error);
    QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
  }
  solver->move(5, Point(1, 1, std::nan("")));  // a coordinate on an axis that does not exist is ignored
}

CHAINMAIL_TEST(MotionTest)

}  // namespace chainmail::test_motion

#include "test_motion.moc"
