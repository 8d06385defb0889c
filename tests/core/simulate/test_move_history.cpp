#include <QtTest>

#include "core/simulations.h"
#include "program.h"
#include "simulate/move_history.h"

namespace chainmail::test_move_history {

using namespace chainmail::test;

/// The history contains the commands that recreate the object, through undo and redo.
class MoveHistoryTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_the_solvers_is_left_out();
  void undo_goes_back_and_leaves_the_rest_ahead();
  void another_deed_after_an_undo_takes_the_place_of_what_was_ahead();
  void redo_comes_back_to_a_branch_that_was_left();
  void another_mesh_begins_anew_with_the_global_softness();
  void what_is_loaded_lies_ahead();
  void the_object_is_what_the_commands_made_of_it();
  void the_last_drag_is_told_apart();
  void its_commands_repeat_a_simulation_to_the_bit();
};

namespace {

ElementId grabbed(const MoveHistory& history, std::size_t i) {
  return std::get<commands::Grab>(history.at(i)).elements.front();
}

/// Records grabs of these elements.
void note(MoveHistory& history, const std::vector<ElementId>& elements) {
  for (const ElementId element : elements) {
    history.note(commands::Grab{element});
  }
}

std::vector<ElementId> all_of(const MoveHistory& history) {
  std::vector<ElementId> all;
  for (std::size_t i = 0; i < history.length(); ++i) {
    all.push_back(grabbed(history, i));
  }
  return all;
}

using Elements = std::vector<ElementId>;

}  // namespace

void MoveHistoryTest::what_is_the_solvers_is_left_out() {
  MoveHistory history;
  history.note(commands::SetAlgorithm{Algorithm::spiral});
  history.note(commands::SetRelaxation{true});
  history.note(commands::KeepState{1});
  history.note(commands::DropState{1});
  QCOMPARE(history.length(), std::size_t{0});
  note(history, {4});
  history.note(commands::Relax{3});
  QCOMPARE(history.length(), std::size_t{2});
  QCOMPARE(history.position(), std::size_t{2});
}

void MoveHistoryTest::undo_goes_back_and_leaves_the_rest_ahead() {
  MoveHistory history;
  note(history, {1, 2});
  history.note(commands::KeepState{7});
  note(history, {3});
  const auto timeline = history.timeline();
  history.note(commands::KeepState{8});
  history.note(commands::RestoreState{7});
  QCOMPARE(history.position(), std::size_t{2});
  QCOMPARE(all_of(history), (Elements{1, 2, 3}));
  QCOMPARE(history.timeline(), timeline);
  history.note(commands::RestoreState{8});
  QCOMPARE(history.position(), std::size_t{3});
}

void MoveHistoryTest::another_deed_after_an_undo_takes_the_place_of_what_was_ahead() {
  MoveHistory history;
  history.note(commands::KeepState{1});
  note(history, {1, 2});
  const auto timeline = history.timeline();
  history.note(commands::RestoreState{1});
  note(history, {9});
  QCOMPARE(all_of(history), Elements{9});
  QVERIFY(history.timeline() != timeline);
}

void MoveHistoryTest::redo_comes_back_to_a_branch_that_was_left() {
  MoveHistory history;
  note(history, {1, 2});
  history.note(commands::KeepState{1});
  history.go_to(1);
  note(history, {9});
  history.note(commands::RestoreState{1});
  QCOMPARE(all_of(history), (Elements{1, 2}));
  QCOMPARE(history.position(), std::size_t{2});
}

void MoveHistoryTest::another_mesh_begins_anew_with_the_global_softness() {
  MoveHistory history;
  history.note(commands::SetSoftness{{{0.5, 2, 0}, {{3, {1, 1, 0}}}}});
  history.note(commands::Cut{{1}});
  history.note(commands::KeepState{1});
  history.note(commands::ReplaceMesh{make_mesh(MeshKind::line, {4, 1, 1})});
  QCOMPARE(history.length(), std::size_t{1});
  QVERIFY((*history.object().softness == Softness{{0.5, 2, 0}, {}}));
  QVERIFY(history.object().cuts.empty());
  history.note(commands::RestoreState{1});
  QCOMPARE(history.length(), std::size_t{2});
  QCOMPARE(history.object().cuts, std::vector<LinkId>{1});
}

/// At rest on either mesh, nothing was done. The history must still distinguish the two meshes.
void MoveHistoryTest::what_is_loaded_lies_ahead() {
  MoveHistory history;
  history.note(commands::KeepState{1});
  history.load({commands::Grab{5}, commands::Grab{6}});
  QCOMPARE(history.length(), std::size_t{2});
  QCOMPARE(history.position(), std::size_t{0});
  history.note(commands::KeepState{2});
  history.note(commands::RestoreState{1});
  QCOMPARE(history.length(), std::size_t{0});
  history.note(commands::RestoreState{2});
  QCOMPARE(history.position(), std::size_t{0});
}

void MoveHistoryTest::the_object_is_what_the_commands_made_of_it() {
  MoveHistory history;
  history.note(commands::Cut{{5, 2, 9}});
  history.note(commands::Uncut{{5}});
  history.note(commands::Pin{{3, 1}});
  history.note(commands::Unpin{{3}});
  history.note(commands::SetSoftness{{{0.5, 2, 0}, {}}});
  history.note(commands::Reset{});
  QCOMPARE(history.object().cuts, (std::vector<LinkId>{2, 9}));
  QCOMPARE(history.object().pins, std::vector<ElementId>{1});
  QVERIFY((*history.object().softness == Softness{{0.5, 2, 0}, {}}));
  history.go_to(1);
  QCOMPARE(history.object().cuts, (std::vector<LinkId>{2, 5, 9}));
  QVERIFY(*history.object().softness == Softness());
}

void MoveHistoryTest::the_last_drag_is_told_apart() {
  MoveHistory history;
  QVERIFY(history.last_drag().empty());
  const std::vector<Command> done{commands::Grab{1},
                                  commands::Drag{Point(1, 0, 0)},
                                  commands::Drag{Point(2, 0, 0)},
                                  commands::Release{},
                                  commands::Grab{2},
                                  commands::Release{}};
  for (const Command& command : done) {
    history.note(command);
  }
  const auto drag = history.last_drag();  // a grab without a move is not a drag
  QCOMPARE(drag.size(), std::size_t{3});
  QCOMPARE(std::get<commands::Grab>(drag.front()).elements.front(), 1U);
  QVERIFY(std::get<commands::Drag>(drag.back()).target == Point(2, 0, 0));
  QCOMPARE(history.passes(history.length()), std::size_t{2});
  QCOMPARE(history.passes(2), std::size_t{1});
  history.go_to(1);
  QVERIFY(history.last_drag().empty());
}

void MoveHistoryTest::its_commands_repeat_a_simulation_to_the_bit() {
  const auto mesh = shuffled_neighbours(*jittered_triangles(6, 6, 3), 8);
  for (const auto algorithm : {Algorithm::generalized, Algorithm::natural_queue, Algorithm::exact}) {
    Simulation simulation(mesh, algorithm, Precision::single_precision);
    MoveHistory history;
    const auto act = [&](const Command& command) {
      history.note(command);
      simulation.apply(command);
    };
    const auto drag = [&](ElementId element, const Point& by) {
      act(commands::Grab{element});
      act(commands::Drag{position_of(simulation, element) + by});
      act(commands::Release{});
    };
    act(commands::Cut{{8, 9, 30}});
    act(commands::KeepState{1});
    drag(7, Point(2, 1, 0));
    act(commands::RestoreState{1});
    drag(20, Point(-3, 2, 0));
    act(commands::Relax{3, 0.5, RelaxationScheme::link});
    drag(3, Point(1, 1, 0));
    Simulation again(mesh, algorithm, Precision::single_precision);
    for (const Command& command : history.commands()) {
      again.apply(command);
    }
    QVERIFY(SavedState(again).same_object(SavedState(simulation)));
  }
}

CHAINMAIL_TEST(MoveHistoryTest)

}  // namespace chainmail::test_move_history

#include "test_move_history.moc"
