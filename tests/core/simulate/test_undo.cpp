#include <QtTest>

#include "core/scenarios.h"
#include "core/simulations.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_undo {

using namespace chainmail::test;

/// Keeps and exchanges states: undo and redo, exact to the bit.
namespace {

const std::vector<Algorithm> on_any_mesh{Algorithm::generalized, Algorithm::spiral, Algorithm::natural_queue,
                                         Algorithm::enhanced, Algorithm::exact};

}  // namespace

class UndoTest : public QObject {
  Q_OBJECT

 private slots:
  void later_moves_come_out_as_if_nothing_had_been();
  void another_mesh_comes_back_with_its_cuts_and_softness();
  void any_change_is_undone();
  void states_come_back_in_any_order();
  void a_change_to_exact_is_undone_with_it();
  void a_dropped_state_is_gone();
  void the_hand_lets_go_and_relaxation_sleeps();
};

namespace {

Simulation worked_simulation(Algorithm algorithm, Precision precision) {
  Simulation simulation(shuffled_neighbours(*jittered_triangles(6, 6, 3), 8), algorithm, precision);
  carry_out(simulation, commands::SetSoftness{{{0.7, 1.3, 0.2}, {{2, {1, 1, 0}}}}});
  carry_out(simulation, commands::Cut{{8, 9, 30}});
  drag_by(simulation, 7, Point(2, 1, 0));
  return simulation;
}

void change_everything(Simulation& simulation) {
  carry_out(simulation, commands::Uncut{{9}});
  carry_out(simulation, commands::Cut{{11, 12}});
  carry_out(simulation, commands::SetSoftness{{{0.9, 1.1, 0}, {{5, {0, 3, 1}}}}});
  drag_by(simulation, 20, Point(-3, 2, 0));
}

/// Makes a few drags. Returns all their candidates.
Trace trace_of_drags(Simulation& simulation) {
  Trace trace;
  simulation.set_trace(&trace);
  for (const ElementId element : {0u, 17u, 35u}) {
    drag_by(simulation, element, Point(1.5, -2.5, 0));
  }
  simulation.set_trace(nullptr);
  return trace;
}

}  // namespace

void UndoTest::later_moves_come_out_as_if_nothing_had_been() {
  for (const Algorithm algorithm : on_any_mesh) {
    auto untouched = worked_simulation(algorithm, Precision::single_precision);
    auto simulation = worked_simulation(algorithm, Precision::single_precision);
    carry_out(simulation, commands::KeepState{1});
    change_everything(simulation);
    exchange(simulation, 1);
    QVERIFY(trace_of_drags(simulation) == trace_of_drags(untouched));
    QVERIFY(same_bits(positions_of(simulation), positions_of(untouched)));
  }
}

void UndoTest::another_mesh_comes_back_with_its_cuts_and_softness() {
  auto simulation = worked_simulation(Algorithm::natural_queue, Precision::double_precision);
  const SavedState before(simulation);
  carry_out(simulation, commands::KeepState{1});
  carry_out(simulation, commands::ReplaceMesh{make_mesh(MeshKind::block, {3, 3, 3})});
  drag_by(simulation, 0, Point(-1, -2, -3));
  const SavedState after(simulation);
  exchange(simulation, 1);
  QVERIFY(SavedState(simulation).same_object(before));
  exchange(simulation, 1);
  QVERIFY(SavedState(simulation).same_object(after));
}

void UndoTest::any_change_is_undone() {
  const auto holds = [] {
    Simulation simulation(draw_family().mesh, *rc::gen::elementOf(on_any_mesh), *any_precision());
    const auto work = [&] {
      carry_out(simulation, commands::SetSoftness{draw_softness(simulation.mesh())});
      carry_out(simulation, commands::Cut{draw_links(simulation.mesh())});
      carry_out(simulation, commands::Uncut{draw_links(simulation.mesh())});
      const auto drag_step = *any_drag_step();
      drag_by(simulation, drag_step.of(simulation.mesh()), drag_step.by());
      simulation.relax(*rc::gen::inRange(0, 3), {1, simulation.relaxation().scheme});
    };
    work();
    const SavedState before(simulation);
    carry_out(simulation, commands::KeepState{1});
    work();
    const SavedState after(simulation);
    exchange(simulation, 1);
    RC_ASSERT(SavedState(simulation).same_object(before));
    RC_ASSERT(simulation.valid() == before.valid);
    exchange(simulation, 1);
    RC_ASSERT(SavedState(simulation).same_object(after));
  };
  QVERIFY(check_property("undo and redo of cuts, softness, drags and relaxation are exact", holds));
}

/// States share the blocks that did not change between them. No state may change the blocks of another. Exact stores
/// positions differently, so a change to or from it would round restored positions.
void UndoTest::states_come_back_in_any_order() {
  const auto holds = [] {
    const auto algorithm = *rc::gen::elementOf(on_any_mesh);
    Simulation simulation(make_mesh(MeshKind::grid, {30, 20, 1}), algorithm, *any_precision());
    std::vector<SavedState> kept;
    for (int step = 0; step < 20; ++step) {
      const auto state = *rc::gen::inRange<std::size_t>(0, kept.size() + 1);
      if (state == kept.size()) {
        kept.emplace_back(simulation);
        carry_out(simulation, commands::KeepState{state});
      } else if (*rc::gen::arbitrary<bool>()) {
        const SavedState now(simulation);
        exchange(simulation, state);
        RC_ASSERT(SavedState(simulation).same_object(kept[state]));
        kept[state] = now;
      } else {
        carry_out(simulation, commands::RestoreState{state});
        RC_ASSERT(SavedState(simulation).same_object(kept[state]));
      }
      const auto drag_step = *any_drag_step();
      switch (*rc::gen::inRange(0, 4)) {
        case 0:
          carry_out(simulation, commands::Reset{});
          break;
        case 1:
          carry_out(simulation, commands::SetAlgorithm{algorithm == Algorithm::exact ? algorithm : Algorithm::spiral});
          break;
        default:
          drag_by(simulation, drag_step.of(simulation.mesh()), drag_step.by());
      }
    }
  };
  QVERIFY(check_property("states are exchanged and restored to the bit, whatever they share", holds));
}

void UndoTest::a_change_to_exact_is_undone_with_it() {
  for (const Precision precision : precisions) {
    auto simulation = worked_simulation(Algorithm::natural_queue, precision);
    const SavedState before(simulation);
    carry_out(simulation, commands::KeepState{1});
    carry_out(simulation, commands::SetAlgorithm{Algorithm::exact});
    const SavedState exact(simulation);
    carry_out(simulation, commands::KeepState{2});
    drag_by(simulation, 20, Point(-3, 2, 0));
    exchange(simulation, 2);
    QVERIFY(SavedState(simulation).same_object(exact));
    carry_out(simulation, commands::SetAlgorithm{Algorithm::natural_queue});
    exchange(simulation, 1);
    QVERIFY(SavedState(simulation).same_object(before));
    // If an algorithm that stores positions differently restores them, they are rounded, and kept that way.
    carry_out(simulation, commands::SetAlgorithm{Algorithm::exact});
    carry_out(simulation, commands::RestoreState{1});
    const SavedState rounded(simulation);
    carry_out(simulation, commands::KeepState{3});
    drag_by(simulation, 20, Point(-3, 2, 0));
    exchange(simulation, 3);
    QVERIFY(SavedState(simulation).same_object(rounded));
  }
}

void UndoTest::a_dropped_state_is_gone() {
  auto simulation = worked_simulation(Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::KeepState{1});
  carry_out(simulation, commands::DropState{1});
  carry_out(simulation, commands::DropState{1});  // has no effect
  const SavedState before(simulation);
  QVERIFY_EXCEPTION_THROWN(exchange(simulation, 1), Error);
  QVERIFY(SavedState(simulation) == before);
}

void UndoTest::the_hand_lets_go_and_relaxation_sleeps() {
  auto simulation = worked_simulation(Algorithm::natural_queue, Precision::double_precision);
  carry_out(simulation, commands::KeepState{1});
  const SavedState kept(simulation);
  carry_out(simulation, commands::SetRelaxation{true, 1});
  drag_by(simulation, 20, Point(-3, 2, 0));
  exchange(simulation, 1);
  QVERIFY(simulation.grabbed().empty());
  QVERIFY(!simulation.statistics().relaxing);
  QVERIFY(!simulation.continue_relaxation());  // otherwise the state that undo restored would change slowly
  QVERIFY(SavedState(simulation).same_object(kept));
}

CHAINMAIL_TEST(UndoTest)

}  // namespace chainmail::test_undo

#include "test_undo.moc"
