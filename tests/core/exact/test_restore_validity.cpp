#include <QtTest>
#include <numeric>
#include <set>

#include "core/scenarios.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_restore_validity {

using namespace chainmail::test;

/// Exact ChainMail takes over from any state: it repairs an invalid one.
class RestoreValidityTest : public QObject {
  Q_OBJECT

 private slots:
  void a_start_that_is_not_valid_is_repaired();
  void a_repair_leaves_what_is_valid();
  void a_repair_halves_between_the_envelopes();
  void states_from_outside_are_looked_at();
  void a_repair_and_its_pass_count_once();
  void a_repair_of_huge_displacements_stays_finite();
  void back_from_far_away_every_link_holds();
  void relaxation_that_moves_nothing_leaves_the_rest_shape();
  void what_exact_leaves_needs_no_repair();
  void pins_on_what_exact_leaves_contradict_nobody();
  void an_uncut_link_is_mended();
};

void RestoreValidityTest::a_start_that_is_not_valid_is_repaired() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto precision = *any_precision();
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::generalized, precision);
    for (const DragStep& drag_step : *any_drag_steps()) {
      move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
    }
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    solver->set_algorithm(Algorithm::exact);
    const auto drag_step = *any_drag_step();
    const auto before = positions_of(*solver, *mesh);
    move_by(*solver, *mesh, drag_step.of(*mesh), drag_step.by());
    const auto after = positions_of(*solver, *mesh);
    for (int k = 0; k < mesh->space_dimension; ++k) {
      const std::size_t at = std::size_t{drag_step.of(*mesh)} * mesh->space_dimension + k;
      const double target = before[at] + drag_step.by()[mesh->axes[k]];
      RC_ASSERT(std::abs(after[at] - target) <= 8 * half_ulp(precision) * (10 + std::abs(target)));
    }
    // Rounding: once for each envelope's path, once for the mean of both, and once for the pass.
    const double size = 10 + largest_displacement(*mesh, after);
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      const double outside =
          link_violation(*mesh, softness, solver->body().positions(), link) * rest_length(*mesh, link);
      RC_ASSERT(outside <= 64 * half_ulp(precision) * size);
    }
  };
  QVERIFY(check_property("Exact takes over from any state, and every link holds", holds));
}

void RestoreValidityTest::a_repair_leaves_what_is_valid() {
  // A valid state that was set from outside is not known to be valid. It must not change.
  std::mt19937_64 random(3);
  for (const MeshFamily& family : families()) {
    const auto solver = std::make_unique<Deformer>(family.mesh, Algorithm::exact, Precision::double_precision);
    const auto state = random_valid_state(*family.mesh, {}, 0.5, random);
    solver->body().set_positions(state);
    const PassCount count = move_by(*solver, *family.mesh, 0, Point(0, 0, 0));
    QCOMPARE(count.moved, std::uint64_t{0});
    // Stored relative to rest and added again: an ulp of the coordinates.
    QVERIFY2(largest_step(state, positions_of(*solver, *family.mesh)) <= 1e-14, family.name.c_str());
  }
}

void RestoreValidityTest::a_repair_halves_between_the_envelopes() {
  // 0 is held, and links are 0.75 to 1.25 long. Clamped to what the handle allows, 1 stays at 1 and 2 moves to 2.5.
  // They are 1.5 apart. The greatest valid answer below has 2 at 2.25, the least one above has 1 at 1.25.
  const auto chain = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = std::make_unique<Deformer>(chain, Algorithm::exact, Precision::double_precision);
  solver->body().set_softness({{0.75, 1.25, 0}, {}});
  solver->body().set_positions(std::vector<double>{0, 1, 4});
  solver->move(0, Point(0, 0, 0));
  QCOMPARE(positions_of(*solver, *chain), (std::vector<double>{0, 1.125, 2.375}));
  // Far from the handle there is no anchor: 10 and 11 are 2 apart, and 1.5 is the limit.
  const auto longer = make_mesh(MeshKind::line, {12, 1, 1});
  const auto free = std::make_unique<Deformer>(longer, Algorithm::exact, Precision::double_precision);
  free->body().set_softness({{0.5, 1.5, 0}, {}});
  auto state = longer->rest;
  state[11] = 12;
  free->body().set_positions(state);
  free->move(0, Point(0, 0, 0));
  // Least: 11 moves down to 11.5. Greatest: 10 moves up to 10.5. The means are 11.75 and 10.25.
  QCOMPARE(free->body().positions()(11, 0), 11.75);
  QCOMPARE(free->body().positions()(10, 0), 10.25);
  QCOMPARE(free->body().positions()(9, 0), 9.0);
}

void RestoreValidityTest::states_from_outside_are_looked_at() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1});
  ElementBlocks all(4);
  all.insert_all();
  for (const bool kept : {false, true}) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
    solver->body().set_positions(std::vector<double>{0, 5, 2, 3});
    const Snapshot positions = solver->body().snapshot(all);
    solver->body().reset();
    solver->set_algorithm(Algorithm::exact);
    kept ? solver->body().restore(positions, all) : solver->body().set_positions(std::vector<double>{0, 5, 2, 3});
    solver->move(0, Point(0, 0, 0));
    QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max < 1e-12);
  }
}

void RestoreValidityTest::a_repair_and_its_pass_count_once() {
  const auto mesh = make_mesh(MeshKind::line, {9, 1, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_softness({{0.75, 1.3, 0}, {}});
  const ElementId pin = 0;
  solver->body().pin(std::span(&pin, 1));
  solver->move(8, Point(27, 0, 0));
  solver->set_algorithm(Algorithm::exact);
  const auto before = positions_of(*solver, *mesh);
  Trace trace;
  const PassCount count = solver->move(8, Point(27, 0, 0), &trace);
  const auto after = positions_of(*solver, *mesh);
  std::set<ElementId> rows;
  for (const TraceRow& row : trace) {
    QVERIFY(rows.insert(row.element).second);
    QCOMPARE(row.moved, before[row.element] != after[row.element]);
  }
  QCOMPARE(count.checked, std::uint64_t(trace.size()));
  QCOMPARE(count.moved, std::uint64_t(solver->moved().size()));
  for (const ElementId element : solver->moved()) {
    QVERIFY(before[element] != after[element]);
  }
}

void RestoreValidityTest::a_repair_of_huge_displacements_stays_finite() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1});
  for (const Precision precision : precisions) {
    const double far = precision == Precision::single_precision ? 2e37 : 1e307;
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
    const LinkId middle = *find_link(*mesh, 1, 2);
    solver->body().cut(std::span(&middle, 1));
    solver->move(0, Point(far, 0, 0));
    solver->body().uncut(std::span(&middle, 1));
    solver->move(0, Point(5, 0, 0));
    solver->move(0, Point(4, 0, 0));
    QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max < 1e-5);
    QVERIFY_EXCEPTION_THROWN(solver->move(0, Point(100 * far, 0, 0)), Error);
  }
}

void RestoreValidityTest::back_from_far_away_every_link_holds() {
  // Far away, links are valid to the ulp of large coordinates. Near the origin again, they must be valid to a small
  // ulp.
  const auto mesh = make_mesh(MeshKind::grid, {20, 20, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::single_precision);
  solver->move(210, Point(1e7, 1e7, 0));
  solver->move(210, Point(10, 10, 0));
  solver->move(210, Point(11, 10, 0));
  QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max < 1e-4);
}

void RestoreValidityTest::relaxation_that_moves_nothing_leaves_the_rest_shape() {
  // 2^24 and multiples of 0.37 do not fit into float. Exact must use the rest shape of the mesh.
  const auto line = make_mesh(MeshKind::line, {9, 1, 1}, {}, 0.37);
  const auto mesh = build_mesh(placed(*line, [](const Point& p) { return Point(p + Point(16777216, 0, 0)); }));
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::single_precision);
  solver->relax_slice(1, 1000, {});
  solver->set_algorithm(Algorithm::exact);
  QVERIFY(same_bits(positions_of(*solver, *mesh), mesh->rest));
}

void RestoreValidityTest::what_exact_leaves_needs_no_repair() {
  // Uncutting a link at rest checks all links. They are valid up to the rounding of a handle that is this far away.
  const auto mesh = make_mesh(MeshKind::grid, {200, 200, 1});
  for (const Precision precision : precisions) {
    for (const double far : {30.0, 100.0}) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
      const Point to = mesh->rest_position(20100) + Point(far, far / 3, 0);
      solver->move(20100, to);
      const LinkId corner = 0;
      solver->body().cut(std::span(&corner, 1));
      solver->body().uncut(std::span(&corner, 1));
      QCOMPARE(solver->move(20100, to).moved, std::uint64_t{0});
    }
  }
}

void RestoreValidityTest::pins_on_what_exact_leaves_contradict_nobody() {
  // Ten elements in a row are pinned just behind the front of a long drag, and the handle comes back near them.
  const auto mesh = make_mesh(MeshKind::line, {3000, 1, 1});
  for (const double far : {25.0, 70.0, 400.0}) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::single_precision);
    const std::size_t front = solver->move(0, Point(-far, 0, 0)).moved;
    std::vector<ElementId> pins(10);
    std::iota(pins.begin(), pins.end(), ElementId(front - 11));
    solver->body().pin(pins);
    for (const double to : {-0.9 * far, -far / 100, 0.01 - far / 100}) {
      solver->move(0, Point(to, 0, 0));  // throws if it finds a contradiction
    }
    QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max < 1e-4);
  }
}

void RestoreValidityTest::an_uncut_link_is_mended() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
  solver->body().set_softness({{0.75, 1.25, 0}, {}});
  const LinkId middle = *find_link(*mesh, 1, 2);
  solver->body().cut(std::span(&middle, 1));
  solver->move(0, Point(-5, 0, 0));
  QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{-5, -3.75, 2, 3}));
  solver->body().uncut(std::span(&middle, 1));
  Trace trace;
  const PassCount count = solver->move(0, Point(-5, 0, 0), &trace);
  // 0 is held at −5. 1 is at most 1.25 further, as before, so it stays. The others must move.
  QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{-5, -3.75, -2.5, -1.25}));
  QCOMPARE(count.moved, std::uint64_t{2});
  QCOMPARE(trace.size(), std::size_t{2});
  QVERIFY(trace[0].sponsor == no_element && trace[1].sponsor == no_element);
}

CHAINMAIL_TEST(RestoreValidityTest)

}  // namespace chainmail::test_restore_validity

#include "test_restore_validity.moc"
