// Tests the words around the views: the sentence on violation, figures on demand, the list of algorithms, the lecture
// mode, and the tool bar in narrow windows.

#include <QAbstractItemView>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPainter>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>
#include <atomic>
#include <cmath>
#include <limits>

#include "document/edits.h"
#include "io/samples.h"
#include "panels/algorithm_delegate.h"
#include "panels/colour_selector.h"
#include "panels/legend.h"
#include "panels/state_chips.h"
#include "panels/violation_line.h"
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

constexpr int wide = 900;  // pixels, more than any sentence needs

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

  void violationIsASentence_data() {
    QTest::addColumn<double>("fraction");
    QTest::addColumn<double>("largest");
    QTest::addColumn<bool>("moved");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("some") << 0.304 << 2.84 << true << QStringLiteral("30 % of links violated, worst 2.8 × rest length");
    QTest::newRow("few") << 0.0004 << 0.5 << true << QStringLiteral("< 1 % of links violated, worst 0.5 × rest length");
    QTest::newRow("almost all") << 0.998 << 12.3 << true
                                << QStringLiteral("> 99 % of links violated, worst 12 × rest length");
    QTest::newRow("all") << 1.0 << 1.0 << true << QStringLiteral("100 % of links violated, worst 1 × rest length");
    QTest::newRow("a hundred") << 0.13 << 100.3 << true
                               << QStringLiteral("13 % of links violated, worst 100 × rest length");
    QTest::newRow("almost a hundred") << 0.13 << 99.7 << true
                                      << QStringLiteral("13 % of links violated, worst 100 × rest length");
    QTest::newRow("between 99 and a hundred")
        << 0.13 << 99.5 << true << QStringLiteral("13 % of links violated, worst 100 × rest length");
    QTest::newRow("far") << 0.13 << 11234.4 << true
                         << QStringLiteral("13 % of links violated, worst 11,234 × rest length");
    QTest::newRow("not finite") << 0.5 << std::numeric_limits<double>::infinity() << true
                                << QStringLiteral("50 % of links violated, some without a finite length");
    QTest::newRow("none") << 0.0 << 1e-7 << true << QStringLiteral("All links are valid");
    QTest::newRow("at the start") << 0.0 << 0.0 << false << QStringLiteral("Nothing has moved yet");
  }
  void violationIsASentence() {
    QFETCH(double, fraction);
    QFETCH(double, largest);
    QFETCH(bool, moved);
    QFETCH(QString, sentence);
    QCOMPARE(sentenceOf(statisticsOf(fraction, largest, true), {.hasMoved = moved}), sentence);
  }
  void linksThatAreNotMeasuredYetAreSaidToBeMissing() {
    QCOMPARE(sentenceOf(statisticsOf(0.304, 2.84, false)),
             QStringLiteral("30 % of links violated so far, worst 2.8 × rest length"));
    QCOMPARE(sentenceOf(statisticsOf(0, 0, false)), QStringLiteral("All links are valid so far"));
  }

  void withoutFiguresTheSentenceSaysSo() {
    const ViolationLine line;
    QCOMPARE(line.sentence(), QStringLiteral("No figures yet"));
    QVERIFY(line.share() < 0);
  }

  void inTheMiddleOfAPassTheSentenceIsAboutItsEnd() {
    ViolationLine line;
    line.show(statisticsOf(0, 0, true), {.inMidPass = true});
    QCOMPARE(line.sentence(), QStringLiteral("All links are valid after the pass"));
    line.show(statisticsOf(0.304, 2.84, true), {.inMidPass = true});
    QCOMPARE(line.sentence(), QStringLiteral("30 % of links violated after the pass, worst 2.8 × rest length"));
  }

  void theSidesOfTheCameraAreNamedAfterTheUpAxis() {
    Workbench bench;
    const auto names = [&] {
      for (QMenu* menu : bench.window.findChildren<QMenu*>()) {
        emit menu->aboutToShow();  // the names are brought up to date then
      }
      QStringList sides;
      for (const QAction* action : bench.window.findChildren<QAction*>()) {
        const QString text = action->text().remove(QLatin1Char('&'));
        if (text.startsWith(QStringLiteral("From ")) && text.endsWith(QLatin1Char(')'))) {
          sides << text.mid(5);
        }
      }
      sides.sort();
      return sides.join(QStringLiteral(", "));
    };
    bench.find<QAction>("upZ")->setChecked(false);
    QCOMPARE(names(), QStringLiteral("+x (right), +y (top), +z (front), −x (left), −y (bottom), −z (back)"));
    bench.find<QAction>("upZ")->setChecked(true);
    QCOMPARE(names(), QStringLiteral("+x (right), +y (back), +z (top), −x (left), −y (front), −z (bottom)"));
    bench.find<QAction>("upZ")->setChecked(false);
  }

  void aNarrowLineSaysItShorterAndAWideOneAllAgain() {
    ViolationLine line;
    line.resize(wide, line.sizeHint().height());
    line.QWidget::show();
    QVERIFY(QTest::qWaitForWindowExposed(&line));
    line.show(statisticsOf(0.304, 2.84, true), {});
    const QString whole = QStringLiteral("30 % of links violated, worst 2.8 × rest length");
    const auto* shown = line.findChild<QLabel*>(QStringLiteral("sentence"));
    QCOMPARE(shown->text(), whole);
    // The figures stay the same, only the room changes.
    const auto fit = [&](const QString& sentence, int more) {
      const int bar = line.width() - shown->width();
      line.resize(bar + shown->fontMetrics().horizontalAdvance(sentence) + more, line.height());
    };
    fit(whole, -1);
    QTRY_COMPARE(shown->text(), QStringLiteral("30 % violated, worst 2.8 ×"));
    fit(shown->text(), -1);
    QTRY_COMPARE(shown->text(), QStringLiteral("30 % violated"));
    fit(shown->text(), -1);
    QTRY_COMPARE(shown->text(), QStringLiteral("30 %"));  // the number is never cut
    fit(whole, 1);                                        // a width is rounded
    QTRY_COMPARE(shown->text(), whole);
  }

  void aLengthThatIsNotFiniteIsNoNumberInANarrowLine() {
    ViolationLine line;
    line.show(statisticsOf(0.5, std::numeric_limits<double>::infinity(), true), {});
    auto* shown = line.findChild<QLabel*>(QStringLiteral("sentence"));
    line.resize(wide, line.sizeHint().height());
    shown->resize(shown->fontMetrics().horizontalAdvance(line.sentence()) - 1, shown->height());
    line.show(statisticsOf(0.5, std::numeric_limits<double>::infinity(), true), {});
    QCOMPARE(shown->text(), QStringLiteral("50 % violated, some not finite"));
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
    static const QRegularExpression raw(QStringLiteral("\\b(inf|nan)\\b"), QRegularExpression::CaseInsensitiveOption);
    for (const QString& text : textsOf(bench)) {
      QVERIFY2(!text.contains(raw), qPrintable(text));
    }
    QVERIFY(bench.find<QLabel>("statistics0")->text().contains(QStringLiteral("max <b>∞</b>")));
  }

  void aRemarkOfTheSolverReplacesTheSentence() {
    Statistics statistics = statisticsOf(0.5, 1, true);
    statistics.remark = "the method did not converge";
    QCOMPARE(sentenceOf(statistics), QStringLiteral("the method did not converge"));
  }

  void theSentenceFollowsADrag() {
    Workbench bench;
    auto* line = bench.window.findChild<ViolationLine*>(QStringLiteral("violation0"));
    bench.settleFigures();
    QCOMPARE(line->sentence(), QStringLiteral("Nothing has moved yet"));
    bench.dragFar();
    bench.settleFigures();
    const Violation& violation = bench.document().solvers().frame(0)->statistics.violation;
    QVERIFY(violation.fraction > 0);
    QVERIFY(line->sentence().contains(QStringLiteral("links violated, worst ")));
    double worst = 0;
    for (int panel = 0; panel < 2; ++panel) {
      worst = std::max(worst, bench.document().solvers().frame(panel)->statistics.violation.rms);
    }
    QCOMPARE(line->share(), violation.rms / ViolationLine::fullAt(worst));
    bench.document().undoStack().undo();
    QTRY_COMPARE(line->sentence(), QStringLiteral("All links are valid"));
  }

  /// Many small violations are less than a few large ones, as in a lesson in which FEM violates 92 % of the links.
  void theBarWeighsSizeAndNumber() {
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

  /// A session brings positions without moves.
  void aDeformedObjectHasMoved() {
    Workbench bench;
    auto* line = bench.find<ViolationLine>("violation0");
    const PositionRuns positions{false, {0, 1}, {-0.1, 0}};
    const auto snapshot = snapshot_of(positions, *bench.document().mesh(), Precision::double_precision);
    bench.document().solvers().post(0, commands::SetPositions{std::make_shared<Snapshot>(snapshot)});
    QTRY_COMPARE(line->sentence(), QStringLiteral("All links are valid"));
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

  void theListExplainsEachAlgorithm() {
    Workbench bench;
    const QComboBox& selector = bench.window.panel(0).selector();
    for (const AlgorithmInfo& info : every_algorithm()) {
      const int row = selector.findData(int(info.algorithm));
      const QString explanation = selector.itemData(row, AlgorithmDelegate::explanationRole).toString();
      const bool possible = selector.model()->flags(selector.model()->index(row, 0)).testFlag(Qt::ItemIsEnabled);
      QVERIFY(!explanation.isEmpty());
      QCOMPARE(!explanation.startsWith(QStringLiteral("Not available: ")), possible);
      QVERIFY(!possible || explanation.toLower() == QString::fromUtf8(info.summary.data()).toLower());
    }
  }

  /// The view of the list paints all rows with one painter.
  void aRowOfTheListLeavesThePainterAsItWas() {
    Workbench bench;
    const QComboBox& selector = bench.window.panel(0).selector();
    QVERIFY(!selector.itemData(0, AlgorithmDelegate::explanationRole).toString().isEmpty());
    QImage picture(300, 100, QImage::Format_ARGB32);
    QPainter painter(&picture);
    QStyleOptionViewItem option;
    option.initFrom(selector.view());
    option.rect = picture.rect();
    const QFont font = painter.font();
    const QPen pen = painter.pen();
    AlgorithmDelegate().paint(&painter, option, selector.model()->index(0, 0));
    QCOMPARE(painter.opacity(), 1.0);
    QVERIFY(painter.font() == font && painter.pen() == pen);
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

  void aNameThatIsTooLongForItsSelectorEndsInAnEllipsis() {
    const auto picture = [](const QString& text, int width) {
      QComboBox selector;
      selector.addItem(text);
      selector.resize(width, selector.sizeHint().height());
      return selector.grab().toImage();
    };
    const QString name = QStringLiteral("Generalized ChainMail");
    constexpr int narrow = 100;
    bool isShortened = false;
    for (qsizetype length = 1; length < name.size(); ++length) {
      isShortened = isShortened || picture(name, narrow) == picture(name.first(length) + QChar(0x2026), narrow);
    }
    QVERIFY(isShortened);
    QVERIFY(picture(name, 3 * narrow) != picture(name.first(name.size() - 1), 3 * narrow));
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

  void inLectureModeTheLastRowReadsEverything() {
    Workbench bench;
    bench.open(lessonsFolder() + QStringLiteral("/waiting-list.chainmail"));
    auto* caption = bench.find<QLabel>("lessonText");
    auto* alone = bench.find<QToolButton>("aloneButton0");
    auto* list = bench.find<QTreeView>("waitingList0");
    const int letters = caption->fontInfo().pixelSize(), ofList = list->fontInfo().pixelSize();
    const QSize icons = alone->iconSize();
    const QSize button = bench.find<QPushButton>("lessonNextButton")->sizeHint();
    bench.trigger("lectureMode");
    bench.settle();
    constexpr int least = 24;  // pixels
    for (const char* name : {"lessonText", "lessonStep", "lessonTitle", "readout", "lectureTool", "state0"}) {
      QVERIFY2(bench.find<QLabel>(name)->fontInfo().pixelSize() >= least, name);
    }
    const Panel& panel = bench.window.panel(0);
    QVERIFY(caption->fontInfo().pixelSize() >= panel.fontInfo().pixelSize());
    QVERIFY(caption->height() >= caption->heightForWidth(caption->width()));  // nothing is cut off
    QVERIFY(bench.find<ViolationLine>("violation0")->fontInfo().pixelSize() >= least);
    QVERIFY(bench.find<Legend>("legend0")->fontInfo().pixelSize() >= least);
    QVERIFY(list->fontInfo().pixelSize() >= least);
    QVERIFY(alone->iconSize().width() > 1.5 * icons.width());
    QVERIFY(bench.find<QPushButton>("lessonNextButton")->height() > button.height());
    bench.trigger("addPanel");
    bench.settle();
    QVERIFY(bench.find<QToolButton>("aloneButton2")->iconSize() == alone->iconSize());
    bench.trigger("removePanel");
    bench.trigger("lectureMode");
    bench.settle();
    QCOMPARE(caption->fontInfo().pixelSize(), letters);
    QCOMPARE(list->fontInfo().pixelSize(), ofList);
    QCOMPARE(alone->iconSize(), icons);
    QCOMPARE(bench.find<QPushButton>("lessonNextButton")->sizeHint(), button);
  }

  void inLectureModeLinksAreTwiceAsWide() {
    Workbench bench(generate({MeshKind::grid, {2, 2, 1}, 1, {}}));
    const auto wide = [&] {
      const QImage picture = bench.view(0).grabFramebuffer();
      const QPointF middle = (bench.view(0).viewPosition(0) + bench.view(0).viewPosition(1)) / 2;
      const int x = int(middle.x()), y = int(middle.y());
      int lit = 0;  // sum over the pixels across the link
      for (int dy = -8; dy <= 8; ++dy) {
        lit += std::abs(qGray(picture.pixel(x, y + dy)) - qGray(picture.pixel(x, y + 20)));
      }
      return lit;
    };
    const int usual = wide();
    QVERIFY(usual > 0);
    bench.trigger("lectureMode");
    bench.settle();
    QVERIFY2(wide() > 1.6 * usual, qPrintable(QStringLiteral("%1 after %2").arg(wide()).arg(usual)));
    bench.trigger("lectureMode");
    bench.settle();
    QCOMPARE(wide(), usual);
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

  void aHintShowsWholePartsThatHaveRoom() {
    Workbench bench;
    auto* readout = bench.find<QLabel>("readout");
    QTRY_VERIFY(readout->text().contains(QStringLiteral("Wheel")));
    bench.trigger("lectureMode");
    bench.window.showNormal();
    bench.window.resize(900, 600);
    bench.settle();
    const QString text = readout->text();
    QVERIFY2(readout->fontMetrics().horizontalAdvance(text) <= readout->width(), qPrintable(text));
    QVERIFY(!text.contains(QStringLiteral("Wheel")));
    bench.window.resize(1300, 600);
    bench.settle();
    QTRY_VERIFY2(readout->text().startsWith(QStringLiteral("Left: drag")), qPrintable(readout->text()));
    QVERIFY(!readout->text().contains(QStringLiteral("Wheel")));
    bench.trigger("lectureMode");
  }

  void aNarrowToolBarShowsIconsAndColourByStays_data() {
    QTest::addColumn<int>("width");
    QTest::newRow("1024") << 1024;
    QTest::newRow("1280") << 1280;
  }
  void aNarrowToolBarShowsIconsAndColourByStays() {
    QFETCH(int, width);
    Workbench bench;
    bench.window.resize(width, 720);
    QTRY_COMPARE(bench.window.width(), width);
    bench.settle();
    const auto* bar = bench.find<QToolBar>("mainToolBar");
    const auto* colourBy = bench.window.findChild<ColourSelector*>();
    QVERIFY(colourBy->isVisible() && bar->rect().contains(colourBy->geometry()));
    QVERIFY(bar->sizeHint().width() <= width || bar->toolButtonStyle() == Qt::ToolButtonIconOnly);
  }
};

CHAINMAIL_WINDOW_TEST(WindowWords)

}  // namespace chainmail::window_words

#include "window_words.moc"
