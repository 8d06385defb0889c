#include <QtTest>

#include "core/simulations.h"
#include "program.h"
#include "simulate/tape.h"

namespace chainmail::test_tape {

using namespace chainmail::test;

/// The tape contains the commands that recreate the object, through undo and redo.
class TapeTest : public QObject {
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

ElementId grabbed(const Tape& tape, std::size_t i) { return std::get<commands::Grab>(tape.at(i)).elements.front(); }

/// Records grabs of these elements.
void note(Tape& tape, const std::vector<ElementId>& elements) {
  for (const ElementId element : elements) {
    tape.note(commands::Grab{element});
  }
}

std::vector<ElementId> all_of(const Tape& tape) {
  std::vector<ElementId> all;
  for (std::size_t i = 0; i < tape.length(); ++i) {
    all.push_back(grabbed(tape, i));
  }
  return all;
}

using Elements = std::vector<ElementId>;

}  // namespace

void TapeTest::what_is_the_solvers_is_left_out() {
  Tape tape;
  tape.note(commands::SetAlgorithm{Algorithm::spiral});
  tape.note(commands::SetRelaxation{true});
  tape.note(commands::KeepState{1});
  tape.note(commands::DropState{1});
  QCOMPARE(tape.length(), std::size_t{0});
  note(tape, {4});
  tape.note(commands::Relax{3});
  QCOMPARE(tape.length(), std::size_t{2});
  QCOMPARE(tape.position(), std::size_t{2});
}

void TapeTest::undo_goes_back_and_leaves_the_rest_ahead() {
  Tape tape;
  note(tape, {1, 2});
  tape.note(commands::KeepState{7});
  note(tape, {3});
  const auto timeline = tape.timeline();
  tape.note(commands::KeepState{8});
  tape.note(commands::RestoreState{7});
  QCOMPARE(tape.position(), std::size_t{2});
  QCOMPARE(all_of(tape), (Elements{1, 2, 3}));
  QCOMPARE(tape.timeline(), timeline);
  tape.note(commands::RestoreState{8});
  QCOMPARE(tape.position(), std::size_t{3});
}

void TapeTest::another_deed_after_an_undo_takes_the_place_of_what_was_ahead() {
  Tape tape;
  tape.note(commands::KeepState{1});
  note(tape, {1, 2});
  const auto timeline = tape.timeline();
  tape.note(commands::RestoreState{1});
  note(tape, {9});
  QCOMPARE(all_of(tape), Elements{9});
  QVERIFY(tape.timeline() != timeline);
}

void TapeTest::redo_comes_back_to_a_branch_that_was_left() {
  Tape tape;
  note(tape, {1, 2});
  tape.note(commands::KeepState{1});
  tape.go_to(1);
  note(tape, {9});
  tape.note(commands::RestoreState{1});
  QCOMPARE(all_of(tape), (Elements{1, 2}));
  QCOMPARE(tape.position(), std::size_t{2});
}

void TapeTest::another_mesh_begins_anew_with_the_global_softness() {
  Tape tape;
  tape.note(commands::SetSoftness{{{0.5, 2, 0}, {{3, {1, 1, 0}}}}});
  tape.note(commands::Cut{{1}});
  tape.note(commands::KeepState{1});
  tape.note(commands::ReplaceMesh{make_mesh(MeshKind::line, {4, 1, 1})});
  QCOMPARE(tape.length(), std::size_t{1});
  QVERIFY((*tape.object().softness == Softness{{0.5, 2, 0}, {}}));
  QVERIFY(tape.object().cuts.empty());
  tape.note(commands::RestoreState{1});
  QCOMPARE(tape.length(), std::size_t{2});
  QCOMPARE(tape.object().cuts, std::vector<LinkId>{1});
}

/// At rest on either mesh, nothing was done. The tape must still distinguish the two meshes.
void TapeTest::what_is_loaded_lies_ahead() {
  Tape tape;
  tape.note(commands::KeepState{1});
  tape.load({commands::Grab{5}, commands::Grab{6}});
  QCOMPARE(tape.length(), std::size_t{2});
  QCOMPARE(tape.position(), std::size_t{0});
  tape.note(commands::KeepState{2});
  tape.note(commands::RestoreState{1});
  QCOMPARE(tape.length(), std::size_t{0});
  tape.note(commands::RestoreState{2});
  QCOMPARE(tape.position(), std::size_t{0});
}

void TapeTest::the_object_is_what_the_commands_made_of_it() {
  Tape tape;
  tape.note(commands::Cut{{5, 2, 9}});
  tape.note(commands::Uncut{{5}});
  tape.note(commands::Pin{{3, 1}});
  tape.note(commands::Unpin{{3}});
  tape.note(commands::SetSoftness{{{0.5, 2, 0}, {}}});
  tape.note(commands::Reset{});
  QCOMPARE(tape.object().cuts, (std::vector<LinkId>{2, 9}));
  QCOMPARE(tape.object().pins, std::vector<ElementId>{1});
  QVERIFY((*tape.object().softness == Softness{{0.5, 2, 0}, {}}));
  tape.go_to(1);
  QCOMPARE(tape.object().cuts, (std::vector<LinkId>{2, 5, 9}));
  QVERIFY(*tape.object().softness == Softness());
}

void TapeTest::the_last_drag_is_told_apart() {
  Tape tape;
  QVERIFY(tape.last_drag().empty());
  const std::vector<Command> done{commands::Grab{1},
                                  commands::Drag{Point(1, 0, 0)},
                                  commands::Drag{Point(2, 0, 0)},
                                  commands::Release{},
                                  commands::Grab{2},
                                  commands::Release{}};
  for (const Command& command : done) {
    tape.note(command);
  }
  const auto drag = tape.last_drag();  // a grab without a move is not a drag
  QCOMPARE(drag.size(), std::size_t{3});
  QCOMPARE(std::get<commands::Grab>(drag.front()).elements.front(), 1U);
  QVERIFY(std::get<commands::Drag>(drag.back()).target == Point(2, 0, 0));
  QCOMPARE(tape.passes(tape.length()), std::size_t{2});
  QCOMPARE(tape.passes(2), std::size_t{1});
  tape.go_to(1);
  QVERIFY(tape.last_drag().empty());
}

void TapeTest::its_commands_repeat_a_simulation_to_the_bit() {
  const auto mesh = shuffled_neighbours(*jittered_triangles(6, 6, 3), 8);
  for (const auto algorithm : {Algorithm::generalized, Algorithm::natural_queue, Algorithm::exact}) {
    Simulation simulation(mesh, algorithm, Precision::single_precision);
    Tape tape;
    const auto act = [&](const Command& command) {
      tape.note(command);
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
    for (const Command& command : tape.commands()) {
      again.apply(command);
    }
    QVERIFY(SavedState(again).same_object(SavedState(simulation)));
  }
}

CHAINMAIL_TEST(TapeTest)

}  // namespace chainmail::test_tape

#include "test_tape.moc"
