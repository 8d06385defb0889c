#pragma once

#include <QApplication>
#include <QCursor>
#include <QMenu>
#include <QPointer>
#include <QScreen>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QWindow>
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "common/application.h"
#include "common/theme.h"
#include "mesh/generate.h"
#include "panels/panel.h"
#include "program.h"
#include "window/main_window.h"
#include "window/startup.h"

namespace chainmail {

/// A real workbench for a test.
struct Workbench {
  explicit Workbench(const MeshPointer& mesh = generate({MeshKind::grid, {9, 7, 1}, 1, {}}))
      : window(mesh, QStringLiteral("sample")) {
    window.colouring().setMode(ColourMode::plain);  // most tests look for the colours of panels
    QCursor::setPos(QGuiApplication::primaryScreen()->geometry().topLeft());  // else a view below it shows the hover
    window.show();
    window.activateWindow();  // shortcuts go to the active window
    shown = QTest::qWaitForWindowExposed(&window) && QTest::qWaitForWindowActive(&window);
    settle();
  }

  Document& document() { return window.document(); }
  View& view(int panel) { return window.panel(panel).view(); }

  /// Waits until background jobs are done, all solvers have executed all commands, and their frames are drawn.
  void settle() {
    QCoreApplication::processEvents();  // pending requests may start a job
    QTRY_VERIFY_WITH_TIMEOUT(!window.jobs().running(), longestWait);
    QTRY_VERIFY_WITH_TIMEOUT(document().solvers().idle(), longestWait);
    QTRY_VERIFY_WITH_TIMEOUT(showsTheObject(), longestWait);
    awaitFrames();
    do {
      QTRY_VERIFY(!hasten(shortly));
      awaitPaint();
    } while (!timersOfUpdates(shortly).isEmpty());
  }

  /// Like settle(), but also waits for figures, legends and colours, which are updated less often.
  void settleFigures() {
    do {
      settle();
      QTRY_VERIFY(!hasten(readably));
      awaitPaint();
    } while (!timersOfUpdates(readably).isEmpty());
  }

  /// True if every panel has a frame of the object.
  bool showsTheObject() {
    int frames = 0;
    for (int panel = 0; panel < document().panels(); ++panel) {
      frames += document().solvers().frame(panel) != nullptr ? 1 : 0;
    }
    return frames == document().panels();
  }

  /// Waits until the panels show the results of their solvers. While relaxation runs, waits for a later state.
  void awaitFrames() {
    std::vector<int> frames(Document::maxPanels, 0);
    QObject context;
    QObject::connect(&document().solvers(), &PanelSolvers::frameReady, &context,
                     [&](int panel) { ++frames[std::size_t(panel)]; });
    const auto seen = [&] {
      // The first frame may have been under way before.
      return document().solvers().settled() ||
             std::all_of(frames.begin(), frames.begin() + document().panels(), [](int count) { return count >= 2; });
    };
    QTRY_VERIFY(seen());
  }

  /// Draws the visible views again. Afterwards, all earlier requests to draw are done.
  void awaitPaint() {
    QPointer<View> seen;
    for (int panel = 0; panel < document().panels(); ++panel) {
      if (!view(panel).visibleRegion().isEmpty()) {
        seen = &view(panel);
        seen->update();
      }
    }
    if (seen.isNull() || !window.windowHandle()->isExposed()) {
      QCoreApplication::processEvents();
      return;
    }
    const QSignalSpy swapped(seen.data(), &QOpenGLWidget::frameSwapped);
    QTRY_VERIFY(!swapped.isEmpty() || seen.isNull() || seen->visibleRegion().isEmpty());
  }

  /// Returns the timers that will update a widget within this time.
  QList<QPointer<QTimer>> timersOfUpdates(int milliseconds) {
    QList<QPointer<QTimer>> found;
    for (QTimer* timer : window.findChildren<QTimer*>()) {
      const bool ofColours = milliseconds >= readably && timer->parent() == &window.colouring();
      if (timer->isActive() && (ofColours || (timer->isSingleShot() && timer->interval() <= milliseconds))) {
        found << timer;
      }
    }
    return found;
  }

  /// Lets these timers fire at once. Returns whether there were any.
  bool hasten(int milliseconds) {
    const auto timers = timersOfUpdates(milliseconds);
    for (const QPointer<QTimer>& timer : timers) {
      if (timer.isNull()) {
        continue;  // another one has closed its widget
      }
      if (timer->isSingleShot()) {
        timer->stop();
      }
      QMetaObject::invokeMethod(timer, "timeout", Qt::DirectConnection);
    }
    return !timers.isEmpty();
  }

  Point position(int panel, ElementId element) { return view(panel).position(element); }
  QPoint place(int panel, ElementId element) { return view(panel).viewPosition(element).toPoint(); }

  /// Moves the mouse with the left button pressed, in small steps like a user; `release` ends the stroke.
  void stroke(int panel, const QList<QPoint>& places, bool release = true, Qt::KeyboardModifiers modifiers = {}) {
    View& at = view(panel);
    QTest::mousePress(&at, Qt::LeftButton, modifiers, places.first());
    for (qsizetype i = 1; i < places.size(); ++i) {
      for (int step = 1; step <= 5; ++step) {
        QMouseEvent move(QEvent::MouseMove, QPointF(places[i - 1] + (places[i] - places[i - 1]) * step / 5),
                         at.mapToGlobal(QPointF(places[i - 1] + (places[i] - places[i - 1]) * step / 5)), Qt::NoButton,
                         Qt::LeftButton, modifiers);
        QApplication::sendEvent(&at, &move);
        // A user is usually slower than the solvers.
        (void)QTest::qWaitFor([this] { return document().solvers().idle(); }, patience);
      }
    }
    if (release) {
      QTest::mouseRelease(&at, Qt::LeftButton, {}, places.last());
      settle();
    }
  }

  /// Drags so far that every element of the grid moves.
  void dragFar() {
    const QPoint from = place(0, 31);
    stroke(0, {from, from + QPoint(170, -170), from + QPoint(-60, -100)});
    document().highlight().set({});  // the mark would hide the colours below it
  }

  /// Opens the menu of a panel's ghost button, as a click does, and chooses the item whose text starts with `begin`.
  void chooseGhost(int panel, const QString& begin) {
    auto* menu = window.panel(panel).findChild<QMenu*>();
    emit menu->aboutToShow();
    for (QAction* action : menu->actions()) {
      if (action->text().remove(QLatin1Char('&')).startsWith(begin)) {
        action->trigger();
      }
    }
    settle();
  }

  void open(const QString& path) {
    window.openFile(path);
    settle();
  }

  void click(int panel, ElementId element) {
    QTest::mouseClick(&view(panel), Qt::LeftButton, {}, place(panel, element));
    settle();
  }

  /// Chooses an algorithm by its label in the panel's selector, as a user does.
  void choose(int panel, const char* label) {
    auto& selector = window.panel(panel).selector();
    selector.setCurrentIndex(selector.findText(QLatin1String(label)));
    emit selector.activated(selector.currentIndex());
    settle();
  }

  /// Returns the distance from a colour to the nearest colour within a few pixels of a place: the largest difference of
  /// a channel; 0 is the same colour.
  int distanceFromColour(int panel, QPointF at, QColor colour) {
    const QImage picture = view(panel).grabFramebuffer();
    const QPoint centre = (at * view(panel).devicePixelRatioF()).toPoint();
    int nearest = 255;
    for (int dx = -2; dx <= 2; ++dx) {
      for (int dy = -2; dy <= 2; ++dy) {
        const QColor there = picture.pixelColor(centre + QPoint(dx, dy));
        nearest =
            std::min(nearest, std::max({std::abs(there.red() - colour.red()), std::abs(there.green() - colour.green()),
                                        std::abs(there.blue() - colour.blue())}));
      }
    }
    return nearest;
  }

  void trigger(const char* action) { window.findChild<QAction*>(QLatin1String(action))->trigger(); }
  template <class Widget>
  Widget* find(const char* name) {
    return window.findChild<Widget*>(QLatin1String(name));
  }

  static constexpr int shortly = 50, readably = 100;  // milliseconds from a change to its display
  static constexpr int longestWait = 60'000;          // milliseconds: the sanitizers are slow, and so is a busy machine
  static constexpr int patience = 200;  // milliseconds that a stroke waits for the solvers after each step

  MainWindow window;
  bool shown = false;
};

/// Runs a test class in an application that is set up like the workbench. An unexpected warning fails the test.
template <class Test, class... Arguments>
int runWindowTest(int argc, char** argv, const Arguments&... arguments) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  qputenv("XDG_DATA_HOME", settings.path().toUtf8());  // so that the user's files are not used
  Application application(argc, argv);
  styleApplication();
  if (const QString why = whyNoWindow(); !why.isEmpty()) {
    qCritical("%s", qPrintable(why));
    return 1;
  }
  Test test(arguments...);
  return QTest::qExec(&test, argc, argv);
}

/// Makes every Qt warning a failure until the test function ends. Call it in init().
inline void failOnWarnings() { QTest::failOnWarning(QRegularExpression(QStringLiteral(".*"))); }

}  // namespace chainmail

/// Makes a test class known that needs a window.
#define CHAINMAIL_WINDOW_TEST(Test) CHAINMAIL_TEST_RUN(Test, chainmail::runWindowTest<Test>)
