// Tests comparisons of panels in a real window: linked marks, differences and ghosts.

#include <QLabel>
#include <QSlider>

#include "document/edits.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"
#include "measure/violation.h"
#include "panels/legend.h"
#include "panels/panel_head.h"
#include "window.h"

namespace chainmail::window_compare {

namespace {

constexpr int alike = 45;  // of 255: a line of one pixel is blended with the background

void hover(Workbench& bench, int panel, ElementId element) {
  View& view = bench.view(panel);
  const QPointF at = bench.place(panel, element);
  QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &move);
  QTRY_VERIFY(bench.document().highlight().marks().element == element);
  bench.settle();
}

/// Returns the distance of the colour at an element from the colour of the mark under the cursor.
int fromMark(Workbench& bench, int panel, ElementId element) {
  return bench.distanceFromColour(panel, bench.view(panel).viewPosition(element), colours::marked);
}

QPointF middleOf(Workbench& bench, int panel, LinkId link) {
  const auto& ends = bench.document().mesh()->links[link];
  return (bench.view(panel).viewPosition(ends[0]) + bench.view(panel).viewPosition(ends[1])) / 2;
}

/// Returns the smallest distance from a colour along a link, because other links may cover parts of it.
int alongFromColour(Workbench& bench, int panel, LinkId link, QColor colour) {
  const auto& ends = bench.document().mesh()->links[link];
  const QPointF from = bench.view(panel).viewPosition(ends[0]), way = bench.view(panel).viewPosition(ends[1]) - from;
  int nearest = 255;
  for (const double share : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}) {
    nearest = std::min(nearest, bench.distanceFromColour(panel, from + share * way, colour));
  }
  return nearest;
}

double violationOf(Workbench& bench, int panel, LinkId link) {
  return link_violation(*bench.document().mesh(), {}, bench.document().solvers().frame(panel)->view(), link);
}

}  // namespace

class WindowCompare : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void whatTheCursorIsAtIsMirroredUntilTheSwitchIsOff() {
    Workbench bench;
    hover(bench, 0, 31);
    QVERIFY(fromMark(bench, 0, 31) < alike);
    QVERIFY(fromMark(bench, 1, 31) < alike);
    bench.trigger("linkMarks");
    bench.settle();
    QVERIFY(fromMark(bench, 0, 31) < alike);
    QVERIFY(fromMark(bench, 1, 31) > alike);
    hover(bench, 1, 12);
    QVERIFY(fromMark(bench, 1, 12) < alike);
    QVERIFY(fromMark(bench, 0, 12) > alike);
    bench.trigger("linkMarks");
    bench.settle();
    QVERIFY(fromMark(bench, 0, 12) < alike);
  }

  void violationsAreSubtracted() {
    Workbench bench;
    edits::setPinned(bench.document(), {40}, true);
    bench.trigger("colourBy-violationDifference");
    QTRY_VERIFY(bench.window.panel(0).legend().title().contains(QStringLiteral("A minus B")));
    bench.dragFar();
    double furthest = 0;
    LinkId worst = 0;
    for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
      const double one = violationOf(bench, 0, link) - violationOf(bench, 1, link);
      worst = std::abs(one) > std::abs(furthest) ? link : worst;
      furthest = std::abs(one) > std::abs(furthest) ? one : furthest;
    }
    QVERIFY(std::abs(furthest) > 0.5);
    for (int p = 0; p < 2; ++p) {
      const Legend& legend = bench.window.panel(p).legend();
      QTRY_COMPARE(legend.highest(), QLocale().toString(std::abs(furthest), 'g', 3));
      QCOMPARE(legend.lowest(), QLocale().toString(-std::abs(furthest), 'g', 3));
      const double own = p == 0 ? furthest : -furthest;
      const auto& map = colour_map::differenceStops();
      const QColor colour = colour_map::at(own > 0 ? 1 : 0, map), opposite = colour_map::at(own > 0 ? 0 : 1, map);
      QVERIFY(alongFromColour(bench, p, worst, colour) < alike);
      QVERIFY(alongFromColour(bench, p, worst, colour) < alongFromColour(bench, p, worst, opposite));
    }
  }

  void aGhostIsLaidOverAndBlendedIn() {
    Workbench bench;
    edits::setPinned(bench.document(), {40}, true);
    bench.dragFar();
    const QImage own = bench.view(0).grabFramebuffer();
    LinkId apart = 0;  // the link at which the panels differ most
    for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
      const auto between = [&](LinkId one) {
        const QPointF d = middleOf(bench, 0, one) - middleOf(bench, 1, one);
        return std::hypot(d.x(), d.y());
      };
      apart = between(link) > between(apart) ? link : apart;
    }
    const QPointF theirs = middleOf(bench, 1, apart);  // the cameras are linked, so it is the same position in panel A
    QVERIFY(bench.distanceFromColour(0, theirs, panelColour(bench.document(), 1)) > 2 * alike);
    bench.chooseGhost(0, QStringLiteral("Panel B"));
    QTRY_VERIFY(bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("50 % ghost of B")));
    QVERIFY(bench.view(0).grabFramebuffer() != own);
    const int faint = bench.distanceFromColour(0, theirs, panelColour(bench.document(), 1));
    auto* slider = bench.window.panel(0).findChild<QSlider*>(QStringLiteral("ghostBlend0"));
    slider->setValue(slider->maximum());
    bench.settle();
    // Only the ghost is visible, as its own panel draws it; only the marks are those of this panel.
    const int shown = bench.distanceFromColour(0, theirs, panelColour(bench.document(), 1));
    QVERIFY(shown < faint);
    // A slanted line is smoothed and has a weaker colour, in both views.
    QVERIFY(shown < bench.distanceFromColour(1, theirs, panelColour(bench.document(), 1)) + alike);
    slider->setValue(0);
    bench.settle();
    QCOMPARE(bench.view(0).grabFramebuffer(), own);
    bench.chooseGhost(0, QStringLiteral("No ghost"));
    QCOMPARE(bench.view(0).grabFramebuffer(), own);
    QVERIFY(!bench.find<QAction>("ghosts")->isChecked());
  }
};

CHAINMAIL_WINDOW_TEST(WindowCompare)

}  // namespace chainmail::window_compare

#include "window_compare.moc"
