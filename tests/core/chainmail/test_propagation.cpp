#include <QtTest>
#include <limits>
#include <set>

#include "core/scenarios.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_propagation {

using namespace chainmail::test;

/// One pass in detail: the candidates, their order, and the state after the pass.
class PropagationTest : public QObject {
  Q_OBJECT

 private slots:
  void order_on_a_3x3_grid_data();
  void order_on_a_3x3_grid();
  void the_files_order_of_neighbours_decides();
  void only_elements_that_moved_pass_it_on();
  void a_chain_follows_link_by_link();
  void a_second_pass_to_the_same_target_moves_nothing();
  void an_updated_elements_link_to_its_sponsor_is_valid();
  void no_element_is_updated_twice();
  void counts_agree_with_the_trace();
  void algorithms_are_found_by_name();
};

namespace {

constexpr LinkSoftness rigid{1, 1, 0};

Trace all_moved(const std::vector<std::array<ElementId, 2>>& element_and_sponsor) {
  Trace trace;
  for (const auto& [element, sponsor] : element_and_sponsor) {
    trace.push_back({element, sponsor, true});
  }
  return trace;
}

/// Drags a rigid grid far, so that every candidate moves.
Trace drag_rigid(const MeshPointer& mesh, Algorithm algorithm, ElementId element) {
  const auto solver = std::make_unique<Deformer>(mesh, algorithm, Precision::double_precision);
  solver->body().set_softness({rigid, {}});
  Trace trace;
  move_by(*solver, *mesh, element, Point(8, 4, 0), &trace);
  return trace;
}

}  // namespace

void PropagationTest::order_on_a_3x3_grid_data() {
  QTest::addColumn<int>("algorithm");
  QTest::addColumn<unsigned>("grabbed");
  QTest::addColumn<Trace>("expected");
  const auto row = [](const char* name, Algorithm algorithm, unsigned grabbed, const Trace& expected) {
    QTest::newRow(name) << static_cast<int>(algorithm) << grabbed << expected;
  };
  //   6 7 8    Queue: 4 admits 1 3 5 7; 1 admits 0 2; 3 admits 0 6; 5 admits 2 8; 7 admits 6 8. The
  //   3 4 5    second 0, 2, 6 and 8 are dropped, for the first ones were taken before.
  //   0 1 2
  const Trace ring = all_moved({{1, 4}, {3, 4}, {5, 4}, {7, 4}, {0, 1}, {2, 1}, {6, 3}, {8, 5}});
  row("Natural Queue, centre", Algorithm::natural_queue, 4, ring);
  row("Spiral, centre", Algorithm::spiral, 4, ring);
  // Front: after 1 3 5 7 the list is 7 5 3 1. 7 puts 8 6 4 before it. 8 puts 7 5: 7 is dropped, and 5 is taken with
  // sponsor 8. 5 puts 8 4 2: 2 is taken and puts 5 1: 1 is taken and puts 4 2 0: 0 is taken and puts 3 1: 3 is taken
  // and puts 6 4 0: 6 is taken. All elements that remain are updated already.
  row("Generalized, centre", Algorithm::generalized, 4,
      all_moved({{7, 4}, {8, 7}, {5, 8}, {2, 5}, {1, 2}, {0, 1}, {3, 0}, {6, 3}}));
  // Queue: 0 admits 1 3; 1 admits 2 4; 3 admits 4 6; 2 admits 5; 4 admits 5 7; 6 admits 7; 5 admits 8.
  const Trace fan = all_moved({{1, 0}, {3, 0}, {2, 1}, {4, 1}, {6, 3}, {5, 2}, {7, 4}, {8, 5}});
  row("Natural Queue, corner", Algorithm::natural_queue, 0, fan);
  row("Spiral, corner", Algorithm::spiral, 0, fan);
  // Front: 3 (from 3 1), 6 (from 6 4 0), 7 (from 7 3), 8 (from 8 6 4), 5 (from 7 5: 7 is dropped). Then 5 puts 8 4 2: 4
  // is before 2 and puts 7 5 3 1: 1 is taken and puts 4 2 0: 2 is taken.
  row("Generalized, corner", Algorithm::generalized, 0,
      all_moved({{3, 0}, {6, 3}, {7, 6}, {8, 7}, {5, 8}, {4, 5}, {1, 4}, {2, 1}}));
}

void PropagationTest::order_on_a_3x3_grid() {
  QFETCH(int, algorithm);
  QFETCH(unsigned, grabbed);
  QFETCH(Trace, expected);
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  QVERIFY(drag_rigid(mesh, static_cast<Algorithm>(algorithm), grabbed) == expected);
}

void PropagationTest::the_files_order_of_neighbours_decides() {
  // The neighbours of the centre are listed in the order 7, 5, 3, 1. Those of other elements are listed as usual.
  const auto grid = make_mesh(MeshKind::grid, {3, 3, 1});
  MeshParts parts = placed(*grid, [](const Point& p) { return p; });
  parts.first_entry = grid->first_entry;
  parts.neighbours = grid->neighbours;
  std::reverse(parts.neighbours.begin() + grid->first_entry[4], parts.neighbours.begin() + grid->first_entry[5]);
  const auto mesh = build_mesh(std::move(parts));
  QVERIFY(drag_rigid(mesh, Algorithm::natural_queue, 4) ==
          all_moved({{7, 4}, {5, 4}, {3, 4}, {1, 4}, {6, 7}, {8, 7}, {2, 5}, {0, 3}}));
  // Generalized takes 1, which is listed last. 1 puts 4 2 0: 2, then 5 (from 5 1) and 8 (from 8 4 2), 7 (from 7 5), 6
  // (from 8 6 4: 8 is dropped), 3 (from 7 3: 7 is dropped), and 3 puts 6 4 0: 0.
  QVERIFY(drag_rigid(mesh, Algorithm::generalized, 4) ==
          all_moved({{1, 4}, {2, 1}, {5, 2}, {8, 5}, {7, 8}, {6, 7}, {3, 6}, {0, 3}}));
}

void PropagationTest::only_elements_that_moved_pass_it_on() {
  // A drag to the left pulls the right neighbour and pushes the left one. Those above and below may lean by 0.25, which
  // is more than 0.2, so they stay.
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  for (const AlgorithmInfo& one : algorithms()) {
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::double_precision);
    solver->body().set_softness({{0.875, 1.125, 0.25}, {}});
    Trace trace;
    const PassCount count = move_by(*solver, *mesh, 4, Point(-0.2, 0, 0), &trace);
    std::set<ElementId> moved(solver->moved().begin(), solver->moved().end());
    QVERIFY(moved == (std::set<ElementId>{3, 5}));
    QCOMPARE(count.moved, std::uint64_t{2});
    // The four neighbours, and the four corners around 3 and 5. Exact reaches only those that must move.
    const std::size_t reached = one.algorithm == Algorithm::exact ? 2 : 8;
    QCOMPARE(count.checked, std::uint64_t{reached});
    QCOMPARE(trace.size(), reached);
  }
}

void PropagationTest::a_chain_follows_link_by_link() {
  // 0 moves 2 to the left. Links stretch to 1.25, one after another, until the slack has used up the move.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  for (const AlgorithmInfo& one : algorithms()) {
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::single_precision);
    solver->body().set_softness({{0.75, 1.25, 0}, {}});
    const PassCount count = solver->move(0, Point(-2, 0, 0));
    const std::vector<double> expected{-2, -0.75, 0.5, 1.75, 3, 4.25, 5.5, 6.75, 8, 9, 10, 11};
    QCOMPARE(positions_of(*solver, *mesh), expected);
    QCOMPARE(count.moved, std::uint64_t{7});
    // 8 was checked, and stayed; Exact does not reach it
    QCOMPARE(count.checked, std::uint64_t{one.algorithm == Algorithm::exact ? 7u : 8u});
  }
}

void PropagationTest::a_second_pass_to_the_same_target_moves_nothing() {
  // A second pass to the same target finds the handle's links valid and ends at once. Generalized leaves some of them
  // to other sponsors further away, so it may not end at once.
  const auto mesh = make_mesh(MeshKind::grid, {9, 9, 1});
  for (const Algorithm algorithm : {Algorithm::spiral, Algorithm::natural_queue}) {
    const auto solver = std::make_unique<Deformer>(mesh, algorithm, Precision::double_precision);
    move_by(*solver, *mesh, 40, Point(3, 2, 0));
    const auto before = positions_of(*solver, *mesh);
    const PassCount again = move_by(*solver, *mesh, 40, Point(0, 0, 0));
    QCOMPARE(again.moved, std::uint64_t{0});
    QCOMPARE(again.checked, std::uint64_t{4});
    QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
  }
}

void PropagationTest::an_updated_elements_link_to_its_sponsor_is_valid() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, *any_algorithm(), precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    solver->body().cut(draw_links(*mesh));
    for (const DragStep& drag_step : *any_drag_steps()) {
      Trace trace;
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by(), &trace);
      // Each bound about the sponsor is one rounded sum of a rounded bound: an ulp of the largest number on each axis,
      // and as much again for the size of the region.
      const double ulp = precision == Precision::single_precision ? 0x1p-23 : std::numeric_limits<double>::epsilon();
      const double largest = largest_coordinate(positions_of(*solver, *mesh)) + 10;
      for (const TraceRow& row : trace) {
        const LinkId link = *find_link(*mesh, row.element, row.sponsor);
        const double outside =
            link_violation(*mesh, softness, solver->body().positions(), link) * rest_length(*mesh, link);
        RC_ASSERT(outside <= 4 * ulp * largest);
      }
    }
  };
  QVERIFY(check_property("an updated element lies in the region about its sponsor", holds));
}

void PropagationTest::no_element_is_updated_twice() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, *any_algorithm(), *any_precision());
    solver->body().set_softness(draw_softness(*mesh));
    for (const DragStep& drag_step : *any_drag_steps()) {
      Trace trace;
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by(), &trace);
      std::set<ElementId> updated{drag_step.of(*mesh)};
      for (const TraceRow& row : trace) {
        RC_ASSERT(updated.contains(row.sponsor));  // every sponsor was updated before
        RC_ASSERT(updated.insert(row.element).second);
      }
    }
  };
  QVERIFY(check_property("each element is updated at most once, the grabbed one never again", holds));
}

void PropagationTest::counts_agree_with_the_trace() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, *any_algorithm(), *any_precision());
    const auto drag_step = *any_drag_step();
    Trace trace;
    const PassCount count = move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by(), &trace);
    std::vector<ElementId> moved;
    for (const TraceRow& row : trace) {
      if (row.moved) {
        moved.push_back(row.element);
      }
    }
    RC_ASSERT(count.checked == trace.size());
    RC_ASSERT(count.moved == moved.size());
    RC_ASSERT(moved == std::vector<ElementId>(solver->moved().begin(), solver->moved().end()));
  };
  QVERIFY(check_property("counts, moved() and the trace agree", holds));
}

void PropagationTest::algorithms_are_found_by_name() {
  for (const AlgorithmInfo& one : algorithms()) {
    QVERIFY(find_algorithm(one.name) == one.algorithm);
    QVERIFY(info(one.algorithm).label == one.label);
  }
  QVERIFY(!find_algorithm("natural queue") && !find_algorithm(""));
}

CHAINMAIL_TEST(PropagationTest)

}  // namespace chainmail::test_propagation

#include "test_propagation.moc"
