#include <QtTest>

#include "core/scenarios.h"
#include "core/simulations.h"
#include "measure/violation.h"
#include "mesh/error.h"

using namespace chainmail;
using namespace chainmail::test;

namespace {

std::unique_ptr<Solver> pinned_chain(Precision precision, const std::vector<ElementId>& pins) {
  auto solver = make_solver(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, precision);
  solver->set_softness({{0.75, 1.25, 0}, {}});
  solver->pin(pins);
  return solver;
}

std::vector<double> chain_of(double first, double spacing) {
  std::vector<double> x(12);
  for (int i = 0; i < 12; ++i) {
    x[i] = first + spacing * i;
  }
  return x;
}

/// A sentence that an Error says, or nothing.
template <class Act>
std::string refusal(Act act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

/// Pinned elements: they stay, whatever pulls.
class PinsTest : public QObject {
  Q_OBJECT

 private slots:
  void pins_stay();
  void lists_go_round_a_pin();
  void the_hand_stops_where_the_chain_is_taut_data();
  void the_hand_stops_where_the_chain_is_taut();
  void a_taut_chain_stays_as_it_is();
  void the_hand_is_free_along_the_other_axis();
  void everything_pinned();
  void exact_holds_every_link_between_pins();
  void pins_that_contradict_are_named();
  void the_pair_that_contradicts_is_named();
  void rounding_is_no_contradiction();
  void a_hand_pushed_through_comes_back();
  void a_hand_beyond_the_pins_reach_comes_back();
  void a_pinned_element_is_not_moved();
  void a_pin_is_taken_out_again();
  void pins_come_back_with_undo();
  void softness_never_moves_the_hand();
  void softness_that_pins_contradict_stands();
  void the_hand_is_not_pinned();
};

void PinsTest::pins_stay() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto algorithm = *rc::gen::elementOf(algorithms_for(*mesh));
    Simulation simulation(mesh, algorithm.algorithm, *any_precision());
    const auto pins =
        *rc::gen::container<std::vector<ElementId>>(rc::gen::inRange<ElementId>(0, mesh->element_count()));
    carry_out(simulation, commands::Pin{pins});
    carry_out(simulation,
              commands::SetRelaxation{false, 1, *rc::gen::element(RelaxationScheme::mean, RelaxationScheme::link)});
    for (const Hand& hand : *any_hands(40)) {
      if (std::find(pins.begin(), pins.end(), hand.of(*mesh)) == pins.end()) {
        drag_by(simulation, hand.of(*mesh), hand.by());
        carry_out(simulation, commands::Release{});
        simulation.relax(2, 1);
      }
    }
    for (const ElementId pin : pins) {
      for (int k = 0; k < mesh->space_dimension; ++k) {
        const double rest = mesh->rest[std::size_t{pin} * mesh->space_dimension + k];
        const double now = simulation.solver().positions()(pin, k);
        RC_ASSERT(now == rest || float(now) == float(rest));  // as the solver's scalar holds it
      }
    }
  };
  QVERIFY(rc::check("no algorithm and no relaxation moves a pin", holds));
}

void PinsTest::lists_go_round_a_pin() {
  // A pin counts as updated: what lies behind it on a chain hears nothing.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    if (one.algorithm == Algorithm::exact) {
      continue;
    }
    const auto solver = make_solver(mesh, one.algorithm, Precision::double_precision);
    const ElementId pin = 3;
    solver->pin(std::span(&pin, 1));
    const PassCount count = solver->move(0, Point(-9, 0, 0));
    QCOMPARE(count.moved, std::uint64_t{2});
    QCOMPARE(count.checked, std::uint64_t{2});
    QCOMPARE(solver->positions()(0, 0), -9.0);
    QCOMPARE(solver->positions()(3, 0), 3.0);
    QCOMPARE(solver->positions()(4, 0), 4.0);
  }
}

void PinsTest::the_hand_stops_where_the_chain_is_taut_data() {
  QTest::addColumn<double>("target");
  QTest::addColumn<double>("spacing");
  // Eleven links between 0.75 and 1.25: every sum is exact.
  QTest::newRow("just beyond") << 13.8 << 1.25;
  QTest::newRow("far beyond") << 1e6 << 1.25;
  QTest::newRow("beyond all bounds") << 1e30 << 1.25;
  QTest::newRow("pushed together") << 0.0 << 0.75;
  QTest::newRow("pushed through, far") << -1e30 << 0.75;
}

void PinsTest::the_hand_stops_where_the_chain_is_taut() {
  QFETCH(double, target);
  QFETCH(double, spacing);
  for (const Precision precision : precisions) {
    const auto solver = pinned_chain(precision, {0});
    const PassCount count = solver->move(11, Point(target, 0, 0));
    QVERIFY(count.stopped);
    QCOMPARE(positions_of(*solver, *make_mesh(MeshKind::line, {12, 1, 1})), chain_of(0, spacing));
  }
}

void PinsTest::a_taut_chain_stays_as_it_is() {
  for (const Precision precision : precisions) {
    const auto solver = pinned_chain(precision, {0});
    solver->move(11, Point(20, 0, 0));
    for (const double further : {20.0, 21.0, 1e9}) {
      const PassCount count = solver->move(11, Point(further, 0, 0));
      QVERIFY(count.stopped);
      QCOMPARE(count.moved, std::uint64_t{0});
    }
    QVERIFY(!solver->move(11, Point(12, 0, 0)).stopped);
    QCOMPARE(solver->positions()(11, 0), 12.0);
  }
}

void PinsTest::the_hand_is_free_along_the_other_axis() {
  // The left column of a grid is pinned; the hand, at the right end of the middle row, pulls right and up.
  const auto mesh = make_mesh(MeshKind::grid, {5, 3, 1});
  const auto solver = make_solver(mesh, Algorithm::exact, Precision::double_precision);
  const std::vector<ElementId> column{0, 5, 10};
  solver->set_softness({{0.75, 1.25, 0.5}, {}});
  solver->pin(column);
  const PassCount count = solver->move(9, Point(50, 2, 0));
  QVERIFY(count.stopped);
  QCOMPARE(solver->positions()(9, 0), 5.0);  // four links at 1.25
  QCOMPARE(solver->positions()(9, 1), 2.0);  // four links may lean by 0.5 each: 1 is within reach
}

void PinsTest::everything_pinned() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    const auto solver = make_solver(mesh, one.algorithm, Precision::single_precision);
    for (ElementId e = 1; e < 16; ++e) {
      solver->pin(std::span(&e, 1));
    }
    solver->move(0, Point(-3, -3, 0));
    QCOMPARE(solver->moved().size(), std::size_t{0});
    // Exact keeps the links: the corner may go by the stretch of one and the lean of the other, 0.1.
    const double reached = one.algorithm == Algorithm::exact ? -0.1 : -3;
    QVERIFY(std::abs(solver->positions()(0, 0) - reached) < 1e-6);  // float
  }
}

void PinsTest::exact_holds_every_link_between_pins() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = make_solver(mesh, Algorithm::exact, Precision::double_precision);
    const Softness softness = draw_softness(*mesh);
    solver->set_softness(softness);
    const auto pins =
        *rc::gen::container<std::vector<ElementId>>(rc::gen::inRange<ElementId>(0, mesh->element_count()));
    solver->pin(pins);
    for (const Hand& hand : *any_hands(80)) {
      const ElementId element = hand.of(*mesh);
      if (std::find(pins.begin(), pins.end(), element) != pins.end()) {
        continue;
      }
      const Point target = position_of(*solver, *mesh, element) + hand.by();
      const PassCount count = solver->move(element, target);
      // In rest lengths; rounding along a path of up to 60 links, far below what could be seen.
      RC_ASSERT(measure_violation(*mesh, softness, solver->cuts(), solver->positions()).max <= 1e-11);
      const Point off = position_of(*solver, *mesh, element) - target;
      for (int k = 0; k < mesh->space_dimension; ++k) {
        RC_ASSERT(count.stopped || std::abs(off[mesh->axes[k]]) <= 1e-12);
      }
    }
  };
  QVERIFY(rc::check("between pins every link holds, and the hand arrives unless it was stopped", holds));
}

void PinsTest::pins_that_contradict_are_named() {
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  for (const Precision precision : precisions) {
    const auto solver = make_solver(mesh, Algorithm::natural_queue, precision);
    solver->move(11, Point(13, 0, 0));
    const std::vector<ElementId> pins{2, 11};
    solver->pin(pins);
    solver->set_softness({{1, 1.01, 0}, {}});
    solver->set_algorithm(Algorithm::exact);
    const auto before = positions_of(*solver, *mesh);
    const std::string sentence = refusal([&] { solver->move(5, Point(6, 0, 0)); });
    QVERIFY2(sentence.starts_with("pins 2 and 11: they contradict each other"), sentence.c_str());
    QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
    solver->unpin(std::span(&pins[1], 1));
    solver->move(5, Point(5.02, 0, 0));
    QVERIFY(measure_violation(*mesh, {{1, 1.01, 0}, {}}, solver->cuts(), solver->positions()).max < 1e-5);
  }
}

void PinsTest::the_pair_that_contradicts_is_named() {
  // Four pins, of which the last two alone are too far apart.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = make_solver(mesh, Algorithm::natural_queue, Precision::double_precision);
  const std::vector<ElementId> first{0, 3, 8};
  solver->pin(first);
  solver->move(11, Point(15, 0, 0));
  const ElementId last = 11;
  solver->pin(std::span(&last, 1));
  solver->set_algorithm(Algorithm::exact);
  const auto before = positions_of(*solver, *mesh);
  const std::string sentence = refusal([&] { solver->move(5, Point(5, 0, 0)); });
  QVERIFY2(sentence.starts_with("pins 8 and 11"), sentence.c_str());
  QVERIFY(same_bits(before, positions_of(*solver, *mesh)));
}

void PinsTest::rounding_is_no_contradiction() {
  // The solver itself put the end where the chain is taut, rounded along 500 links; pinned there, it holds.
  const auto mesh = make_mesh(MeshKind::line, {500, 1, 1}, {}, 0.1);
  for (const double far : {-1e3, 1e3}) {
    for (const Precision precision : precisions) {
      const auto solver = make_solver(mesh, Algorithm::exact, precision);
      solver->set_softness({{0.9, 1.2, 0}, {}});
      const std::vector<ElementId> ends{0, 499};
      solver->pin(std::span(ends).first(1));
      QVERIFY(solver->move(499, Point(far, 0, 0)).stopped);
      solver->pin(std::span(ends).last(1));
      solver->set_algorithm(Algorithm::natural_queue);
      solver->set_algorithm(Algorithm::exact);
      solver->move(250, position_of(*solver, *mesh, 250) + Point(0.01, 0, 0));
      // Float: half an ulp of 60 for each of 500 links, over a link's 0.1.
      const double rounding = precision == Precision::single_precision ? 500 * 2e-6 / 0.1 : 1e-10;
      QVERIFY(measure_violation(*mesh, {{0.9, 1.2, 0}, {}}, solver->cuts(), solver->positions()).max <= rounding);
    }
  }
}

void PinsTest::a_hand_pushed_through_comes_back() {
  // Pushed by Natural Queue onto its pin; Exact brings it to where links are as short as they get.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = pinned_chain(Precision::double_precision, {0});
  solver->set_algorithm(Algorithm::natural_queue);
  solver->move(11, Point(-100, 0, 0));
  solver->set_algorithm(Algorithm::exact);
  QVERIFY(solver->move(11, Point(-100, 0, 0)).stopped);
  QCOMPARE(positions_of(*solver, *mesh), chain_of(0, 0.75));
}

void PinsTest::a_hand_beyond_the_pins_reach_comes_back() {
  // Pulled by Natural Queue to where the chain tears, then held by Exact: the hand is no second pin.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  const auto solver = pinned_chain(Precision::double_precision, {0});
  solver->set_algorithm(Algorithm::natural_queue);
  solver->move(11, Point(100, 0, 0));
  solver->set_algorithm(Algorithm::exact);
  QVERIFY(solver->move(11, Point(100, 0, 0)).stopped);
  QCOMPARE(positions_of(*solver, *mesh), chain_of(0, 1.25));
}

void PinsTest::a_pinned_element_is_not_moved() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    const auto solver = make_solver(mesh, one.algorithm, Precision::double_precision);
    const ElementId pin = 5;
    solver->pin(std::span(&pin, 1));
    const std::string sentence = refusal([&] { solver->move(5, Point(2, 2, 0)); });
    QVERIFY2(sentence.starts_with("element 5: it is pinned"), sentence.c_str());
    QCOMPARE(solver->positions()(5, 0), 1.0);
  }
}

void PinsTest::a_pin_is_taken_out_again() {
  const auto solver = pinned_chain(Precision::double_precision, {0, 4, 4});
  QCOMPARE(solver->pins().size(), std::size_t{2});
  const std::vector<ElementId> both{4, 0, 7};
  solver->unpin(both);
  QVERIFY(solver->pins().empty());
  QVERIFY(!solver->move(11, Point(50, 0, 0)).stopped);
  QCOMPARE(solver->positions()(0, 0), 50 - 11 * 1.25);
}

void PinsTest::pins_come_back_with_undo() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  const auto pins = [&] {
    const auto now = simulation.solver().pins();
    return std::vector<ElementId>(now.begin(), now.end());
  };
  carry_out(simulation, commands::Pin{{3, 1}});
  carry_out(simulation, commands::KeepState{1});
  carry_out(simulation, commands::Unpin{{1}});
  carry_out(simulation, commands::Pin{{7}});
  carry_out(simulation, commands::SwapState{1});
  QCOMPARE(pins(), (std::vector<ElementId>{1, 3}));
  carry_out(simulation, commands::SwapState{1});
  QCOMPARE(pins(), (std::vector<ElementId>{3, 7}));
  carry_out(simulation, commands::KeepState{2});
  carry_out(simulation, commands::ReplaceMesh{make_mesh(MeshKind::grid, {4, 4, 1})});
  QVERIFY(pins().empty());
  carry_out(simulation, commands::SwapState{2});
  QCOMPARE(pins(), (std::vector<ElementId>{3, 7}));
  QVERIFY(refusal([&] { simulation.apply(commands::Drag{Point(0, 0, 0)}); }).starts_with("drag"));
}

void PinsTest::softness_never_moves_the_hand() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 2, 0.1}, {}}});
  drag_by(simulation, 0, Point(-20, 0, 0));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Grab{11});
  const Point hand = position_of(simulation, 11);
  carry_out(simulation, commands::SetSoftness{{{0.9, 1.1, 0.1}, {}}});
  QCOMPARE(position_of(simulation, 11)[0], hand[0]);
  simulation.refresh_statistics(true);
  QVERIFY(simulation.statistics().violation.max < 1e-12);
}

void PinsTest::softness_that_pins_contradict_stands() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 2, 0.1}, {}}});
  drag_by(simulation, 11, Point(9, 0, 0));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Pin{{0, 11}});
  drag_by(simulation, 5, Point(1, 0, 0));
  carry_out(simulation, commands::SetSoftness{{{0.9, 1.05, 0.1}, {}}});
  QCOMPARE(simulation.softness().global.stretch, 1.05);
  QVERIFY(refusal([&] { simulation.apply(commands::Drag{Point(6, 0, 0)}); }).starts_with("pins 0 and 11"));
}

void PinsTest::the_hand_is_not_pinned() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, Precision::single_precision);
  carry_out(simulation, commands::Grab{3});
  QVERIFY(refusal([&] { simulation.apply(commands::Pin{{3}}); }).starts_with("element 3: it is in the hand"));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Pin{{3}});
  QVERIFY(refusal([&] { simulation.apply(commands::Grab{3}); }).starts_with("element 3: it is pinned"));
  QVERIFY(refusal([&] { simulation.apply(commands::Pin{{12}}); }).starts_with("element 12"));
  QVERIFY(refusal([&] { simulation.apply(commands::Unpin{{12}}); }).starts_with("element 12"));
}

QTEST_APPLESS_MAIN(PinsTest)
#include "test_pins.moc"
