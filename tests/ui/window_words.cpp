// Tests the words around the views: the sentence on violation, figures on demand, and the lecture mode.

#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QTableWidget>
#include <QToolBar>
#include <QToolButton>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>

#include "document/edits.h"
#include "panels/colour_choices.h"
#include "panels/legend.h"
#include "panels/panel_state.h"
#include "window.h"

namespace chainmail::window_words {

namespace {

Statistics statisticsOf(double fraction, double largest, bool whole) {
  Statistics statistics;
  statistics.violation.fraction = fraction;
  statistics.violation.max = largest;
  statistics.violation.is_whole = whole;
  return statistics;
}

QString sentenceOf(const Statistics& statistics, const ViolationLine::State& state = {}) {
  ViolationLine line;
  line.show(statistics, state);
  return line.sentence();
}

/// Four elements; the first two lie almost at one position.
MeshPointer almostNoLength() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1e-307, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  parts.links = {{0, 1}, {1, 2}, {2, 3}};
  return build_mesh(std::move(parts));
}

/// Returns what the window says in figures: labels, tables and legends.
QStringList textsOf(Workbench& bench) {
  QStringList texts;
  for (const auto* label : bench.window.findChildren<QLabel*>()) {
    texts << label->text() << label->toolTip();
  }
  for (const auto* table : bench.window.findChildren<QTableWidget*>()) {
    for (int i = 0; i < table->rowCount() * table->columnCount(); ++i) {
      const auto* item = table->item(i / table->columnCount(), i % table->columnCount());
      texts << (item == nullptr ? QString() : item->text());
    }
  }
  for (int panel = 0; panel < bench.document().panels(); ++panel) {
    const Legend& legend = bench.window.panel(panel).legend();
    texts << legend.lowest() << legend.highest() << bench.find<ViolationLine>("violation0")->sentence();
  }
  return texts;
}

}  // namespace

class WindowWords : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }
  void cleanup() { QSettings().remove(QStringLiteral("figures")); }

  void violationIsASentenceAndABar() {
    const auto of = [](double fraction, double largest) {
      return sentenceOf(statisticsOf(fraction, largest, true), {.hasMoved = true});
    };
    QCOMPARE(of(0.304, 2.84), QStringLiteral("30 % of links violated, worst 2.8 × rest length"));
    // Few are not none, and almost all are not all.
    QVERIFY(of(0.0004, 0.5).startsWith(QStringLiteral("< 1 %")));
    QVERIFY(of(0.998, 12.3).startsWith(QStringLiteral("> 99 %")));
    QVERIFY(!of(0.5, std::numeric_limits<double>::infinity()).contains(QStringLiteral("inf")));
    QCOMPARE(of(0, 1e-7), QStringLiteral("All links are valid"));
    // Links that are not measured yet are said to be missing.
    QCOMPARE(sentenceOf(statisticsOf(0.304, 2.84, false)),
             QStringLiteral("30 % of links violated so far, worst 2.8 × rest length"));
    QCOMPARE(sentenceOf(statisticsOf(0, 0, false)), QStringLiteral("All links are valid so far"));
    // The bar weighs size and number: many small violations are less than a few large ones, as in a lesson in which FEM
    // violates 92 % of the links.
    Statistics many = statisticsOf(0.92, 0.1, true), few = statisticsOf(0.02, 3, true);
    many.violation.rms = 0.03;
    few.violation.rms = 0.4;
    ViolationLine ofMany, ofFew;
    ofMany.show(many, {.worst = 0.4});
    ofFew.show(few, {.worst = 0.4});
    QCOMPARE(ofFew.share(), 1.0);
    QVERIFY(std::abs(ofMany.share() - 0.075) < 1e-9);
    ofMany.show(many, {.worst = 0.03});
    QVERIFY(std::abs(ofMany.share() - 0.3) < 1e-9);  // even in the worst panel: it is little
    ofMany.show(many, {.hasMoved = false});
    QCOMPARE(ofMany.share(), 0.0);
    many.violation.rms = std::nan("");
    ofMany.show(many, {.worst = 0.4});
    QCOMPARE(ofMany.share(), 1.0);
  }

  /// The element of a link that has almost no length is pinned, and the other one is far away.
  void figuresThatAreNotFiniteAreNoWordsOfTheLibrary() {
    Workbench bench(almostNoLength());
    edits::setPinned(bench.document(), {0}, true);
    bench.document().handle().grab(1);
    bench.document().handle().drag({100, 0, 0});
    bench.document().handle().release();
    QTest::keyClick(&bench.view(0), Qt::Key_I);  // shows the figures
    bench.trigger("colourBy-violation");
    bench.settleFigures();
    QVERIFY(!std::isfinite(bench.document().solvers().frame(0)->statistics.violation.max));
    bench.document().selection().set({1});
    bench.settleFigures();
    bench.document().highlight().set({ElementId{1}, false, {}});  // in the status bar
    static const QRegularExpression raw(QStringLiteral("\\b(inf|nan)\\b"), QRegularExpression::CaseInsensitiveOption);
    for (const QString& text : textsOf(bench)) {
      QVERIFY2(!text.contains(raw), qPrintable(text));
    }
    QVERIFY(bench.find<QLabel>("statistics0")->text().contains(QStringLiteral("max <b>∞</b>")));
  }

  /// The bars of all panels have one scale: that of the worst one.
  void theSentenceAndTheBarFollowADrag() {
    Workbench bench;
    const auto* line = bench.find<ViolationLine>("violation0");
    bench.settleFigures();
    QCOMPARE(line->sentence(), QStringLiteral("Nothing has moved yet"));
    bench.trigger("pinBottom");  // both algorithms violate links then, Natural Queue fewer
    bench.document().handle().grab(31);
    bench.document().handle().dragBy({2, 2, 0});
    bench.document().handle().release();
    bench.settleFigures();
    QVERIFY(line->sentence().contains(QStringLiteral("links violated, worst ")));
    const auto rms = [&](int panel) { return bench.document().solvers().statistics(panel).violation.rms; };
    QVERIFY(rms(0) > 1.2 * rms(1) && rms(1) > 0.2);
    QCOMPARE(line->share(), 1.0);
    QCOMPARE(bench.find<ViolationLine>("violation1")->share(), rms(1) / rms(0));
    bench.document().undoStack().undo();
    QTRY_COMPARE(line->sentence(), QStringLiteral("All links are valid"));
  }

  void aLegendWithoutValuesSaysWhy() {
    Legend legend;
    legend.setPart(Legend::Part::nothing);  // opens no window
    for (const QString& why : {QStringLiteral("Error: drag an element first"), QStringLiteral("Error: computing…")}) {
      legend.show({why, {}, {}});
      QCOMPARE(legend.title(), why);
    }
  }

  void aPanelWhoseSolverIsLateSaysSo() {
    ViolationLine line;
    line.show(statisticsOf(0, 0, true), {.work = QStringLiteral("Preparing…")});
    QCOMPARE(line.sentence(), QStringLiteral("Preparing…"));
    QVERIFY(line.share() < 0);
    Workbench bench;
    auto* shown = bench.find<ViolationLine>("violation0");
    bench.settleFigures();
    std::promise<void> goesOn;
    std::atomic<bool> waits = false;
    bench.document().solvers().ask(0, [&waits, wait = goesOn.get_future().share()](const Simulation&) {
      waits = true;
      wait.wait();
    });
    QTRY_VERIFY(waits);
    QCoreApplication::processEvents();                            // frames of before have come
    bench.document().highlight().set({ElementId{31}, true, {}});  // a handle, whose first move takes long
    QTRY_COMPARE(shown->sentence(), QStringLiteral("Preparing…"));
    goesOn.set_value();
    QTRY_COMPARE(shown->sentence(), QStringLiteral("Nothing has moved yet"));
    bench.document().highlight().set({});
  }

  void figuresAppearOnDemandAndAreRemembered() {
    {
      Workbench bench;
      QVERIFY(!bench.find<QLabel>("statistics0")->isVisible());
      QTest::keyClick(&bench.view(0), Qt::Key_I);
      QVERIFY(bench.find<QLabel>("statistics0")->isVisible() && bench.find<QLabel>("statistics1")->isVisible());
      bench.trigger("addPanel");
      bench.settle();
      QVERIFY(bench.find<QLabel>("statistics2")->isVisible());
    }
    const Workbench second;
    QVERIFY(second.window.findChild<QLabel*>(QStringLiteral("statistics0"))->isVisible());
  }

  void aButtonPinsTheBottomWherePinsAreMissing() {
    Workbench bench(generate({MeshKind::tetra, {5, 4, 4}, 1, {}}));
    auto* button = bench.find<QToolButton>("pinBottom0");
    QVERIFY(!button->isVisible());
    bench.choose(0, "Linear FEM");
    QVERIFY(button->isVisible() && !bench.find<QToolButton>("pinBottom1")->isVisible());
    QTest::mouseClick(button, Qt::LeftButton);
    bench.settle();
    QCOMPARE(bench.document().pins().size(), std::size_t{20});  // 5 x 4 elements
    QVERIFY(!button->isVisible());
    bench.document().undoStack().undo();
    bench.settle();
    QVERIFY(bench.document().pins().empty() && button->isVisible());
  }

  /// What the head has no room for is neither hidden nor shortened, and the object does not move.
  void statesThatDoNotFitInTheHeadAreChipsOverTheView() {
    Workbench bench;
    const auto* head = bench.find<QLabel>("state0");
    const auto* chips = bench.window.panel(0).findChild<StateChips*>();
    const auto shown = [&] {
      const QStringList inHead = head->text().split(QStringLiteral(" · "), Qt::SkipEmptyParts);
      return inHead + chips->states();
    };
    edits::setPinned(bench.document(), {0}, true);
    QTRY_COMPARE(shown(), QStringList{QStringLiteral("1 pinned")});
    QVERIFY(!chips->isVisible());
    const QRect before = bench.view(0).geometry();
    bench.document().undoStack().undo();
    edits::setPinned(bench.document(), {0, 1}, true);
    bench.chooseGhost(0, QStringLiteral("Panel B"));
    const QStringList both{QStringLiteral("2 pinned"), QStringLiteral("50 % ghost of B")};
    bench.window.resize(bench.window.minimumSizeHint());
    QTRY_COMPARE(shown(), both);
    QVERIFY(chips->isVisible() && !chips->states().isEmpty());
    QVERIFY(bench.view(0).geometry().contains(chips->geometry()));
    QCOMPARE(bench.view(0).geometry().top(), before.top());
  }

  void lectureModeShowsOnlyThePanelsAndRestoresTheWindow() {
    Workbench bench;
    const Layout before = bench.window.arrangement();
    const QSize size = bench.window.size();
    const int letters = bench.find<QLabel>("state0")->fontInfo().pixelSize();
    bench.trigger("lectureMode");
    bench.settle();
    for (const auto* dock : bench.window.findChildren<QDockWidget*>()) {
      QVERIFY(!dock->isVisible());
    }
    auto& legend = bench.window.panel(0).legend();
    QVERIFY(legend.height() >= 2 * legend.fontMetrics().height());
    QVERIFY(!bench.find<QToolBar>("mainToolBar")->isVisible());
    auto* tool = bench.find<QLabel>("lectureTool");
    QVERIFY(tool->isVisible());
    QCOMPARE(tool->text(), QStringLiteral("Tool: <b>Drag</b>  ·  F11 ends the lecture mode"));
    bench.trigger("toolCut");
    QVERIFY(tool->text().contains(QStringLiteral("Cut")));
    QVERIFY(bench.window.findChild<ViolationLine*>(QStringLiteral("violation0"))->fontInfo().pixelSize() > letters);
    QCOMPARE(bench.window.arrangement(), before);  // what a session stores
    QTest::keyClick(&bench.view(0), Qt::Key_Escape);
    bench.settle();
    QVERIFY(!bench.find<QAction>("lectureMode")->isChecked());
    QVERIFY(bench.find<QToolBar>("mainToolBar")->isVisible() && !tool->isVisible());
    QVERIFY(bench.find<QDockWidget>("toolsDock")->isVisible());
    QTRY_COMPARE(bench.window.size(), size);
    QCOMPARE(bench.window.findChild<ViolationLine*>(QStringLiteral("violation0"))->fontInfo().pixelSize(), letters);
  }

  void inLectureModeKeysWorkWithoutTheMenus() {
    Workbench bench;
    QVERIFY(bench.window.menuBar()->isVisible());
    const QList<QAction*> actions = bench.window.actions();
    QTest::keyClick(&bench.view(0), Qt::Key_F11);
    bench.settle();
    QVERIFY(!bench.window.menuBar()->isVisible());
    QTest::keyClick(&bench.view(0), Qt::Key_P);
    QVERIFY(bench.find<QAction>("toolPin")->isChecked());
    QTest::keyClick(&bench.view(0), Qt::Key_I);
    QVERIFY(bench.find<QAction>("showFigures")->isChecked());
    QTest::keyClick(&bench.view(0), Qt::Key_N);  // a submenu has it
    bench.settle();
    QCOMPARE(bench.document().panels(), 3);
    QTest::keyClick(&bench.view(0), Qt::Key_Escape);
    bench.settle();
    QVERIFY(!bench.find<QAction>("lectureMode")->isChecked());
    QVERIFY(bench.window.menuBar()->isVisible());
    QCOMPARE(bench.window.actions(), actions);
    QTest::keyClick(&bench.view(0), Qt::Key_F11);
    QTest::keyClick(&bench.view(0), Qt::Key_F11);
    bench.settle();
    QVERIFY(bench.window.menuBar()->isVisible());
  }
};

CHAINMAIL_WINDOW_TEST(WindowWords)

}  // namespace chainmail::window_words

#include "window_words.moc"
