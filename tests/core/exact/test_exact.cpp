#include <QtTest>

#include "core/exact/exact_oracle.h"
#include "core/scenarios.h"
#include "exact/exact.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_exact {

using namespace chainmail::test;

namespace {

/// Takes waiting elements in a random order.
template <class Scalar>
class ShuffledSchedule {
 public:
  static constexpr bool adapts = false;
  static constexpr bool has_rounds = false;
  bool keeps_position() const { return false; }
  Scalar number(Scalar key) const { return key; }
  static inline std::uint64_t seed = 0;

  bool empty() const { return entries_.empty(); }
  void begin_drag() {}
  void begin() {}
  void admit(std::uint32_t index, Scalar /*key*/) { entries_.push_back(index); }
  std::uint32_t take() {
    std::swap(entries_[random_() % entries_.size()], entries_.back());
    const std::uint32_t entry = entries_.back();
    entries_.pop_back();
    return entry;
  }

 private:
  std::vector<std::uint32_t> entries_;
  std::mt19937_64 random_{seed};
};

/// Buckets so narrow that hardly two different keys share one.
template <class Scalar>
struct NarrowBuckets : BucketSchedule<Scalar> {
  NarrowBuckets() { this->set_width(Scalar(1e-7)); }
};

/// Drags with Exact and this schedule. Returns the final positions. If the schedule promises it, checks that a pass
/// visits no element more often than its region has sides.
template <class Scalar, int Dimension, class Schedule>
std::vector<Scalar> drag(const MeshPointer& mesh, const Softness& softness, const std::vector<DragStep>& drag_steps,
                         bool* visits_are_bounded = nullptr) {
  Body held(mesh, sizeof(Scalar) == sizeof(float) ? Precision::single_precision : Precision::double_precision);
  held.store_displacements(true);
  held.set_softness(softness);
  auto body = held.view<Scalar, Dimension>();
  ExactPropagation<Scalar, Dimension, Schedule> exact;
  std::vector<ElementId> moved;
  for (const DragStep& drag_step : drag_steps) {
    const Handle handle(held, {drag_step.of(*mesh)});
    HandleMove move{handle, {handle.grabbed().pivot + drag_step.by(), Point::Zero()}};
    const auto result = exact.propagate(body, move, moved, nullptr);
    if (visits_are_bounded != nullptr) {
      *visits_are_bounded = *visits_are_bounded && result.visits <= (result.checked + 1) * 2 * Dimension;
    }
  }
  std::vector<Scalar> positions;
  for (const auto& position : body.positions) {
    positions.insert(positions.end(), position.at, position.at + Dimension);
  }
  return positions;
}

template <class Scalar, int Dimension>
bool schedules_agree(const MeshPointer& mesh, const Softness& softness, const std::vector<DragStep>& drag_steps) {
  const auto one = drag<Scalar, Dimension, AdaptiveSchedule<Scalar>>(mesh, softness, drag_steps);
  const auto other = drag<Scalar, Dimension, ShuffledSchedule<Scalar>>(mesh, softness, drag_steps);
  const auto third = drag<Scalar, Dimension, BucketSchedule<Scalar>>(mesh, softness, drag_steps);
  const std::size_t size = one.size() * sizeof(Scalar);
  return std::memcmp(one.data(), other.data(), size) == 0 && std::memcmp(one.data(), third.data(), size) == 0;
}

bool visits_by_key(const MeshPointer& mesh, const Softness& softness, const std::vector<DragStep>& drag_steps) {
  using Buckets = NarrowBuckets<double>;
  bool bounded = true;
  mesh->space_dimension == 1   ? drag<double, 1, Buckets>(mesh, softness, drag_steps, &bounded)
  : mesh->space_dimension == 2 ? drag<double, 2, Buckets>(mesh, softness, drag_steps, &bounded)
                               : drag<double, 3, Buckets>(mesh, softness, drag_steps, &bounded);
  return bounded;
}

template <class Scalar>
bool schedules_agree(const MeshPointer& mesh, const Softness& softness, const std::vector<DragStep>& drag_steps) {
  return mesh->space_dimension == 1   ? schedules_agree<Scalar, 1>(mesh, softness, drag_steps)
         : mesh->space_dimension == 2 ? schedules_agree<Scalar, 2>(mesh, softness, drag_steps)
                                      : schedules_agree<Scalar, 3>(mesh, softness, drag_steps);
}

}  // namespace

/// Exact ChainMail gives the least answer, in any order.
class ExactTest : public QObject {
  Q_OBJECT

 private slots:
  void agrees_with_bellman_and_ford();
  void links_hold();
  void the_schedule_changes_no_bit();
  void visits_are_bounded();
  void from_its_own_states_a_zero_move_moves_nothing();
  void the_trace_names_the_binding_neighbour();
  void drags_there_and_back_do_not_drift();
  void a_far_origin_costs_no_digits();
};

void ExactTest::agrees_with_bellman_and_ford() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    solver->body().cut(draw_links(*mesh));
    const auto answer = bellman_and_ford(mesh, softness, solver->body().cuts());
    for (const DragStep& drag_step : *any_drag_steps(40)) {
      const auto before = positions_of(*solver, *mesh);
      const ElementId element = drag_step.of(*mesh);
      const Point target = position_of(*solver, *mesh, element) + drag_step.by();
      solver->move(element, target);
      std::array<double, 3> coordinates{};
      for (int k = 0; k < mesh->space_dimension; ++k) {
        coordinates[k] = target[mesh->axes[k]];
      }
      const auto expected = answer.move(before, element, coordinates);
      const auto after = positions_of(*solver, *mesh);
      // Along a path, each link rounds its slack (of positions and bounds) and a difference. Paths are shorter than the
      // number of elements. The violation that earlier rounding left has the same size.
      const double size = largest_displacement(*mesh, after) + largest_step(before, after) + 4;
      RC_ASSERT(largest_step(expected, after) <= 4 * mesh->element_count() * half_ulp(precision) * size);
    }
  };
  QVERIFY(check_property("Exact gives the least answer, as Bellman and Ford find it", holds));
}

void ExactTest::links_hold() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    double size = 0;
    for (const DragStep& drag_step : *any_drag_steps(40)) {
      const auto before = positions_of(*solver, *mesh);
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
      const auto after = positions_of(*solver, *mesh);
      size = std::max(size, largest_displacement(*mesh, after) + largest_step(before, after) + 1);
      for (LinkId link = 0; link < mesh->link_count(); ++link) {
        const double length = rest_length(*mesh, link) > 0 ? rest_length(*mesh, link) : mesh->mean_link_length;
        const double outside = link_violation(*mesh, softness, solver->body().positions(), link) * length;
        // 4 ulp per axis of the largest displacement or move, as derived.
        RC_ASSERT(outside <= std::sqrt(3) * 8 * half_ulp(precision) * size);
      }
    }
  };
  QVERIFY(check_property("every link holds to 4 ulp", holds));
}

void ExactTest::the_schedule_changes_no_bit() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const Softness softness = draw_softness(*mesh);
    const auto drag_steps = *any_drag_steps(40);
    ShuffledSchedule<float>::seed = ShuffledSchedule<double>::seed = *rc::gen::arbitrary<std::uint64_t>();
    RC_ASSERT(schedules_agree<float>(mesh, softness, drag_steps));
    RC_ASSERT(schedules_agree<double>(mesh, softness, drag_steps));
  };
  QVERIFY(check_property("a shuffled schedule ends in the same bits", holds));
}

void ExactTest::visits_are_bounded() {
  // Before it sets labels, a pass may visit all elements and a quarter of them again. Then it visits each element once
  // per side of each axis. Narrow buckets do only the latter.
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const Softness softness = draw_softness(*mesh);
    const auto drag_steps = *any_drag_steps(40);
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, *any_precision());
    solver->body().set_softness(softness);
    for (const DragStep& drag_step : drag_steps) {
      const PassCount count = move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
      const std::uint64_t elements = mesh->element_count();
      RC_ASSERT(count.visits <= elements + elements / 4 + 65 + 2 * elements * unsigned(mesh->space_dimension));
    }
    RC_ASSERT(visits_by_key(mesh, softness, drag_steps));
  };
  QVERIFY(check_property("visits are bounded by the elements reached and the space dimension", holds));
}

void ExactTest::from_its_own_states_a_zero_move_moves_nothing() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, *any_precision());
    solver->body().set_softness(draw_softness(*mesh));
    for (const DragStep& drag_step : *any_drag_steps(40)) {
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
    }
    const auto before = positions_of(*solver, *mesh);
    const PassCount count = move_by(*solver, *mesh, (*any_drag_step()).of(*mesh), Point(0, 0, 0));
    RC_ASSERT(count.checked == 0u);
    RC_ASSERT(same_bits(before, positions_of(*solver, *mesh)));
  };
  QVERIFY(check_property("after any drags a zero move moves nothing", holds));
}

void ExactTest::the_trace_names_the_binding_neighbour() {
  // A grid is dragged to the right at its middle: 4 pushes 5 and pulls 3. The corners follow both of their neighbours
  // equally, and the trace names the one with the lower id.
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
  solver->body().set_softness({{0.75, 1.25, 0.25}, {}});
  Trace trace;
  move_by(*solver, *mesh, 4, Point(1, 0, 0), &trace);
  const std::vector<std::array<ElementId, 2>> expected{{1, 4}, {3, 4}, {5, 4}, {7, 4}, {0, 1}, {2, 1}, {6, 3}, {8, 5}};
  QCOMPARE(trace.size(), expected.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    QCOMPARE(trace[i].element, expected[i][0]);
    QCOMPARE(trace[i].sponsor, expected[i][1]);
    QVERIFY(trace[i].moved);
  }
}

void ExactTest::drags_there_and_back_do_not_drift() {
  // After the first round the object does not get any looser. Every further round must be the same to 2 ulp.
  const auto mesh = jittered_triangles(8, 8, 2);
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::single_precision);
  const ElementId middle = 27;
  const Point home = position_of(*solver, *mesh, middle);
  const auto round = [&] {
    solver->move(middle, home + Point(2, 1, 0));
    solver->move(middle, home + Point(-1, 2, 0));
    solver->move(middle, home);
  };
  for (int i = 0; i < 10; ++i) {
    round();
  }
  const auto first = positions_of(*solver, *mesh);
  for (int i = 0; i < 10'000; ++i) {
    round();
  }
  QVERIFY(largest_step(first, positions_of(*solver, *mesh)) <= 2 * 0x1p-23 * 2);
}

void ExactTest::a_far_origin_costs_no_digits() {
  // At 2^24 mesh units, float stores only whole numbers. Displacements from rest keep their digits.
  const auto grid = make_mesh(MeshKind::grid, {8, 8, 1});
  const Point way(16777216, -16777216, 0);
  const auto far = build_mesh(placed(*grid, [&](const Point& p) { return Point(p + way); }));
  const auto here = std::make_unique<Deformer>(grid, Algorithm::exact, Precision::single_precision);
  const auto there = std::make_unique<Deformer>(far, Algorithm::exact, Precision::single_precision);
  move_by(*here, *grid, 27, Point(3.5, -2.25, 0));
  move_by(*there, *far, 27, Point(3.5, -2.25, 0));
  for (ElementId e = 0; e < grid->element_count(); ++e) {
    // Only reading them loses digits: an ulp of double at 2^24.
    QVERIFY((position_of(*here, *grid, e) + way - position_of(*there, *far, e)).norm() <= 1e-8);
  }
}

CHAINMAIL_TEST(ExactTest)

}  // namespace chainmail::test_exact

#include "test_exact.moc"
