// Tests sizes, docking, cameras and stored layouts in a real window.

#include <QDockWidget>
#include <QLabel>
#include <QSignalSpy>
#include <QSplitter>
#include <QToolBar>
#include <QToolButton>
#include <QWheelEvent>

#include "window.h"

namespace chainmail::window_layout {

namespace {

/// Another window, which counts how often it is painted.
struct OtherWindow : QWidget {
  OtherWindow() {
    show();
    (void)QTest::qWaitForWindowExposed(this);
  }
  /// Paints it this number of times, one after another.
  void paint(int times) {
    for (const int before = painted; painted < before + times;) {
      const int seen = painted;
      update();
      QTRY_VERIFY(painted > seen);
    }
  }
  void paintEvent(QPaintEvent* /*event*/) override { ++painted; }

  int painted = 0;
};

/// True if a timer of the window will fire within a second.
bool isTimed(Workbench& bench) {
  const auto timers = bench.window.findChildren<QTimer*>();
  return std::ranges::any_of(timers, [](const QTimer* one) { return one->isActive() && one->interval() < 1000; });
}

}  // namespace

class WindowLayout : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void resizing() {
    Workbench bench;
    for (const QSize size : {QSize(1000, 640), QSize(1500, 860), QSize(1200, 800)}) {
      bench.window.resize(size);
      bench.settle();
      for (int p = 0; p < 2; ++p) {
        QCOMPARE(bench.view(p).grabFramebuffer().size(), bench.view(p).size() * bench.view(p).devicePixelRatioF());
      }
      bench.trigger("fitView");
      const QRect all = bench.view(0).rect();
      QVERIFY(all.contains(bench.place(0, 0)) && all.contains(bench.place(0, 62)));
    }
  }

  void whatNobodyMovedStaysFittedAndWhatSomebodyMovedStays() {
    Workbench bench;
    const auto shownWhole = [&bench](int panel) {
      const QRect all = bench.view(panel).rect();
      return all.contains(bench.place(panel, 0)) && all.contains(bench.place(panel, 62));
    };
    const auto share = [&bench] {
      return double(bench.place(0, 62).x() - bench.place(0, 0).x()) / bench.view(0).width();
    };
    const double before = share();
    bench.window.resize(1000, 860);  // narrow views: with an unchanged camera, the object would not fit
    bench.settle();
    QVERIFY(shownWhole(0) && shownWhole(1));
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.settle();
    for (int panel = 0; panel < 4; ++panel) {
      QVERIFY(shownWhole(panel));
    }
    QVERIFY(share() > before / 2);  // and it uses the available space
    bench.view(0).zoom(4);
    const double height = bench.view(0).camera()->pose().height;
    bench.window.resize(1500, 860);
    bench.settle();
    QCOMPARE(bench.view(0).camera()->pose().height, height);
    bench.trigger("fitView");
    bench.window.resize(1100, 860);
    bench.settle();
    QVERIFY(shownWhole(0));
  }

  void everyDockFitsOnASmallScreenAndComesToTheFront() {
    Workbench bench;
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.window.resize(1366, 768);
    for (const char* show : {"showReport", "showPropagation", "showElement", "showPropagation"}) {
      bench.trigger(show);  // the last one when it is behind another tab
      bench.settle();
      QCOMPARE(bench.window.size(), QSize(1366, 768));
    }
    auto* propagation = bench.find<QDockWidget>("propagationDock");
    QVERIFY(propagation->isVisible() && !propagation->visibleRegion().isEmpty());
    bench.trigger("showPropagation");
    QVERIFY(propagation->isHidden());
  }

  void fourPanelsFitOnASmallScreen() {
    Workbench bench;
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.settle();
    bench.window.resize(1024, 768);
    bench.settle();
    QVERIFY2(bench.window.width() <= 1024 && bench.window.height() <= 768,
             qPrintable(QStringLiteral("%1 x %2").arg(bench.window.width()).arg(bench.window.height())));
    bench.find<QToolBar>("mainToolBar")->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);  // wider than the window
    bench.settle();
    auto* more = bench.window.findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
    QVERIFY(more->isVisible());
    QCOMPARE(more->icon().name(), QStringLiteral("more"));
    QVERIFY(more->width() >= 20);
  }

  void thePropagationFitsOnASmallScreen() {
    Workbench bench;
    bench.trigger("showPropagation");
    bench.settle();
    for (const int width : {1180, 1060, 1024}) {  // as a mouse would: below 1200, the lists make room
      bench.window.resize(width, 768);
      bench.settle();
    }
    QVERIFY(bench.find<QDockWidget>("propagationDock")->isVisible());
    QVERIFY2(bench.window.width() <= 1024 && bench.window.height() <= 768,
             qPrintable(QStringLiteral("%1 x %2").arg(bench.window.width()).arg(bench.window.height())));
  }

  void docksFloatAndComeBack() {
    Workbench bench;
    for (auto* dock : bench.window.findChildren<QDockWidget*>()) {
      dock->setFloating(true);
      QVERIFY(dock->isHidden() || QTest::qWaitForWindowExposed(dock));
      dock->setFloating(false);
      dock->hide();
      dock->show();
    }
    bench.settle();
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(40, 40)});
    QVERIFY(bench.document().solvers().frame(1)->statistics.passes > 0);
  }

  void aViewSurvivesAnotherParent() {
    Workbench bench;
    QWidget* panel = &bench.window.panel(0);
    QWidget* home = panel->parentWidget();
    const QImage before = bench.view(0).grabFramebuffer();
    panel->setParent(nullptr);
    panel->show();
    QVERIFY(QTest::qWaitForWindowExposed(panel));
    panel->setParent(home);
    panel->show();
    auto* row = qobject_cast<QSplitter*>(home);
    row->insertWidget(0, panel);
    row->setSizes({1000, 1000});
    bench.settle();
    bench.trigger("fitView");
    bench.settle();
    QVERIFY(differing(bench.view(0).grabFramebuffer(), QColor(bench.view(0).grabFramebuffer().pixelColor(3, 3))) >
            differing(before, before.pixelColor(3, 3)) / 2);
  }

  void theMiddleButtonPansAndCamerasAreLinkedUntilTheSwitchIsOff() {
    Workbench bench;
    {
      const QPoint before = bench.place(0, 0);
      View& view = bench.view(0);
      QTest::mousePress(&view, Qt::MiddleButton, {}, QPoint(100, 100));
      QMouseEvent move(QEvent::MouseMove, QPointF(130, 90), view.mapToGlobal(QPointF(130, 90)), Qt::NoButton,
                       Qt::MiddleButton, Qt::NoModifier);
      QApplication::sendEvent(&view, &move);
      QTest::mouseRelease(&view, Qt::MiddleButton, {}, QPoint(130, 90));
      QVERIFY(((bench.place(0, 0) - before) - QPoint(30, -10)).manhattanLength() <= 2);  // rounding of mouse positions
    }
    const auto wheel = [&bench](int panel) {
      const QPointF at(bench.view(panel).rect().center());
      QWheelEvent event(at, bench.view(panel).mapToGlobal(at), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&bench.view(panel), &event);
    };
    const QPoint before = bench.place(1, 0);
    wheel(0);
    QVERIFY(bench.place(1, 0) != before);
    bench.trigger("linkCameras");
    const QPoint apart = bench.place(1, 0);
    wheel(0);
    QCOMPARE(bench.place(1, 0), apart);
    bench.trigger("linkCameras");
    const auto across = [&bench](int panel) {
      return bench.view(panel).viewPosition(ElementId(62)) - bench.view(panel).viewPosition(ElementId(0));
    };
    QVERIFY((across(1) - across(0)).manhattanLength() < 0.01);  // positions are in single precision
  }

  void theLayoutIsRemembered() {
    {
      Workbench bench;
      bench.find<QDockWidget>("relaxationDock")->hide();
      bench.window.close();
    }
    Workbench again;
    QVERIFY(!again.find<QDockWidget>("relaxationDock")->isVisible());
    QVERIFY(again.find<QDockWidget>("stiffnessDock")->isVisible());
  }

  void nothingIsPaintedWhileNothingChanges() {
    Workbench bench;
    bench.document().handle().grab(10);
    bench.document().handle().drag(bench.position(0, 10) + Point(0.5, 0, 0));
    bench.document().handle().release();
    bench.settle();
    for (const char* rate : {"painted0", "painted1"}) {  // they count the frames of the last second
      QTRY_COMPARE(bench.find<QLabel>(rate)->text(), QStringLiteral("idle"));
    }
    // The last frames have the violation of the whole object.
    for (int panel = 0; panel < 2; ++panel) {
      QTRY_VERIFY(bench.document().solvers().frame(panel)->statistics.violation.is_whole);
    }
    bench.settleFigures();
    QTRY_VERIFY(!isTimed(bench));  // no timer is left that could start painting
    OtherWindow other;
    const QSignalSpy left(&bench.view(0), &QOpenGLWidget::aboutToCompose);
    const QSignalSpy right(&bench.view(1), &QOpenGLWidget::aboutToCompose);
    other.paint(5);  // all earlier requests to paint are done by then
    QCOMPARE(left.count() + right.count(), 0);
    QVERIFY(!isTimed(bench));
  }

  void aLargeGridIsDrawnCoarselyAndSaysSo() {
    Workbench bench(generate({MeshKind::grid, {512, 512, 1}, 1, {}}));
    QTRY_VERIFY(bench.view(0).drawnStep() > 1);
    const QPoint from = bench.place(0, 131'328);
    bench.stroke(0, {from, from + QPoint(60, 30)});
    QVERIFY(bench.document().solvers().frame(1)->statistics.last_pass.moved > 0);
  }

 private:
  static int differing(const QImage& picture, QColor colour) {
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        count += picture.pixelColor(x, y) != colour ? 1 : 0;
      }
    }
    return count;
  }
};

CHAINMAIL_WINDOW_TEST(WindowLayout)

}  // namespace chainmail::window_layout

#include "window_layout.moc"
