#include <QtTest>

#include "core/pinned.h"
#include "core/scenarios.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_taut {

using namespace chainmail::test;

namespace {

/// Positions of a chain of twelve elements.
std::vector<double> chain_of(double first, double spacing) {
  std::vector<double> x(12);
  for (int i = 0; i < 12; ++i) {
    x[i] = first + spacing * i;
  }
  return x;
}

}  // namespace

/// Exact ChainMail between pins: the handle stops when the object is taut, and a message names pins that contradict
/// each other.
class TautTest : public QObject {
  Q_OBJECT

 private slots:
  void a_taut_chain_stays_as_it_is();
  void the_hand_is_free_along_the_other_axis();
  void exact_holds_every_link_between_pins();
  void pins_that_contradict_are_named();
  void the_pair_that_contradicts_is_named();
  void rounding_is_no_contradiction();
  void a_hand_pushed_through_comes_back();
  void a_hand_beyond_the_pins_reach_comes_back();
  void the_hand_stops_where_the_chain_is_taut_data();
  void the_hand_stops_where_the_chain_is_taut();
};

void TautTest::a_taut_chain_stays_as_it_is() {
  for (const Precision precision : precisions) {
    const auto solver = pinned_chain(precision, {0});
    solver->move(11, Point(20, 0, 0));
    for (const double further : {20.0, 21.0, 1e9}) {
      const PassCount count = solver->move(11, Point(further, 0, 0));
      QVERIFY(count.stopped);
      QCOMPARE(count.moved, std::uint64_t{0});
    }
    QVERIFY(!solver->move(11, Point(12, 0, 0)).stopped);
    QCOMPARE(solver->body().positions()(11, 0), 12.0);
  }
}

void TautTest::the_hand_is_free_along_the_other_axis() {
  // The left column of a grid is pinned. The handle, at the right end of the middle row, moves right and up.
  const auto mesh = make_mesh(MeshKind::grid, {5, 3, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
  const std::vector<ElementId> column{0, 5, 10};
  solver->body().set_softness({{0.75, 1.25, 0.5}, {}});
  solver->body().pin(column);
  const PassCount count = solver->move(9, Point(50, 2, 0));
  QVERIFY(count.stopped);
  QCOMPARE(solver->body().positions()(9, 0), 5.0);  // four links at a length of 1.25
  QCOMPARE(solver->body().positions()(9, 1), 2.0);  // four links may lean by 0.5 each, so 1 is within reach
}

void TautTest::exact_holds_every_link_between_pins() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    const auto pins = draw_pins(*mesh);
    solver->body().pin(pins);
    for (const DragStep& drag_step : *any_drag_steps(80)) {
      const ElementId element = drag_step.of(*mesh);
      if (std::find(pins.begin(), pins.end(), element) != pins.end()) {
        continue;
      }
      const Point target = position_of(*solver, *mesh, element) + drag_step.by();
      const PassCount count = solver->move(element, target);
      // In rest lengths. Rounding along a path of up to 60 links is far below visible violations.
      RC_ASSERT(measure_violation(*mesh, softness, solver->body().cuts(), solver->body().positions()).max <= 1e-11);
      const Point off = position_of(*solver, *mesh, element) - target;
      for (int k = 0; k < mesh->space_dimension; ++k) {
        RC_ASSERT(count.stopped || std::abs(off[mesh->axes[k]]) <= 1e-12);
      }
    }
  };
  QVERIFY(check_property("between pins every link is valid, and the handle arrives unless it was stopped", holds));
}

void TautTest::pins_that_contradict_are_named() {
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  for (const Precision precision : precisions) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, precision);
    solver->move(11, Point(13, 0, 0));
    const std::vector<ElementId> pins{2, 11};
    solver->body().pin(pins);
    solver->body().set_softness({{1, 1.01, 0}, {}});
    solver->set_algorithm(Algorithm::exact);
    const auto before = positions_of(*solver, *mesh);
    const std::string sentence = refusal([&] { solver->move(5, Point(6, 0, 0)); });
    QVERIFY2(sentence.starts_with("pins 2 and 11: they contradict each other"), sentence.c_str());
    QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
    solver->body().unpin(std::span(&pins[1], 1));
    solver->move(5, Point(5.02, 0, 0));
    QVERIFY(measure_violation(*mesh, {{1, 1.01, 0}, {}}, solver->body().cuts(), solver->body().positions()).max < 1e-5);
  }
}

void TautTest::the_pair_that_contradicts_is_named() {
  // Of four pins, only the last two are too far apart.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  const std::vector<ElementId> first{0, 3, 8};
  solver->body().pin(first);
  solver->move(11, Point(15, 0, 0));
  const ElementId last = 11;
  solver->body().pin(std::span(&last, 1));
  solver->set_algorithm(Algorithm::exact);
  const auto before = positions_of(*solver, *mesh);
  const std::string sentence = refusal([&] { solver->move(5, Point(5, 0, 0)); });
  QVERIFY2(sentence.starts_with("pins 8 and 11"), sentence.c_str());
  QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
}

void TautTest::rounding_is_no_contradiction() {
  // The solver itself moved the end to where the chain is taut, with rounding along 500 links. Pinned there, it is
  // valid.
  const auto mesh = make_mesh(MeshKind::line, {500, 1, 1}, {}, 0.1);
  for (const double far : {-1e3, 1e3}) {
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm::exact, precision);
      solver->body().set_softness({{0.9, 1.2, 0}, {}});
      const std::vector<ElementId> ends{0, 499};
      solver->body().pin(std::span(ends).first(1));
      QVERIFY(solver->move(499, Point(far, 0, 0)).stopped);
      solver->body().pin(std::span(ends).last(1));
      solver->set_algorithm(Algorithm::natural_queue);
      solver->set_algorithm(Algorithm::exact);
      solver->move(250, position_of(*solver, *mesh, 250) + Point(0.01, 0, 0));
      // Float: half an ulp of 60 for each of 500 links, divided by a link length of 0.1.
      const double rounding = precision == Precision::single_precision ? 500 * 2e-6 / 0.1 : 1e-10;
      QVERIFY(measure_violation(*mesh, {{0.9, 1.2, 0}, {}}, solver->body().cuts(), solver->body().positions()).max <=
              rounding);
    }
  }
}

void TautTest::a_hand_pushed_through_comes_back() {
  // Natural Queue pushed it onto its pin. Exact moves it to where links are as short as possible.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = pinned_chain(Precision::double_precision, {0});
  solver->set_algorithm(Algorithm::natural_queue);
  solver->move(11, Point(-100, 0, 0));
  solver->set_algorithm(Algorithm::exact);
  QVERIFY(solver->move(11, Point(-100, 0, 0)).stopped);
  QCOMPARE(positions_of(*solver, *mesh), chain_of(0, 0.75));
}

void TautTest::a_hand_beyond_the_pins_reach_comes_back() {
  // Natural Queue pulled it to where the chain would tear, then Exact takes over: the handle does not count as a pin.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = pinned_chain(Precision::double_precision, {0});
  solver->set_algorithm(Algorithm::natural_queue);
  solver->move(11, Point(100, 0, 0));
  solver->set_algorithm(Algorithm::exact);
  QVERIFY(solver->move(11, Point(100, 0, 0)).stopped);
  QCOMPARE(positions_of(*solver, *mesh), chain_of(0, 1.25));
}

void TautTest::the_hand_stops_where_the_chain_is_taut_data() {
  QTest::addColumn<double>("target");
  QTest::addColumn<double>("spacing");
  // Eleven links between 0.75 and 1.25 long: every sum is exact.
  QTest::newRow("just beyond") << 13.8 << 1.25;
  QTest::newRow("far beyond") << 1e6 << 1.25;
  QTest::newRow("extremely far beyond") << 1e30 << 1.25;
  QTest::newRow("pushed together") << 0.0 << 0.75;
  QTest::newRow("pushed through, far") << -1e30 << 0.75;
}

void TautTest::the_hand_stops_where_the_chain_is_taut() {
  QFETCH(double, target);
  QFETCH(double, spacing);
  for (const Precision precision : precisions) {
    const auto solver = pinned_chain(precision, {0});
    const PassCount count = solver->move(11, Point(target, 0, 0));
    QVERIFY(count.stopped);
    QCOMPARE(positions_of(*solver, *make_mesh(MeshKind::line, {12, 1, 1})), chain_of(0, spacing));
  }
}

CHAINMAIL_TEST(TautTest)

}  // namespace chainmail::test_taut

#include "test_taut.moc"
