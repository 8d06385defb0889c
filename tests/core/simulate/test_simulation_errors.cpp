#include <QtTest>
#include <cmath>

#include "core/simulations.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_simulation_errors {

using namespace chainmail::test;

/// A command that does not fit is refused with a message, and nothing changes.
class SimulationErrorsTest : public QObject {
  Q_OBJECT

 private slots:
  void refused_without_a_trace_data();
  void refused_without_a_trace();
  void a_hand_that_holds_nothing_drags_nothing();
};

namespace {

const double no_number = std::nan("");

/// A simulation of a cut, softened and dragged object, relaxing, with a grabbed element.
Simulation busy_simulation(const MeshPointer& mesh, Precision precision) {
  Simulation simulation(mesh, Algorithm::natural_queue, precision);
  carry_out(simulation, commands::SetSoftness{{{0.7, 1.3, 0.2}, {{2, {1, 1, 0}}}}});
  carry_out(simulation, commands::Cut{{8, 9}});
  carry_out(simulation, commands::SetRelaxation{true, 0.5});
  drag_by(simulation, 7, Point(2, 1, 0));
  return simulation;
}

Command all_links(const LinkSoftness& global) { return commands::SetSoftness{{global, {}}}; }
Command one_link(LinkId link, const LinkSoftness& of_link) {
  return commands::SetSoftness{{{0.5, 1.5, 0.5}, {{1, {1, 1, 0}}, {link, of_link}}}};
}

}  // namespace

void SimulationErrorsTest::refused_without_a_trace_data() {
  QTest::addColumn<Command>("bad");
  QTest::addColumn<QString>("names");  // the subject of the message
  const auto row = [](const char* name, const Command& bad, const char* names) {
    QTest::newRow(name) << bad << QString(names);
  };
  row("no such element", commands::Grab{30}, "element 30");
  row("no such link to cut", commands::Cut{{0, 999}}, "link 999");
  row("no such link to uncut", commands::Uncut{{8, 999}}, "link 999");
  row("compression above 1", all_links({1.1, 1.2, 0.1}), "compression");
  row("stretch below 1", all_links({0.8, 0.9, 0.1}), "stretch");
  row("negative shear", all_links({0.8, 1.2, -0.1}), "shear");
  row("shear is no number", all_links({0.8, 1.2, no_number}), "shear");
  row("softness of no link", one_link(999, {}), "link 999");
  row("bad softness of a link", one_link(3, {2, 1.2, 0.1}), "compression");
  row("target is no number", commands::Drag{Point(1, no_number, 0)}, "element 7");
  row("target is endless", commands::Drag{Point(HUGE_VAL, 0, 0)}, "element 7");
  row("relaxation step of 0", commands::SetRelaxation{false, 0}, "relax-step");
  row("relaxation step above 1", commands::SetRelaxation{true, 1.5}, "relax-step");
  row("relaxation step is no number", commands::SetRelaxation{true, no_number}, "relax-step");
  row("a state that is not kept", commands::RestoreState{5}, "state 5");
}

void SimulationErrorsTest::refused_without_a_trace() {
  QFETCH(Command, bad);
  QFETCH(QString, names);
  const auto mesh = make_mesh(MeshKind::grid, {6, 5, 1});
  for (const Precision precision : precisions) {
    auto simulation = busy_simulation(mesh, precision);
    auto undisturbed = busy_simulation(mesh, precision);
    const SavedState before(simulation);
    QString sentence;
    try {
      carry_out(simulation, bad);
    } catch (const Error& error) {
      sentence = QString::fromStdString(error.what());
    }
    QVERIFY2(sentence.startsWith(names + ": "), qPrintable("said: " + sentence));
    QVERIFY(SavedState(simulation) == before);
    // Later commands must give the same result as without the refused command.
    for (Simulation* one : {&simulation, &undisturbed}) {
      carry_out(*one, commands::Drag{Point(-1, 4, 0)});
      one->continue_relaxation();
      carry_out(*one, commands::Drag{Point(3, 3, 0)});
    }
    QVERIFY(SavedState(simulation) == SavedState(undisturbed));
  }
}

void SimulationErrorsTest::a_hand_that_holds_nothing_drags_nothing() {
  Simulation simulation(make_mesh(MeshKind::grid, {6, 5, 1}), Algorithm::natural_queue, Precision::double_precision);
  const SavedState before(simulation);
  QVERIFY_EXCEPTION_THROWN(carry_out(simulation, commands::Drag{Point(1, 1, 0)}), Error);
  QVERIFY(SavedState(simulation) == before);
  // In a new mesh, no element is grabbed.
  carry_out(simulation, commands::Grab{7});
  carry_out(simulation, commands::ReplaceMesh{make_mesh(MeshKind::line, {3, 1, 1})});
  QVERIFY_EXCEPTION_THROWN(carry_out(simulation, commands::Drag{Point(1, 0, 0)}), Error);
}

CHAINMAIL_TEST(SimulationErrorsTest)

}  // namespace chainmail::test_simulation_errors

#include "test_simulation_errors.moc"
