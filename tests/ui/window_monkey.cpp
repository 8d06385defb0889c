// Tests random user input in a real window, in any order, mainly for the address sanitizer. A run has a fixed number of
// events. The environment variables CHAINMAIL_MONKEY_EVENTS and CHAINMAIL_MONKEY_SEED set their number and the seed.

#include <algorithm>
#include <cmath>

#include "common/text.h"
#include "monkey.h"
#include "panels/panel.h"

namespace chainmail::window_monkey {

namespace {

constexpr int usualEvents = 1000;
constexpr int betweenChecks = 100;

int asked(const char* variable, int otherwise) {
  bool is = false;
  const int value = qEnvironmentVariableIntValue(variable, &is);
  return is ? value : otherwise;
}

/// The state that undo restores.
struct State {
  MeshPointer mesh;
  QString name;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  std::array<Algorithm, Document::minPanels> algorithms;
  std::array<std::vector<float>, Document::minPanels> positions;  // of the panels that cannot be removed

  static State of(const Document& document) {
    State state{
        document.mesh(), document.name(), document.cuts().links(), document.pins(), *document.wholeSoftness(), {}, {}};
    for (int panel = 0; panel < Document::minPanels; ++panel) {
      state.algorithms[std::size_t(panel)] = document.algorithm(panel);
      state.positions[std::size_t(panel)] = document.solvers().frame(panel)->positions;
    }
    return state;
  }
};

void compare(const State& is, const State& should) {
  QCOMPARE(is.mesh, should.mesh);
  QCOMPARE(is.name, should.name);
  QCOMPARE(is.cuts, should.cuts);
  QCOMPARE(is.pins, should.pins);
  QVERIFY(is.softness == should.softness);
  for (std::size_t panel = 0; panel < is.positions.size(); ++panel) {
    QCOMPARE(is.algorithms[panel], should.algorithms[panel]);
    QVERIFY2(is.positions[panel] == should.positions[panel], panel == 0 ? "panel A" : "panel B");
  }
}

}  // namespace

class WindowMonkey : public QObject {
  Q_OBJECT

 public:
  explicit WindowMonkey(const Witness& witness) : witness_(witness) {}

 private slots:
  void init() { failOnWarnings(); }

  void whatIsLeftAloneIsThere() {
    Workbench bench;
    for (const auto& left : Monkey::leftAlone()) {
      QVERIFY2(bench.window.findChild<QAction*>(QLatin1String(left.action)) != nullptr, left.action);
    }
  }

  void anythingInAnyOrder() {
    const int events = asked("CHAINMAIL_MONKEY_EVENTS", usualEvents);
    QTemporaryDir folder;
    Workbench bench;
    Monkey monkey(bench, folder.path(), unsigned(asked("CHAINMAIL_MONKEY_SEED", 1)), witness_);
    State begin = State::of(bench.document());
    bool complete = true;  // true while the undo list goes back to the beginning
    for (int event = 1; event <= events; ++event) {
      monkey.act();
      QVERIFY(!QTest::currentTestFailed());
      QVERIFY(bench.window.isVisible());
      complete = complete && bench.document().undoStack().count() < bench.document().undoStack().undoLimit();
      if (event % betweenChecks == 0 || event == events) {
        monkey.rest();
        witness_.tell("check, after " + std::to_string(bench.document().undoStack().count()) + " steps of undo");
        check(bench, begin, complete);
        QVERIFY(!QTest::currentTestFailed());
        begin = State::of(bench.document());
        bench.document().undoStack().clear();
        complete = true;
      }
    }
  }

  void closedAtAnyMoment_data() {
    QTest::addColumn<unsigned>("seed");
    for (unsigned seed = 101; seed <= 104; ++seed) {
      QTest::addRow("%u", seed) << seed;
    }
  }
  void closedAtAnyMoment() {
    QFETCH(unsigned, seed);
    QTemporaryDir folder;
    Workbench bench;
    Monkey monkey(bench, folder.path(), seed, witness_);
    for (unsigned i = 0; i < 10 + seed % 50; ++i) {
      monkey.act();
    }
  }

 private:
  static void check(Workbench& bench, const State& begin, bool complete) {
    checkWindow(bench);
    Document& document = bench.document();
    const State end = State::of(document);
    const int index = document.undoStack().index();
    while (document.undoStack().canUndo()) {
      bench.trigger("undo");
    }
    bench.settle();
    checkWindow(bench);
    if (complete) {
      compare(State::of(document), begin);
    }
    while (document.undoStack().index() < index) {
      bench.trigger("redo");
    }
    bench.settle();
    checkWindow(bench);
    compare(State::of(document), end);
  }

  static void checkWindow(Workbench& bench) {
    const Document& document = bench.document();
    QTRY_VERIFY(document.solvers().settled());
    QCOMPARE(bench.window.findChildren<View*>().size(), document.panels());
    for (int panel = 0; panel < document.panels(); ++panel) {
      const Frame* frame = document.solvers().frame(panel);
      QVERIFY(frame != nullptr);
      QCOMPARE(frame->positions.size(), frame->mesh->rest.size());
      QVERIFY(std::all_of(frame->positions.begin(), frame->positions.end(), [](float x) { return std::isfinite(x); }));
      QCOMPARE(bench.window.panel(panel).selector().currentText(), text(info(document.algorithm(panel)).label));
    }
    const QString file = QFileInfo(document.files().session()).fileName();
    QVERIFY(bench.window.windowTitle().startsWith(file.isEmpty() ? document.name() : file));
    QCOMPARE(bench.window.isWindowModified(), document.isModified());
  }

  const Witness& witness_;
};

namespace {

int runClass(int argc, char** argv) {
  qputenv("QTEST_FUNCTION_TIMEOUT", "100000000");  // the witness notices if the test hangs
  return Witness::watch([&](const Witness& witness) { return runWindowTest<WindowMonkey>(argc, argv, witness); });
}

}  // namespace

CHAINMAIL_TEST_RUN(WindowMonkey, runClass)

}  // namespace chainmail::window_monkey

#include "window_monkey.moc"
