#include <QtTest>

#include "core/scenarios.h"
#include "core/simulations.h"
#include "measure/violation.h"
#include "program.h"
#include "reference/chainmail.h"
#include "reference/relaxation.h"

namespace chainmail::test_jumps {

using namespace chainmail::test;

/// The jumps of thesis 4.4: with relaxation, "elements jump to different places when elements at the far side of the
/// object are deformed". On an uncut grid, no element may move further than the handle, with or without relaxation.
class JumpsTest : public QObject {
  Q_OBJECT

 private slots:
  void far_elements_never_jump_data();
  void far_elements_never_jump();
  void unclamped_relaxation_jumps();
  void nothing_outruns_the_hand_however_often_it_relaxes();
};

namespace {

constexpr std::uint32_t side = 9;

struct Drag {
  ElementId element;
  double step;  // along x and along y (mesh units)
};

/// Drags that pull one corner out fast, then the opposite corner slowly, and so on.
std::vector<Drag> far_drags() {
  std::vector<Drag> drags;
  for (int turn = 0; turn < 6; ++turn) {
    const Drag drag = turn % 2 == 0 ? Drag{0, -0.5} : Drag{side * side - 1, 0.1};
    drags.insert(drags.end(), 8, drag);
  }
  return drags;
}

/// Runs the drags in a simulation. Returns the largest step of any element on any axis in a pass, over the step of the
/// handle.
double largest_step_in_simulation(bool relaxed, double step, int slices) {
  Simulation simulation(make_mesh(MeshKind::grid, {side, side, 1}), Algorithm::natural_queue,
                        Precision::double_precision);
  carry_out(simulation, commands::SetRelaxation{relaxed, step});
  double largest = 0;
  for (const Drag& drag : far_drags()) {
    const auto before = positions_of(simulation);
    drag_by(simulation, drag.element, Point(drag.step, drag.step, 0));
    largest = std::max(largest, largest_step(before, positions_of(simulation)) / std::abs(drag.step));
    for (int slice = 0; slice < slices && simulation.continue_relaxation(); ++slice) {
    }
  }
  return largest;
}

std::vector<double> positions_in_thesis(const reference::Object<double>& object) {
  std::vector<double> positions;
  for (const auto& element : object.elements) {
    positions.insert(positions.end(), element.current_position.begin(), element.current_position.begin() + 2);
  }
  return positions;
}

/// The same with the lists and the relaxation of the thesis.
double largest_step_in_thesis(int sweeps) {
  reference::Object<double> object(make_mesh(MeshKind::grid, {side, side, 1}),
                                   [](ElementId, ElementId) { return reference::Factors{}; });
  double largest = 0;
  for (const Drag& drag : far_drags()) {
    const auto before = positions_in_thesis(object);
    const auto& from = object.element(drag.element).current_position;
    reference::move<reference::NaturalQueueChainMail>(object,
                                                      {{drag.element, {from[0] + drag.step, from[1] + drag.step, 0}}});
    largest = std::max(largest, largest_step(before, positions_in_thesis(object)) / std::abs(drag.step));
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      reference::relax<double>(object, 1, drag.element);
    }
  }
  return largest;
}

// Rounding of some 50 passes and 1,000 sweeps at coordinates below 100. Steps are 0.1 and more.
constexpr double rounding = 1e-9;

}  // namespace

void JumpsTest::far_elements_never_jump_data() {
  QTest::addColumn<bool>("relaxed");
  QTest::addColumn<double>("step");
  QTest::addColumn<int>("slices");
  QTest::newRow("not relaxed") << false << 1.0 << 0;
  QTest::newRow("one sweep per pass") << true << 1.0 << 1;
  QTest::newRow("one sweep of half steps per pass") << true << 0.5 << 1;
  QTest::newRow("twenty sweeps per pass") << true << 1.0 << 20;
  QTest::newRow("until it sleeps") << true << 1.0 << 100'000;
}

void JumpsTest::far_elements_never_jump() {
  QFETCH(bool, relaxed);
  QFETCH(double, step);
  QFETCH(int, slices);
  const double largest = largest_step_in_simulation(relaxed, step, slices);
  QVERIFY(largest >= 1 - rounding);  // the step of the handle
  QVERIFY2(largest <= 1 + rounding, qPrintable(QString::number(largest)));
}

void JumpsTest::unclamped_relaxation_jumps() {
  // Shows that the test above can fail: the relaxation of the thesis moves elements further than the handle, and its
  // algorithm alone does not.
  QVERIFY(largest_step_in_thesis(0) <= 1 + rounding);
  for (const int sweeps : {1, 3}) {
    const double largest = largest_step_in_thesis(sweeps);
    QVERIFY2(largest > 1.5, qPrintable(QString::number(largest)));
  }
}

void JumpsTest::nothing_outruns_the_hand_however_often_it_relaxes() {
  const auto holds = [] {
    const auto mesh = draw_grid();
    Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
    carry_out(simulation, commands::SetSoftness{{*any_link_softness(), {}}});
    for (const DragStep& drag_step : *any_drag_steps()) {
      simulation.relax(*rc::gen::inRange(0, 5), {*rc::gen::inRange(1, 101) / 100.0, simulation.relaxation().scheme});
      const auto before = positions_of(simulation);
      drag_by(simulation, drag_step.of(*mesh), drag_step.by());
      const auto after = positions_of(simulation);
      for (std::size_t i = 0; i < after.size(); ++i) {
        const double of_handle = std::abs(drag_step.by()[mesh->axes[i % mesh->space_dimension]]);
        RC_ASSERT(std::abs(after[i] - before[i]) <= of_handle + rounding);
      }
    }
  };
  QVERIFY(check_property("on uncut grids relaxation never moves an element further than the handle", holds));
}

CHAINMAIL_TEST(JumpsTest)

}  // namespace chainmail::test_jumps

#include "test_jumps.moc"
