// Tests lessons in a real window: every bundled lesson runs to its end and back, to the bit, and replaces no work.

#include <QDockWidget>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <cmath>

#include "common/colours.h"
#include "document/edits.h"
#include "document/lesson_player.h"
#include "files/session/session.h"
#include "io/samples.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "measure/violation.h"
#include "panels/panel_area.h"
#include "panels/panel_state.h"
#include "window.h"
#include "window/bars.h"
#include "window/lesson_bar.h"
#include "window/lessons.h"
#include "window/show_menu.h"

namespace chainmail::window_lessons {

namespace {

/// The exact state of the object in all panels.
struct State {
  std::vector<Snapshot> panels;
  std::vector<Algorithm> algorithms;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  std::size_t position;

  bool operator==(const State&) const = default;
};

State stateOf(Workbench& bench) {
  Document& document = bench.document();
  State state{{}, {}, document.cuts().links(), document.pins(), document.moves().history().position()};
  for (int panel = 0; panel < document.panels(); ++panel) {
    state.panels.push_back(document.solvers().snapshots()[std::size_t(panel)].get());
    state.algorithms.push_back(document.algorithm(panel));
  }
  return state;
}

LessonPlayer& player(Workbench& bench) { return bench.window.lessons().player(); }

QString pathOf(const char* file) { return lessonsFolder() + QLatin1Char('/') + QLatin1String(file); }

void awaitStep(Workbench& bench) {
  // Waits in shorter steps than QTRY_VERIFY.
  QVERIFY(QTest::qWaitFor([&] { return !player(bench).plays() && bench.document().solvers().idle(); }));
}

void open(Workbench& bench, const QString& path) {
  bench.open(path);
  QVERIFY(player(bench).isOpen());
  awaitStep(bench);
}

/// Goes to the end of the next step without its animation.
void next(Workbench& bench) {
  bench.trigger("lessonNext");
  QVERIFY(QTest::qWaitFor([&] {
    if (player(bench).plays()) {
      bench.trigger("lessonNext");
    }
    return !player(bench).plays();
  }));
  awaitStep(bench);
}

void back(Workbench& bench) {
  bench.trigger("lessonBack");
  awaitStep(bench);
}

/// Drags an element by hand, away from the state of the lesson.
void disturb(Workbench& bench) {
  Document& document = bench.document();
  const std::vector<ElementId>& pins = document.pins();
  ElementId element = 0;
  while (std::ranges::binary_search(pins, element)) {
    ++element;
  }
  document.handle().grab(element);
  document.handle().dragBy({0.7, 0.4, 0});
  document.handle().release();
  QVERIFY(QTest::qWaitFor([&] { return document.solvers().idle(); }));
}

/// Returns the share of links that are violated in a panel.
double violated(Workbench& bench, int panel) {
  bench.settle();
  const Document& document = bench.document();
  return measure_violation(*document.mesh(), *document.wholeSoftness(), document.cuts(),
                           document.solvers().frame(panel)->view())
      .fraction;
}

/// Returns the number of elements that a panel shows away from rest.
std::size_t shownAwayFromRest(Workbench& bench, int panel) {
  const Mesh& mesh = *bench.document().mesh();
  std::size_t count = 0;
  for (ElementId element = 0; element < mesh.element_count(); ++element) {
    count += (bench.position(panel, element) - mesh.rest_position(element)).norm() > 1e-6 ? 1 : 0;
  }
  return count;
}

/// Writes a copy of a lesson with a passage replaced, and returns its path.
QString changed(const QTemporaryDir& folder, const char* file, const QByteArray& passage, const QByteArray& other) {
  QFile from(pathOf(file));
  if (!from.open(QIODevice::ReadOnly)) {
    return {};
  }
  QByteArray text = from.readAll();
  if (!text.contains(passage)) {
    return {};
  }
  QFile to(folder.filePath(QStringLiteral("mine.chainmail")));
  to.open(QIODevice::WriteOnly);
  to.write(text.replace(passage, other));
  return to.fileName();
}

}  // namespace

class WindowLessons : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    shared_ = std::make_unique<Workbench>();
    shared_->window.resize(900, 600);  // drawing takes most of the time
  }
  void cleanupTestCase() { shared_.reset(); }
  void init() { failOnWarnings(); }
  void eachLessonRunsToItsEndAndBack_data();
  void eachLessonRunsToItsEndAndBack();
  void theBarShowsTheStep();
  void nextPlaysVisiblyAndASecondNextEndsIt();
  void theViewsStayStillWhileAStepPlaysAndAsTheUserChoseThem();
  void theHandleIsMarkedAfterItsDrag();
  void theEndAndPageDownLeadThroughAllLessons();
  void theNameOfTheNextLessonFitsANarrowBar();
  void undoAndRedoKeepTheLessonAndMoveTheCaption();
  void theBarKeepsItsHeightAndALongCaptionScrolls();
  void theNextObjectHasTheColoursOfBefore();
  void aDragDuringAStepStopsIt();
  void relaxationAndPanelsOfTheUserAreTakenBack();
  void theWaitingListIsShownStepByStepAndItsFiguresAreOfTheWholePass();
  void theLessonsShowTheirPoint();
  void aLessonReplacesNoWork();
  void aLessonAloneIsNoUnsavedWork();
  void unsavedWorkIsOfferedAgain();
  void savingKeepsTheCaptions();
  void aCutByTheUserStaysOutOfTheLesson();
  void aDamagedLessonChangesNothingAndUnknownNamesAreReported();
  void closingHidesTheBar();
  void theUserChoosesWhatIsShown();
  void docksThatWereOpenStayOpen();

 private:
  /// Returns a window that tests share, with another object and without a lesson. It saves the time to open windows.
  Workbench& shared() {
    edits::replaceMesh(shared_->document(), generate({MeshKind::grid, {9, 7, 1}, 1, {}}), QStringLiteral("sample"),
                       QStringLiteral("open"));
    shared_->document().undoStack().clear();
    return *shared_;
  }

  std::unique_ptr<Workbench> shared_;
};

void WindowLessons::eachLessonRunsToItsEndAndBack_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("title");
  for (const LessonFile& lesson : lessonFiles()) {
    QTest::newRow(lesson.file) << QString::fromUtf8(lesson.file) << QString::fromUtf8(lesson.title);
  }
}

void WindowLessons::eachLessonRunsToItsEndAndBack() {
  QFETCH(QString, file);
  QFETCH(QString, title);
  Workbench& bench = shared();
  open(bench, pathOf(qPrintable(file)));
  QCOMPARE(QString::fromStdString(player(bench).lesson().title), title);
  std::vector<State> states{stateOf(bench)};
  while (!player(bench).isLast()) {
    next(bench);
    states.push_back(stateOf(bench));
    QCOMPARE(states.back().position, player(bench).lesson().steps[player(bench).step()].until);
    QVERIFY(bench.window.area().fits());
    QVERIFY(bench.window.area().showsAll());
  }
  QVERIFY(bench.window.messages().isHidden());  // no panel has refused a move
  for (std::size_t step = states.size() - 1; step-- > 0;) {
    back(bench);
    QCOMPARE(player(bench).step(), step);
    QVERIFY2(stateOf(bench) == states[step], qPrintable(QStringLiteral("back to step %1").arg(step + 1)));
    QVERIFY(bench.window.area().showsAll());
  }
  for (std::size_t step = 1; step < states.size(); ++step) {
    disturb(bench);
    next(bench);
    QVERIFY2(stateOf(bench) == states[step], qPrintable(QStringLiteral("disturbed before step %1").arg(step + 1)));
  }
  disturb(bench);
  back(bench);
  QVERIFY(stateOf(bench) == states[states.size() - 2]);
}

void WindowLessons::theBarShowsTheStep() {
  Workbench& bench = shared();
  QVERIFY(bench.window.lessons().bar().isHidden());
  open(bench, pathOf("order.chainmail"));
  QVERIFY(bench.window.lessons().bar().isVisible());
  const auto text = [&](const char* name) { return bench.find<QLabel>(name)->text(); };
  const auto& steps = player(bench).lesson().steps;
  QCOMPARE(text("lessonStep"), QStringLiteral("Step 1 of 4"));
  QVERIFY(text("lessonTitle").endsWith(QString::fromStdString(steps[0].title)));
  QCOMPARE(text("lessonText"), QString::fromStdString(steps[0].text));
  QVERIFY(!bench.find<QPushButton>("lessonBackButton")->isEnabled());
  const auto* leave = bench.find<QToolButton>("lessonCloseButton");
  QVERIFY(leave->isVisible() && leave->width() >= leave->iconSize().width());  // the title leaves it room
  QTest::keyClick(&bench.window, Qt::Key_PageDown);
  QTest::keyClick(&bench.window, Qt::Key_PageDown);  // to the end of the step
  awaitStep(bench);
  QCOMPARE(text("lessonStep"), QStringLiteral("Step 2 of 4"));
  QCOMPARE(text("lessonText"), QString::fromStdString(steps[1].text));
  QTest::keyClick(&bench.window, Qt::Key_PageUp);
  awaitStep(bench);
  QCOMPARE(text("lessonStep"), QStringLiteral("Step 1 of 4"));
  for (int i = 0; i < 3; ++i) {
    next(bench);
  }
  QVERIFY(!bench.find<QPushButton>("lessonNextButton")->isVisible());
  QCOMPARE(bench.window.colouring().mode(), ColourMode::violation);
}

/// What a lesson shows holds until the user chooses.
void WindowLessons::theUserChoosesWhatIsShown() {
  Workbench bench(cloth());
  ShowMenu& menu = bench.window.showMenu();
  menu.show(QStringLiteral("surface"));
  QCOMPARE(menu.chosen(), QStringLiteral("surface"));
  bench.trigger("showLinks");
  QCOMPARE(menu.chosen(), QStringLiteral("links"));
}

/// A lesson hides the dock that it has opened, and no other.
void WindowLessons::docksThatWereOpenStayOpen() {
  Workbench bench;
  auto* dock = bench.find<QDockWidget>("propagationDock");
  for (const bool wasOpen : {true, false}) {
    dock->setVisible(wasOpen);
    bench.settle();
    open(bench, pathOf("waiting-list.chainmail"));
    QTRY_VERIFY(dock->isVisible());
    bench.find<QToolButton>("lessonCloseButton")->click();
    bench.settle();
    QCOMPARE(dock->isVisible(), wasOpen);
  }
}

void WindowLessons::nextPlaysVisiblyAndASecondNextEndsIt() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  const std::size_t until = player(bench).lesson().steps[1].until;
  std::vector<std::size_t> seen;
  QObject context;
  connect(&bench.document().moves(), &MovePlayer::changed, &context,
          [&] { seen.push_back(bench.document().moves().history().position()); });
  bench.trigger("lessonNext");
  QTRY_VERIFY(seen.size() > 5);
  QVERIFY(player(bench).plays());
  QVERIFY(std::ranges::is_sorted(seen));
  QVERIFY(bench.document().moves().history().position() < until);
  bench.trigger("lessonNext");
  QCOMPARE(bench.document().moves().history().position(), until);
  QCOMPARE(player(bench).step(), std::size_t{1});
  awaitStep(bench);
}

/// The views make room before the first move. The handle goes far beyond the object at rest.
void WindowLessons::theViewsStayStillWhileAStepPlaysAndAsTheUserChoseThem() {
  Workbench& bench = shared();
  open(bench, pathOf("physics.chainmail"));
  next(bench);
  const double before = bench.view(0).camera()->pose().height;
  std::vector<double> seen;
  QObject context;
  connect(&bench.document().moves(), &MovePlayer::changed, &context,
          [&] { seen.push_back(bench.view(0).camera()->pose().height); });
  bench.trigger("lessonNext");
  QTRY_VERIFY(seen.size() > 5);
  QVERIFY(player(bench).plays());
  QVERIFY(seen.front() > before);
  QCOMPARE(std::ranges::count(seen, seen.front()), std::ptrdiff_t(seen.size()));
  bench.trigger("lessonNext");
  awaitStep(bench);
  QVERIFY(bench.window.area().showsAll());

  // A view that the user chose stays.
  open(bench, pathOf("order.chainmail"));
  bench.view(0).zoom(1.5);
  const double chosen = bench.view(0).camera()->pose().height;
  next(bench);
  back(bench);
  QCOMPARE(bench.view(0).camera()->pose().height, chosen);
  bench.trigger("fitView");
  QVERIFY(bench.view(0).camera()->pose().height != chosen);
}

void WindowLessons::theHandleIsMarkedAfterItsDrag() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  QVERIFY(player(bench).dragged().empty());
  const auto marked = [&] {
    const auto all = player(bench).dragged();
    return std::vector<ElementId>(all.begin(), all.end());
  };
  const ElementId handle = 15 * 24 + 15;
  const auto isDrawn = [&](int panel) {
    bench.settle();
    return bench.distanceFromColour(panel, bench.view(panel).viewPosition(handle), colours::lit) == 0;
  };
  for (int step = 0; step < 3; ++step) {  // the last step has no moves
    next(bench);
    QCOMPARE(marked(), std::vector{handle});
    QVERIFY(isDrawn(0));
    QVERIFY(isDrawn(1));
  }
  disturb(bench);
  QVERIFY(marked().empty());
  back(bench);
  QCOMPARE(marked(), std::vector{handle});
  open(bench, pathOf("organ.chainmail"));
  next(bench);
  QVERIFY(marked().size() > 1);
  next(bench);
  QVERIFY(marked().empty());  // a cut
}

void WindowLessons::theEndAndPageDownLeadThroughAllLessons() {
  Workbench& bench = shared();
  const auto toEnd = [&] {
    while (!player(bench).isLast()) {
      next(bench);
    }
  };
  auto* following = bench.find<QPushButton>("lessonFollowingButton");
  auto* close = bench.find<QPushButton>("lessonEndButton");
  open(bench, pathOf("exact.chainmail"));
  QVERIFY(!following->isVisible());
  QVERIFY(!close->isVisible());
  toEnd();
  QVERIFY(following->isVisible());
  QCOMPARE(following->text(), QStringLiteral("Next lesson: Cut an organ"));
  QVERIFY(close->isVisible());
  QTest::mouseClick(following, Qt::LeftButton);
  bench.settle();
  QCOMPARE(player(bench).lesson().title, std::string("Cut an organ"));
  QCOMPARE(player(bench).step(), std::size_t{0});

  const auto title = [&] { return QString::fromStdString(player(bench).lesson().title); };
  const auto number = [&] { return bench.find<QLabel>("lessonStep")->text(); };
  const auto press = [&](Qt::Key key) {
    QTest::keyClick(&bench.window, key);
    bench.settle();
    awaitStep(bench);
  };
  bench.window.resize(1500, 600);  // the bar has room for it
  open(bench, pathOf("order.chainmail"));
  QVERIFY(!bench.find<QPushButton>("lessonBackButton")->isEnabled());  // it is the first lesson
  toEnd();
  QCOMPARE(number(), QStringLiteral("Step 4 of 4 · PgDown: next lesson"));
  press(Qt::Key_PageDown);
  QCOMPARE(title(), QStringLiteral("The waiting list, step by step"));
  QCOMPARE(player(bench).step(), std::size_t{0});
  QCOMPARE(number(), QStringLiteral("Step 1 of 5 · PgUp: lesson before"));
  press(Qt::Key_PageUp);
  QCOMPARE(title(), QStringLiteral("Why order matters"));
  QVERIFY(player(bench).isLast());  // as if nothing but the last key had been pressed
  QCOMPARE(bench.document().moves().history().position(), player(bench).lesson().steps.back().until);
  open(bench, pathOf("physics.chainmail"));  // the last one
  toEnd();
  QVERIFY(!number().contains(QStringLiteral("next lesson")));
  QVERIFY(!bench.find<QAction>("lessonNext")->isEnabled());
  QVERIFY(!following->isVisible());
  QTest::mouseClick(close, Qt::LeftButton);
  QVERIFY(bench.window.lessons().bar().isHidden());
  bench.window.resize(900, 600);
}

void WindowLessons::theNameOfTheNextLessonFitsANarrowBar() {
  Workbench& bench = shared();
  open(bench, pathOf("organ.chainmail"));
  while (!player(bench).isLast()) {
    next(bench);
  }
  const int least = bench.window.minimumSizeHint().width();
  bench.trigger("lectureMode");
  bench.window.showNormal();
  bench.window.resize(900, 600);
  bench.settle();
  QVERIFY2(bench.window.width() <= 900, qPrintable(QString::number(bench.window.width())));
  bench.trigger("lectureMode");
  bench.window.resize(900, 600);
  bench.settle();
  QCOMPARE(bench.window.minimumSizeHint().width(), least);
}

void WindowLessons::undoAndRedoKeepTheLessonAndMoveTheCaption() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  next(bench);
  const State state = stateOf(bench);
  const int steps = bench.document().undoStack().index();
  for (int i = 0; i < steps; ++i) {
    bench.document().undo();
  }
  QVERIFY(!player(bench).isOpen());
  for (int i = 0; i < steps; ++i) {
    bench.document().redo();
  }
  QTRY_VERIFY(bench.document().solvers().idle());
  QVERIFY(player(bench).isOpen());
  QVERIFY(stateOf(bench) == state);

  const auto caption = [&] { return bench.find<QLabel>("lessonText")->text(); };
  const auto textOf = [&](std::size_t step) { return QString::fromStdString(player(bench).lesson().steps[step].text); };
  const auto undo = [&] {
    bench.trigger("undo");
    bench.settle();
  };
  open(bench, pathOf("order.chainmail"));
  next(bench);
  next(bench);
  undo();  // all steps in a row are one step of undo
  QCOMPARE(bench.document().moves().history().position(), std::size_t{0});
  QCOMPARE(caption(), textOf(0));
  bench.trigger("redo");
  bench.settle();
  QCOMPARE(caption(), textOf(2));
  disturb(bench);
  QCOMPARE(caption(), textOf(2));
  next(bench);
  QCOMPARE(caption(), textOf(3));
  undo();
  QCOMPARE(caption(), textOf(2));  // the drag is still there
  undo();
  QCOMPARE(caption(), textOf(2));
  undo();
  QCOMPARE(caption(), textOf(0));
  next(bench);
  QCOMPARE(caption(), textOf(1));
  QCOMPARE(bench.document().moves().history().position(), player(bench).lesson().steps[1].until);
}

void WindowLessons::theBarKeepsItsHeightAndALongCaptionScrolls() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  const LessonBar& bar = bench.window.lessons().bar();
  const int height = bar.height(), ofView = bench.view(0).height();
  while (!player(bench).isLast()) {
    next(bench);
    bench.settle();
    QCOMPARE(bar.height(), height);
    QCOMPARE(bench.view(0).height(), ofView);
    const auto* text = bench.find<QLabel>("lessonText");
    QVERIFY(text->height() >= text->heightForWidth(text->width()));  // nothing is cut off
  }

  // A long caption scrolls.
  const QTemporaryDir folder;
  const QSize size = bench.window.size();
  for (const QByteArray& text : {QByteArray(3900, 'x'), QByteArray("line\\n").repeated(700)}) {  // of at most 4,096
    open(bench, changed(folder, "order.chainmail", "Both panels show the same sheet.", text));
    QCOMPARE(bench.window.size(), size);  // it leaves the views their room
    QVERIFY(bench.view(0).height() > size.height() / 4);
    const auto* shown = bench.find<QLabel>("lessonText");
    QVERIFY(shown->height() >= shown->heightForWidth(shown->width()));  // the last line can be reached
  }
}

void WindowLessons::theNextObjectHasTheColoursOfBefore() {
  const QTemporaryDir folder;
  Workbench& bench = shared();
  bench.window.colouring().setMode(ColourMode::violation);
  open(bench, pathOf("order.chainmail"));
  open(bench, changed(folder, "order.chainmail", R"("colour": "violation")", R"("colour": "plain")"));
  QCOMPARE(bench.window.colouring().mode(), ColourMode::plain);
  bench.trigger("lessonClose");
  QCOMPARE(bench.window.colouring().mode(), ColourMode::plain);
  shared();
  QCOMPARE(bench.window.colouring().mode(), ColourMode::violation);
}

void WindowLessons::aDragDuringAStepStopsIt() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  bench.trigger("lessonNext");
  QTRY_VERIFY(bench.document().moves().history().position() > 5);
  bench.document().handle().grab(0);
  bench.document().handle().dragBy({1, 0, 0});
  QTRY_VERIFY(!player(bench).plays());
  QVERIFY(!bench.document().handle().held().empty());
  bench.document().handle().release();
  bench.settle();
}

/// Relaxation moves elements without a recorded command.
void WindowLessons::relaxationAndPanelsOfTheUserAreTakenBack() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  next(bench);
  next(bench);
  const State state = stateOf(bench);
  edits::setRelaxation(bench.document(), {true, 1, RelaxationScheme::mean});
  QTRY_VERIFY(stateOf(bench).panels != state.panels);
  edits::setRelaxation(bench.document(), {false, 1, RelaxationScheme::mean});
  bench.document().addPanel();
  next(bench);  // to a step without moves of its own
  QVERIFY(stateOf(bench) == state);
}

void WindowLessons::theWaitingListIsShownStepByStepAndItsFiguresAreOfTheWholePass() {
  Workbench& bench = shared();
  open(bench, pathOf("waiting-list.chainmail"));
  const auto sentence = [&] {
    bench.settleFigures();
    const auto* line = bench.find<ViolationLine>("violation0");
    // The solver measures the whole mesh in idle time.
    (void)QTest::qWaitFor([&] { return line->sentence().contains(QStringLiteral(" of links violated")); });
    return line->sentence();
  };
  QString early;
  std::vector<std::vector<std::size_t>> moved;
  Snapshot whole;
  for (int step = 0; step < 3; ++step) {
    next(bench);
    early = step == 0 ? sentence() : early;
    moved.push_back({shownAwayFromRest(bench, 0), shownAwayFromRest(bench, 1)});
    whole = bench.document().solvers().snapshots()[0].get();
  }
  // Only the handle; it and the first candidate; all six candidates moved.
  QCOMPARE(moved, (std::vector<std::vector<std::size_t>>{{1, 1}, {2, 2}, {7, 7}}));
  next(bench);
  QVERIFY(player(bench).isLast());
  const QString late = sentence();
  QVERIFY2(late.startsWith(QStringLiteral("%1 % of links violated").arg(std::lround(100 * violated(bench, 0)))),
           qPrintable(late));
  QCOMPARE(QString(early).replace(QStringLiteral(" violated after the pass,"), QStringLiteral(" violated,")), late);
  QVERIFY2(early != late, qPrintable(early));
  QVERIFY(shownAwayFromRest(bench, 0) > 7);
  QVERIFY(bench.document().solvers().snapshots()[0].get() == whole);  // the solvers have finished the pass in all steps
  back(bench);
  QCOMPARE(shownAwayFromRest(bench, 0), std::size_t{7});
}

void WindowLessons::theLessonsShowTheirPoint() {
  Workbench& bench = shared();
  const auto toEnd = [&](const char* file) {
    open(bench, pathOf(file));
    while (!player(bench).isLast()) {
      next(bench);
    }
  };
  toEnd("order.chainmail");
  QVERIFY(violated(bench, 0) > 0.1);
  QCOMPARE(violated(bench, 1), 0.0);
  back(bench);
  back(bench);
  QVERIFY(violated(bench, 0) > 0 && violated(bench, 0) < 0.03);  // a few links
  QCOMPARE(violated(bench, 1), 0.0);
  toEnd("exact.chainmail");
  QVERIFY(violated(bench, 0) > 0);
  QCOMPARE(violated(bench, 1), 0.0);
  back(bench);
  back(bench);
  QCOMPARE(violated(bench, 0), 0.0);  // within reach
  toEnd("organ.chainmail");
  QVERIFY(bench.document().mesh()->tetrahedra.size() > 9891);  // some are divided
  QCOMPARE(bench.document().cuts().count(), 0U);
  back(bench);
  QVERIFY(violated(bench, 0) > 0.05);
  QCOMPARE(violated(bench, 1), 0.0);
}

/// Opening a lesson is one step of undo, which returns to the object with all its steps.
void WindowLessons::aLessonReplacesNoWork() {
  Workbench& bench = shared();
  disturb(bench);
  const State work = stateOf(bench);
  open(bench, pathOf("exact.chainmail"));
  for (int round = 0; round < 16; ++round) {
    player(bench).isLast() ? back(bench) : next(bench);
  }
  while (bench.document().lesson().session) {
    QVERIFY(bench.document().undoStack().canUndo());
    bench.document().undo();
  }
  bench.settle();
  QVERIFY(stateOf(bench) == work);
  QVERIFY(bench.window.lessons().bar().isHidden());
  QVERIFY(bench.document().undoStack().canUndo());
}

void WindowLessons::aLessonAloneIsNoUnsavedWork() {
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  next(bench);
  next(bench);
  back(bench);
  QVERIFY(!bench.document().isModified());
  QVERIFY(!bench.window.isWindowModified());
  disturb(bench);
  QVERIFY(bench.document().isModified());
  QVERIFY(bench.window.isWindowModified());
}

void WindowLessons::unsavedWorkIsOfferedAgain() {
  {
    Workbench bench;
    bench.window.sessions().protect();
    disturb(bench);
    open(bench, pathOf("exact.chainmail"));
    QVERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Your unsaved work is kept")));
    bench.window.close();
  }
  Workbench again;
  again.window.sessions().protect();
  QVERIFY(again.window.sessions().recoveryBar().isVisible());
  QTest::mouseClick(again.find<QPushButton>("restoreWork"), Qt::LeftButton);
  again.settle();
  QCOMPARE(again.document().name(), QStringLiteral("sample"));
  QVERIFY(!again.document().moves().history().commands().empty());
}

void WindowLessons::savingKeepsTheCaptions() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("saved.chainmail"));
  Workbench& bench = shared();
  open(bench, pathOf("order.chainmail"));
  QVERIFY(bench.document().files().session().isEmpty());  // the bundled file is not overwritten
  next(bench);
  const State state = stateOf(bench);
  bench.window.sessions().savePath(path);
  bench.settle();
  const Session saved = read_session(path.toStdString());
  QVERIFY(saved.lesson == player(bench).lesson());
  disturb(bench);
  const State own = stateOf(bench);
  bench.window.sessions().savePath(path);
  bench.settle();
  QCOMPARE(read_session(path.toStdString()).moves.size(), saved.moves.size());
  open(bench, path);
  QVERIFY(stateOf(bench).panels == own.panels);  // as it was saved
  QCOMPARE(player(bench).step(), std::size_t{1});
  back(bench);
  next(bench);
  QVERIFY(stateOf(bench) == state);
}

void WindowLessons::aCutByTheUserStaysOutOfTheLesson() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("cut.chainmail"));
  Workbench& bench = shared();
  // A sheet of triangles, which a stroke splits.
  open(bench, changed(folder, "order.chainmail", R"({"file": "grid.dat"})", R"({"file": "face.png", "across": 32})"));
  const MeshPointer whole = bench.document().mesh();
  bench.trigger("toolCut");
  bench.find<QAction>("cutSplits")->setChecked(true);
  const QRect view = bench.view(0).rect();
  bench.stroke(0, {view.center() - QPoint(40, 60), view.center() + QPoint(40, 60)});
  bench.trigger("toolDrag");
  const MeshPointer split = bench.document().mesh();
  QVERIFY(split->element_count() > whole->element_count());
  bench.window.sessions().savePath(path);
  bench.settle();
  const Session saved = read_session(path.toStdString());
  QCOMPARE(saved.mesh->element_count(), split->element_count());
  QVERIFY(saved.lesson.steps.empty());
  QCOMPARE(first_mesh(saved)->element_count(), whole->element_count());
  next(bench);
  QCOMPARE(player(bench).step(), std::size_t{1});
  QCOMPARE(bench.document().mesh(), whole);
}

void WindowLessons::aDamagedLessonChangesNothingAndUnknownNamesAreReported() {
  const QTemporaryDir folder;
  Workbench& bench = shared();
  disturb(bench);
  const State work = stateOf(bench);
  bench.open(changed(folder, "order.chainmail", "\"until\": 0", "\"until\": 9999"));
  const QString message = bench.window.messages().sentence();
  QVERIFY2(message.contains(QStringLiteral("mine.chainmail: lesson: step 1: 'until' is 9999, but the session has ")),
           qPrintable(message));
  QVERIFY(!player(bench).isOpen());
  QVERIFY(stateOf(bench) == work);
  bench.open(changed(folder, "order.chainmail", "grid.dat", "nowhere.dat"));
  QVERIFY2(bench.window.messages().sentence().contains(QStringLiteral("its mesh 'nowhere.dat' was not found; put ")),
           qPrintable(bench.window.messages().sentence()));
  QVERIFY(stateOf(bench) == work);

  open(bench, changed(folder, "order.chainmail", "\"colour\": \"violation\"", "\"colour\": \"violaton\""));
  QCOMPARE(bench.window.messages().sentence().section(QLatin1Char(':'), 0, 2),
           QStringLiteral("Why order matters: step 1: 'colour' is 'violaton', which is not known; use one of"));
  next(bench);
  QCOMPARE(player(bench).step(), std::size_t{1});
}

void WindowLessons::closingHidesTheBar() {
  Workbench& bench = shared();
  open(bench, pathOf("waiting-list.chainmail"));
  QVERIFY(bench.find<QDockWidget>("propagationDock")->isVisible());
  next(bench);
  const State state = stateOf(bench);
  bench.trigger("lessonClose");
  QVERIFY(bench.window.lessons().bar().isHidden());
  QVERIFY(!bench.find<QDockWidget>("propagationDock")->isVisible());
  QVERIFY(stateOf(bench) == state);
}

CHAINMAIL_WINDOW_TEST(WindowLessons)

}  // namespace chainmail::window_lessons

#include "window_lessons.moc"
