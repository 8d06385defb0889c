#include <QtTest>

#include "core/pinned.h"
#include "core/scenarios.h"
#include "core/simulations.h"
#include "program.h"

namespace chainmail::test_pins {

using namespace chainmail::test;

/// Pinned elements stay, whatever pulls at them.
class PinsTest : public QObject {
  Q_OBJECT

 private slots:
  void pins_stay();
  void lists_go_round_a_pin();
  void everything_pinned();
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
    const auto pins = draw_pins(*mesh);
    carry_out(simulation, commands::Pin{pins});
    carry_out(simulation,
              commands::SetRelaxation{false, 1, *rc::gen::element(RelaxationScheme::mean, RelaxationScheme::link)});
    for (const DragStep& drag_step : *any_drag_steps(40)) {
      if (std::find(pins.begin(), pins.end(), drag_step.of(*mesh)) == pins.end()) {
        drag_by(simulation, drag_step.of(*mesh), drag_step.by());
        carry_out(simulation, commands::Release{});
        simulation.relax(2, {1, simulation.relaxation().scheme});
      }
    }
    for (const ElementId pin : pins) {
      for (int k = 0; k < mesh->space_dimension; ++k) {
        const double rest = mesh->rest[std::size_t{pin} * mesh->space_dimension + k];
        const double now = simulation.body().positions()(pin, k);
        RC_ASSERT(now == rest || float(now) == float(rest));  // in the precision of the solver
      }
    }
  };
  QVERIFY(check_property("no algorithm and no relaxation moves a pin", holds));
}

void PinsTest::lists_go_round_a_pin() {
  // A pin counts as updated, so elements behind it on a chain do not move.
  const auto mesh = make_mesh(MeshKind::line, {12, 1, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    if (one.algorithm == Algorithm::exact) {
      continue;
    }
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::double_precision);
    const ElementId pin = 3;
    solver->body().pin(std::span(&pin, 1));
    const PassCount count = solver->move(0, Point(-9, 0, 0));
    QCOMPARE(count.moved, std::uint64_t{2});
    QCOMPARE(count.checked, std::uint64_t{2});
    QCOMPARE(solver->body().positions()(0, 0), -9.0);
    QCOMPARE(solver->body().positions()(3, 0), 3.0);
    QCOMPARE(solver->body().positions()(4, 0), 4.0);
  }
}

void PinsTest::everything_pinned() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::single_precision);
    for (ElementId e = 1; e < 16; ++e) {
      solver->body().pin(std::span(&e, 1));
    }
    solver->move(0, Point(-3, -3, 0));
    QCOMPARE(solver->moved().size(), std::size_t{0});
    // Exact keeps all links valid: the corner may move by the stretch of one link and the shear of the other, 0.1.
    const double reached = one.algorithm == Algorithm::exact ? -0.1 : -3;
    QVERIFY(std::abs(solver->body().positions()(0, 0) - reached) < 1e-6);  // float
  }
}

void PinsTest::a_pinned_element_is_not_moved() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 4, 1});
  for (const AlgorithmInfo& one : algorithms_for(*mesh)) {
    const auto solver = std::make_unique<Deformer>(mesh, one.algorithm, Precision::double_precision);
    const ElementId pin = 5;
    solver->body().pin(std::span(&pin, 1));
    const std::string sentence = refusal([&] { solver->move(5, Point(2, 2, 0)); });
    QVERIFY2(sentence.starts_with("element 5: it is pinned"), sentence.c_str());
    QCOMPARE(solver->body().positions()(5, 0), 1.0);
  }
}

void PinsTest::a_pin_is_taken_out_again() {
  const auto solver = pinned_chain(Precision::double_precision, {0, 4, 4});
  QCOMPARE(solver->body().pins().size(), std::size_t{2});
  const std::vector<ElementId> both{4, 0, 7};
  solver->body().unpin(both);
  QVERIFY(solver->body().pins().empty());
  QVERIFY(!solver->move(11, Point(50, 0, 0)).stopped);
  QCOMPARE(solver->body().positions()(0, 0), 50 - 11 * 1.25);
}

void PinsTest::pins_come_back_with_undo() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::natural_queue, Precision::double_precision);
  const auto pins = [&] {
    const auto now = simulation.body().pins();
    return std::vector<ElementId>(now.begin(), now.end());
  };
  carry_out(simulation, commands::Pin{{3, 1}});
  carry_out(simulation, commands::KeepState{1});
  carry_out(simulation, commands::Unpin{{1}});
  carry_out(simulation, commands::Pin{{7}});
  exchange(simulation, 1);
  QCOMPARE(pins(), (std::vector<ElementId>{1, 3}));
  exchange(simulation, 1);
  QCOMPARE(pins(), (std::vector<ElementId>{3, 7}));
  carry_out(simulation, commands::KeepState{2});
  carry_out(simulation, commands::ReplaceMesh{make_mesh(MeshKind::grid, {4, 4, 1})});
  QVERIFY(pins().empty());
  exchange(simulation, 2);
  QCOMPARE(pins(), (std::vector<ElementId>{3, 7}));
  QVERIFY(refusal([&] { simulation.apply(commands::Drag{Point(0, 0, 0)}); }).starts_with("drag"));
}

void PinsTest::softness_never_moves_the_hand() {
  Simulation simulation(make_mesh(MeshKind::line, {12, 1, 1}), Algorithm::exact, Precision::double_precision);
  carry_out(simulation, commands::SetSoftness{{{0.5, 2, 0.1}, {}}});
  drag_by(simulation, 0, Point(-20, 0, 0));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Grab{11});
  const Point handle = position_of(simulation, 11);
  carry_out(simulation, commands::SetSoftness{{{0.9, 1.1, 0.1}, {}}});
  QCOMPARE(position_of(simulation, 11)[0], handle[0]);
  simulation.measure_all();
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
  QVERIFY(refusal([&] { simulation.apply(commands::Pin{{3}}); }).starts_with("element 3: it is grabbed"));
  carry_out(simulation, commands::Release{});
  carry_out(simulation, commands::Pin{{3}});
  QVERIFY(refusal([&] { simulation.apply(commands::Grab{3}); }).starts_with("element 3: it is pinned"));
  QVERIFY(refusal([&] { simulation.apply(commands::Pin{{12}}); }).starts_with("element 12"));
  QVERIFY(refusal([&] { simulation.apply(commands::Unpin{{12}}); }).starts_with("element 12"));
}

CHAINMAIL_TEST(PinsTest)

}  // namespace chainmail::test_pins

#include "test_pins.moc"
