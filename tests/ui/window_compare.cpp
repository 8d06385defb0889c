// What sets the panels against each other, in a real window: links, ghosts, places, and who is compared with whom.

#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QToolButton>
#include <QWheelEvent>

#include "colour_map.h"
#include "colours.h"
#include "ghost_button.h"
#include "legend.h"
#include "measure/violation.h"
#include "window.h"

using namespace chainmail;

namespace {

constexpr int alike = 45;  // of 255: a line one pixel wide is blended with what lies behind it

void dragFar(Workbench& bench) {
  const QPoint from = bench.place(0, 31);
  bench.stroke(0, {from, from + QPoint(170, -170), from + QPoint(-60, -100)});
  bench.document().setHighlight({});  // whose mark hides what is below
}

void hover(Workbench& bench, int panel, ElementId element) {
  View& view = bench.view(panel);
  const QPointF at = bench.place(panel, element);
  QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &move);
  QTRY_VERIFY(bench.document().highlight().element == element);
  QTest::qWait(60);
}

/// How far the picture at an element is from the colour of the mark under the cursor.
int fromMark(Workbench& bench, int panel, ElementId element) {
  return bench.distanceFromColour(panel, bench.view(panel).placeOf(element), colours::marked);
}

QPointF middleOf(Workbench& bench, int panel, LinkId link) {
  const auto& ends = bench.document().mesh()->links[link];
  return (bench.view(panel).placeOf(ends[0]) + bench.view(panel).placeOf(ends[1])) / 2;
}

/// Of the places along a link the one nearest to the colour: others may be covered by other links.
int alongFromColour(Workbench& bench, int panel, LinkId link, QColor colour) {
  const auto& ends = bench.document().mesh()->links[link];
  const QPointF from = bench.view(panel).placeOf(ends[0]), way = bench.view(panel).placeOf(ends[1]) - from;
  int nearest = 255;
  for (const double share : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}) {
    nearest = std::min(nearest, bench.distanceFromColour(panel, from + share * way, colour));
  }
  return nearest;
}

double violationOf(Workbench& bench, int panel, LinkId link) {
  return link_violation(*bench.document().mesh(), {}, bench.document().frame(panel)->view(), link);
}

/// Opens the menu of a panel's ghost button, as a click does, and chooses by the text.
void chooseGhost(Workbench& bench, int panel, const QString& begin) {
  auto* menu = bench.window.panel(panel).findChild<QMenu*>();
  emit menu->aboutToShow();
  for (QAction* action : menu->actions()) {
    if (action->text().remove(QLatin1Char('&')).startsWith(begin)) {
      action->trigger();
    }
  }
  bench.settle();
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
    QTest::qWait(60);
    QVERIFY(fromMark(bench, 0, 31) < alike);
    QVERIFY(fromMark(bench, 1, 31) > alike);
    hover(bench, 1, 12);
    QVERIFY(fromMark(bench, 1, 12) < alike);
    QVERIFY(fromMark(bench, 0, 12) > alike);
    bench.trigger("linkMarks");
    QTest::qWait(60);
    QVERIFY(fromMark(bench, 0, 12) < alike);
  }

  void eachPanelMayHaveItsOwnRange() {
    Workbench bench;
    bench.choose(1, "Exact ChainMail");  // it violates nothing
    bench.document().setPinned({40}, true);
    dragFar(bench);
    bench.trigger("colourBy-violation");
    double largest = 0;
    for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
      largest = std::max(largest, violationOf(bench, 0, link));
    }
    QVERIFY(largest > 0.5);
    const auto highest = [&](int p) { return bench.window.panel(p).legend().highest(); };
    const auto shown = [](double value) { return QLocale().toString(value, 'g', 3); };
    QTRY_COMPARE(highest(1), shown(largest));
    bench.trigger("linkColours");
    QTRY_COMPARE(highest(1), shown(1e-4));
    QCOMPARE(highest(0), shown(largest));
    bench.trigger("linkColours");
    QTRY_COMPARE(highest(1), shown(largest));
  }

  void violationsAreSubtracted() {
    Workbench bench;
    bench.document().setPinned({40}, true);
    bench.trigger("colourBy-violationDifference");
    QTRY_VERIFY(bench.window.panel(0).legend().title().contains(QStringLiteral("A less that of B")));
    dragFar(bench);
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
    bench.document().setPinned({40}, true);
    dragFar(bench);
    const QImage own = bench.view(0).grabFramebuffer();
    LinkId apart = 0;  // where the panels differ most
    for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
      const auto between = [&](LinkId one) {
        const QPointF d = middleOf(bench, 0, one) - middleOf(bench, 1, one);
        return std::hypot(d.x(), d.y());
      };
      apart = between(link) > between(apart) ? link : apart;
    }
    const QPointF theirs = middleOf(bench, 1, apart);  // the cameras are linked: it is there in panel A too
    QVERIFY(bench.distanceFromColour(0, theirs, colours::right) > 2 * alike);
    chooseGhost(bench, 0, QStringLiteral("Panel B"));
    QTRY_VERIFY(bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("ghost of B, 50 %")));
    QVERIFY(bench.view(0).grabFramebuffer() != own);
    const int faint = bench.distanceFromColour(0, theirs, colours::right);
    auto* slider = bench.window.panel(0).findChild<QSlider*>(QStringLiteral("ghostBlend0"));
    slider->setValue(slider->maximum());
    bench.settle();
    // Only theirs: as that panel draws it, but for the marks that are this panel's.
    QVERIFY(bench.distanceFromColour(0, theirs, colours::right) < std::min(alike, faint));
    slider->setValue(0);
    bench.settle();
    QCOMPARE(bench.view(0).grabFramebuffer(), own);
    chooseGhost(bench, 0, QStringLiteral("No ghost"));
    QCOMPARE(bench.view(0).grabFramebuffer(), own);
    QVERIFY(!bench.find<QAction>("ghosts")->isChecked());
  }

  void ghostsFollowTheOtherPanelAndCuts() {
    Workbench bench(generate({MeshKind::tetra, {5, 4, 3}, 1, {}}));
    bench.trigger("ghosts");
    bench.settle();
    const QImage before = bench.view(0).grabFramebuffer();
    bench.document().cut({0, 1, 2, 3});
    dragFar(bench);
    QVERIFY(bench.view(0).grabFramebuffer() != before);
    bench.document().replaceMesh(generate({MeshKind::line, {6, 1, 1}, 1, {}}), QStringLiteral("line"),
                                 QStringLiteral("build"));
    bench.settle();
    QVERIFY(bench.view(1).ghost().of == 0);
    bench.trigger("ghosts");
    QVERIFY(!bench.view(1).ghost().of);
  }

  void placesAreSwappedAndStatesStay() {
    Workbench bench;
    dragFar(bench);
    const Point before = bench.position(0, 40);
    bench.trigger("swapPanels");
    bench.settle();
    QVERIFY(bench.window.panel(1).mapToGlobal(QPoint()).x() < bench.window.panel(0).mapToGlobal(QPoint()).x());
    QCOMPARE(bench.position(0, 40), before);
    QCOMPARE(bench.document().algorithm(0), Algorithm::generalized);
    const QPoint from = bench.place(1, 31);  // the hand works where it is seen
    bench.stroke(1, {from, from + QPoint(40, 40)});
    QVERIFY(bench.position(0, 40) != before || bench.document().frame(0)->statistics.last_pass.moved > 0);
    bench.trigger("swapPanels");
    bench.settle();
    QVERIFY(bench.window.panel(0).mapToGlobal(QPoint()).x() < bench.window.panel(1).mapToGlobal(QPoint()).x());
  }

  void panelsAreAddedAsTheObjectStands() {
    Workbench bench;
    Document& document = bench.document();
    document.cut({0, 5});
    document.setPinned({8}, true);
    dragFar(bench);
    bench.trigger("addPanel");
    bench.settle();
    QCOMPARE(document.panels(), 3);
    QCOMPARE(document.algorithm(2), Algorithm::exact);
    bench.trigger("addPanel");
    bench.settle();
    QCOMPARE(document.algorithm(3), Algorithm::enhanced);
    QVERIFY(!bench.find<QAction>("addPanel")->isEnabled());
    for (ElementId e = 0; e < document.mesh()->element_count(); ++e) {
      // Exact holds displacements from rest, rounded to floats.
      QVERIFY((bench.position(2, e) - bench.position(0, e)).norm() < 1e-5);
      QCOMPARE(bench.position(3, e), bench.position(0, e));
      // One camera, whatever the views' sizes: places are apart alike.
      const auto place = [&](int panel, ElementId one) { return bench.view(panel).placeOf(one); };
      const QPointF off = (place(3, e) - place(3, 0)) * bench.view(0).height() / bench.view(3).height();
      QVERIFY((off - (place(0, e) - place(0, 0))).manhattanLength() < 0.1);
    }
    // Under the same hand, and back with it: also through what was done before they came.
    const QPoint from = bench.place(3, 12);
    bench.stroke(3, {from, from + QPoint(40, 30)});
    for (int p = 0; p < 4; ++p) {
      QVERIFY(document.frame(p)->statistics.passes > 0);
    }
    while (document.undoStack().canUndo()) {
      document.undoStack().undo();
    }
    bench.settle();
    for (int p = 0; p < 4; ++p) {
      for (ElementId e = 0; e < document.mesh()->element_count(); ++e) {
        QCOMPARE(bench.position(p, e), document.mesh()->rest_position(e));
      }
    }
  }

  void panelsStandTwoInARowAndGoAgain() {
    Workbench bench;
    bench.trigger("ghosts");
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.settle();
    const auto at = [&](int panel) { return bench.window.panel(panel).mapTo(&bench.window, QPoint()); };
    QCOMPARE(at(0).y(), at(1).y());
    QCOMPARE(at(2).y(), at(3).y());
    QCOMPARE(at(0).x(), at(2).x());
    QVERIFY(at(2).y() > at(0).y() && at(1).x() > at(0).x());
    chooseGhost(bench, 0, QStringLiteral("Panel D"));
    QVERIFY(bench.view(0).ghost().of == 3);
    bench.trigger("colourBy-distance");
    bench.trigger("compareWithD");
    dragFar(bench);
    QTRY_VERIFY(bench.window.panel(0).legend().title().contains(QStringLiteral("from D")));
    QTest::mouseClick(&bench.window.panel(3).head(), Qt::LeftButton);  // nothing: the buttons are beside
    QVERIFY(bench.find<QToolButton>("removeButton3")->isVisible());
    QVERIFY(!bench.find<QToolButton>("removeButton2")->isVisible());
    QTest::mouseClick(bench.find<QToolButton>("removeButton3"), Qt::LeftButton);
    QTRY_COMPARE(bench.document().panels(), 3);
    bench.settle();
    QVERIFY(!bench.view(0).ghost().of);
    QVERIFY(bench.window.panel(1).legend().title().contains(QStringLiteral("from A")));
    QVERIFY(bench.window.panel(0).legend().title().contains(QStringLiteral("furthest")));
    bench.trigger("removePanel");
    QTRY_COMPARE(bench.document().panels(), 2);
    QVERIFY(!bench.find<QAction>("removePanel")->isEnabled());
    const QPoint from = bench.place(1, 12);
    bench.stroke(1, {from, from + QPoint(40, 30)});
    QVERIFY(bench.document().frame(0)->statistics.last_pass.moved > 0);
  }

  void theDistanceOfTheReferenceIsThatOfTheFurthest() {
    Workbench bench;
    bench.trigger("addPanel");
    bench.trigger("colourBy-distance");
    dragFar(bench);
    bench.trigger("linkColours");  // the panels' own ranges
    const auto furthest = [&](int a, int b) {
      double largest = 0;
      for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
        largest = std::max(largest, (bench.position(a, e) - bench.position(b, e)).norm());  // links are of length 1
      }
      return QLocale().toString(largest, 'g', 3);
    };
    const auto highest = [&](int p) { return bench.window.panel(p).legend().highest(); };
    QTRY_COMPARE(highest(1), furthest(1, 0));
    QTRY_COMPARE(highest(2), furthest(2, 0));
    bench.trigger("compareWithC");
    QTRY_COMPARE(highest(1), furthest(1, 2));
    QTRY_COMPARE(highest(0), furthest(0, 2));
  }

  void aPanelAloneAndAllBack() {
    Workbench bench;
    Panel &a = bench.window.panel(0), &b = bench.window.panel(1);
    const int half = a.width();
    QTest::mouseDClick(&b.head(), Qt::LeftButton, {}, b.head().rect().center());
    bench.settle();
    QVERIFY(!a.isVisible());
    QVERIFY(b.width() > 1.8 * half);
    QVERIFY(bench.find<QAction>("showAloneB")->isChecked());
    const QPoint from = bench.place(1, 31);
    bench.stroke(1, {from, from + QPoint(60, 40)});
    QVERIFY(bench.document().frame(0)->statistics.passes > 0);  // out of sight, and as far as the other
    QTest::mouseClick(bench.find<QToolButton>("aloneButton1"), Qt::LeftButton);
    bench.settle();
    QVERIFY(a.isVisible() && b.isVisible());
    QVERIFY(std::abs(a.width() - b.width()) <= 1);
    bench.trigger("showPanelA");
    QVERIFY(!a.isVisible());
    QVERIFY(!bench.find<QAction>("showPanelB")->isEnabled());  // the last one stays
    bench.trigger("showPanelA");
    QVERIFY(a.isVisible());
  }
};

int main(int argc, char** argv) { return runWindowTest<WindowCompare>(argc, argv); }
#include "window_compare.moc"
