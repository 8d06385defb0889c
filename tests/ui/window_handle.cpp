// Tests handles of many elements in a real window: the brush of the Drag tool, the selection as a handle, rotation by
// Shift, by the ring and by numbers.

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QWheelEvent>
#include <cmath>

#include "common/colours.h"
#include "core/families.h"
#include "document/edits.h"
#include "io/sessions.h"
#include "mesh/mesh.h"
#include "tools/drag_tool.h"
#include "tools/rotation_ring.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_handle {

namespace {

/// Nine elements (three by three) of the grid of 9 x 7, around element 30.
const std::vector<ElementId> square{20, 21, 22, 29, 30, 31, 38, 39, 40};
constexpr ElementId squareMiddle = 30;

using Positions = std::vector<Point>;

/// Returns a grid of 7 x 7 elements in the plane that lacks an axis.
MeshPointer plane(int missing) {
  MeshParts parts;
  const int across = missing == 0 ? 2 : 0, up = missing == 1 ? 2 : 1;
  for (ElementId row = 0; row < 7; ++row) {
    for (ElementId column = 0; column < 7; ++column) {
      Point at = Point::Zero();
      at[across] = column;
      at[up] = row;
      at[missing] = 3;
      const auto element = ElementId(parts.rest.size());
      parts.rest.push_back(at);
      if (column > 0) {
        parts.links.push_back({element, element - 1});
      }
      if (row > 0) {
        parts.links.push_back({element, element - 7});
      }
    }
  }
  return build_mesh(std::move(parts));
}

Positions positions(Workbench& bench, int panel) {
  Positions all;
  for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
    all.push_back(bench.position(panel, e));
  }
  return all;
}

std::vector<Positions> allPositions(Workbench& bench) {
  std::vector<Positions> all;
  for (int panel = 0; panel < bench.document().panels(); ++panel) {
    all.push_back(positions(bench, panel));
  }
  return all;
}

std::vector<ElementId> held(Workbench& bench) {
  return {bench.document().handle().held().begin(), bench.document().handle().held().end()};
}

QString readout(Workbench& bench) { return bench.find<QLabel>("readout")->text(); }

/// Length of a link at rest in a view (pixels).
double linkPixels(Workbench& bench, int panel) {
  return std::abs(bench.view(panel).viewPosition(ElementId(32)).x() -
                  bench.view(panel).viewPosition(ElementId(31)).x());
}

void wheel(View& view, QPointF at, int angle) {
  QWheelEvent event(at, view.mapToGlobal(at), {}, {0, angle}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view, &event);
}

/// Returns the radius that the status bar shows; 0 without a radius.
int shownRadius(Workbench& bench) {
  const auto match = QRegularExpression(QStringLiteral("^Radius (\\d+) px")).match(readout(bench));
  return match.hasMatch() ? match.captured(1).toInt() : 0;
}

/// Moves the cursor to a place without a pressed button, and waits until the tool has followed. The events do not come
/// from the display, whose cursor may be anywhere.
void pointAt(Workbench& bench, int panel, QPointF at) {
  View& view = bench.view(panel);
  QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &move);
  bench.settle();
}

/// Turns the wheel with R held until the radius reaches that many pixels.
void setRadius(Workbench& bench, int panel, QPoint at, double pixels) {
  View& view = bench.view(panel);
  QTest::keyPress(&view, Qt::Key_R);
  for (int i = 0; i < 400 && shownRadius(bench) < pixels; ++i) {
    wheel(view, at, 30);
  }
  QTest::keyRelease(&view, Qt::Key_R);
  QVERIFY(shownRadius(bench) >= pixels);
  QVERIFY(shownRadius(bench) <= pixels + 6);
}

void moveTo(Workbench& bench, int panel, QPointF at, Qt::KeyboardModifiers modifiers) {
  View& view = bench.view(panel);
  QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, modifiers);
  QApplication::sendEvent(&view, &move);
  (void)QTest::qWaitFor([&bench] { return bench.document().solvers().idle(); }, Workbench::patience);
}

/// Moves the cursor on a circle about a place, counterclockwise on the screen; the left button is pressed.
void circle(Workbench& bench, int panel, QPointF about, QPointF from, double degrees,
            Qt::KeyboardModifiers modifiers = {}) {
  const QPointF arm = from - about;
  const int steps = std::max(1, int(std::abs(degrees) / 6));
  for (int i = 1; i <= steps; ++i) {
    const double angle = -degrees * i / steps * M_PI / 180;  // y points down
    moveTo(bench, panel,
           about + QPointF(arm.x() * std::cos(angle) - arm.y() * std::sin(angle),
                           arm.x() * std::sin(angle) + arm.y() * std::cos(angle)),
           modifiers);
  }
}

Point meanOf(const Positions& all, const std::vector<ElementId>& elements) {
  Point sum = Point::Zero();
  for (const ElementId e : elements) {
    sum += all[e];
  }
  return sum / double(elements.size());
}

/// Returns a position after a rotation about the z axis through a pivot.
Point turned(const Point& at, const Point& pivot, double degrees) {
  const double angle = degrees * M_PI / 180;
  const Point arm = at - pivot;
  return pivot + Point(arm.x() * std::cos(angle) - arm.y() * std::sin(angle),
                       arm.x() * std::sin(angle) + arm.y() * std::cos(angle), arm.z());
}

/// Checks that the elements are at their positions before, rotated about their mean and moved.
void compareTurned(Workbench& bench, const std::vector<Positions>& before, const std::vector<ElementId>& elements,
                   double degrees, const Point& by, double tolerance) {
  for (int panel = 0; panel < bench.document().panels(); ++panel) {
    const Positions& from = before[std::size_t(panel)];
    const Point pivot = meanOf(from, elements);
    for (const ElementId e : elements) {
      const Point expected = turned(from[e], pivot, degrees) + by;
      const double apart = (bench.position(panel, e) - expected).norm();
      QVERIFY2(apart <= tolerance,
               qPrintable(
                   QStringLiteral("panel %1, element %2: %3 mesh units from its target").arg(panel).arg(e).arg(apart)));
    }
  }
}

}  // namespace

class WindowHandle : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void theBrushGrabsTheElementsWithinItsRing_data() {
    QTest::addColumn<int>("panel");
    QTest::newRow("left") << 0;
    QTest::newRow("right") << 1;
  }
  void theBrushGrabsTheElementsWithinItsRing() {
    QFETCH(int, panel);
    Workbench bench;
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.settle();
    QCOMPARE(bench.document().panels(), 4);
    const auto before = allPositions(bench);
    const QPoint at = bench.place(panel, 31);
    const double link = linkPixels(bench, panel);
    pointAt(bench, panel, at);
    setRadius(bench, panel, at, 1.15 * link);
    const std::vector<ElementId> cross{22, 30, 31, 32, 40};  // the nearest diagonal is 1.41 links away
    QVERIFY2(readout(bench).contains(QStringLiteral("px · 5 elements")), qPrintable(readout(bench)));
    QCOMPARE(bench.document().highlight().marks().handle, cross);
    QVERIFY(!bench.document().undoStack().canUndo());  // R and the wheel change nothing

    bench.stroke(panel, {at, at + QPoint(20, -30)}, false);
    bench.settle();
    QCOMPARE(held(bench), cross);
    QVERIFY(bench.document().highlight().marks().grabbed);
    compareTurned(bench, before, cross, 0, Point(20 / link, 30 / link, 0), 0.02);
    QTest::mouseRelease(&bench.view(panel), Qt::LeftButton, {}, at + QPoint(20, -30));
    bench.settle();
    QVERIFY(held(bench).empty());
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("drag of 5 elements"));

    const auto after = allPositions(bench);
    bench.document().undo();
    bench.settle();
    QVERIFY(allPositions(bench) == before);
    bench.document().redo();
    bench.settle();
    QVERIFY(allPositions(bench) == after);
  }

  void aPinnedElementStaysOutOfTheHandle() {
    Workbench bench;
    edits::setPinned(bench.document(), {22}, true);
    bench.settle();
    const auto before = allPositions(bench);
    const QPoint at = bench.place(0, 31);
    pointAt(bench, 0, at);
    setRadius(bench, 0, at, 1.15 * linkPixels(bench, 0));
    QVERIFY2(readout(bench).contains(QStringLiteral("px · 4 elements")), qPrintable(readout(bench)));
    bench.stroke(0, {at, at + QPoint(10, -10)}, false);
    bench.settle();
    QCOMPARE(held(bench), (std::vector<ElementId>{30, 31, 32, 40}));
    for (int panel = 0; panel < 2; ++panel) {
      QCOMPARE(bench.position(panel, 22), before[std::size_t(panel)][22]);
      QVERIFY((bench.position(panel, 40) - before[std::size_t(panel)][40]).norm() > 0.05);
    }
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, at);
    bench.settle();
    QVERIFY(!bench.window.messages().isVisible());
    // With all of them pinned, nothing is grabbed, and a message gives the reason.
    edits::setPinned(bench.document(), {30, 31, 32, 40}, true);
    bench.settle();
    const int steps = bench.document().undoStack().count();
    bench.stroke(0, {at, at + QPoint(10, -10)});
    QVERIFY(held(bench).empty());
    QTRY_VERIFY(bench.window.messages().sentence().contains(QStringLiteral("pinned")));
    QCOMPARE(bench.document().undoStack().count(), steps);
  }

  void theSelectionIsDraggedAsOneBody() {
    Workbench bench;
    const auto before = allPositions(bench);
    bench.document().selection().set(square);
    const double link = linkPixels(bench, 1);
    const QPoint from = bench.place(1, 31);
    bench.stroke(1, {from, from + QPoint(40, -60)});
    compareTurned(bench, before, square, 0, Point(40 / link, 60 / link, 0), 0.02);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("drag of 9 elements"));
    // An element outside the selection is dragged alone.
    bench.stroke(1, {bench.place(1, 62), bench.place(1, 62) + QPoint(5, 5)});
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("drag of element 62"));
    // Esc clears the selection.
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(bench.document().selection().empty());
  }

  void shiftRotatesAndBothAddUp() {
    Workbench bench;
    const auto before = allPositions(bench);
    bench.document().selection().set(square);
    bench.settle();
    const double link = linkPixels(bench, 0);
    const QPointF pivot = bench.view(0).viewPosition(squareMiddle);
    const QPoint from = bench.place(0, 22);
    View& view = bench.view(0);
    QTest::mousePress(&view, Qt::LeftButton, {}, from);
    circle(bench, 0, pivot, from, 30, Qt::ShiftModifier);
    bench.settle();
    compareTurned(bench, before, square, 30, Point::Zero(), 0.01);
    // Without Shift, it moves on from there.
    const QPointF at = view.viewPosition(ElementId(22));
    moveTo(bench, 0, at, {});
    moveTo(bench, 0, at + QPointF(link / 2, -link), {});
    bench.settle();
    compareTurned(bench, before, square, 30, Point(0.5, 1, 0), 0.02);
    // And rotates back beyond the start, about the pivot where it is now.
    circle(bench, 0, pivot + QPointF(link / 2, -link), at + QPointF(link / 2, -link), -50, Qt::ShiftModifier);
    bench.settle();
    compareTurned(bench, before, square, -20, Point(0.5, 1, 0), 0.02);
    const QPointF then = view.viewPosition(ElementId(22));
    moveTo(bench, 0, then, {});
    moveTo(bench, 0, then + QPointF(link, 0), {});
    bench.settle();
    compareTurned(bench, before, square, -20, Point(1.5, 1, 0), 0.03);
    QTest::mouseRelease(&view, Qt::LeftButton, {}, from);
    bench.settle();
    QCOMPARE(bench.document().undoStack().count(), 1);
    bench.document().undo();
    bench.settle();
    QVERIFY(allPositions(bench) == before);
  }

  /// The object follows the cursor in every view: on the screen, the elements rotate by the angle of the cursor.
  void theObjectFollowsTheCursor_data() {
    QTest::addColumn<MeshPointer>("mesh");
    QTest::addColumn<double>("yaw");
    QTest::addColumn<double>("pitch");
    const MeshPointer block = generate({MeshKind::block, {4, 4, 4}, 1, {}});
    QTest::newRow("plane x-y") << plane(2) << 0.0 << 0.0;
    QTest::newRow("plane x-z") << plane(1) << 0.0 << 0.0;
    QTest::newRow("plane y-z") << plane(0) << 0.0 << 0.0;
    QTest::newRow("volume nearly from the front") << block << 12.0 << 8.0;
    QTest::newRow("volume nearly from the back") << block << 168.0 << -8.0;
    QTest::newRow("volume nearly from below") << block << 12.0 << -80.0;
    QTest::newRow("volume obliquely") << block << -130.0 << -40.0;
  }
  void theObjectFollowsTheCursor() {
    QFETCH(MeshPointer, mesh);
    QFETCH(double, yaw);
    QFETCH(double, pitch);
    Workbench bench(mesh);
    View& view = bench.view(0);
    view.setParallel(true);
    view.lookFrom(yaw, pitch);
    const bool flat = mesh->space_dimension == 2;
    const std::vector<ElementId> elements =
        flat ? std::vector<ElementId>{16, 17, 18, 23, 24, 25} : std::vector<ElementId>{0, 1, 2, 3, 4, 5, 6, 7, 20, 22};
    bench.document().selection().set(elements);
    bench.settle();
    std::vector<QPointF> places;
    const QPointF pivot = view.viewPosition(meanOf(positions(bench, 0), elements));
    for (const ElementId e : elements) {
      places.push_back(view.viewPosition(e));
    }
    const double arm = QLineF(pivot, places.back()).length();
    QVERIFY(arm > 15);
    QTest::mousePress(&view, Qt::LeftButton, {}, places.back().toPoint());
    circle(bench, 0, pivot, places.back(), 40, Qt::ShiftModifier);
    bench.settle();
    QCOMPARE(held(bench), elements);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      QLineF expected(pivot, places[i]);
      expected.setAngle(expected.angle() + 40);  // counterclockwise on the screen
      const QPointF now = view.viewPosition(elements[i]);
      QVERIFY2(
          QLineF(now, expected.p2()).length() < 2.5,
          qPrintable(
              QStringLiteral("element %1: %2 pixels away").arg(elements[i]).arg(QLineF(now, expected.p2()).length())));
    }
    QTest::mouseRelease(&view, Qt::LeftButton, {}, places.back().toPoint());
  }

  void theRingRotatesTheSelection() {
    Workbench bench;
    const auto before = allPositions(bench);
    bench.document().selection().set(square);
    bench.settle();
    View& view = bench.view(1);
    const QPointF pivot = view.viewPosition(squareMiddle);
    const double radius = std::max(40.0, std::sqrt(2.0) * linkPixels(bench, 1) + 16);
    const QPointF at = pivot + QPointF(radius * 0.6, -radius * 0.8);
    QVERIFY(bench.distanceFromColour(1, at, colours::selected) < 60);
    QVERIFY(bench.distanceFromColour(0, bench.view(0).viewPosition(squareMiddle) + (at - pivot), colours::selected) <
            60);
    pointAt(bench, 1, at.toPoint());
    QTRY_COMPARE(view.cursor().shape(), Qt::OpenHandCursor);
    QVERIFY(!bench.document().highlight().marks().element);
    QTest::mousePress(&view, Qt::LeftButton, {}, at.toPoint());
    circle(bench, 1, pivot, at, 200);
    bench.settle();
    compareTurned(bench, before, square, 200, Point::Zero(), 0.01);
    QVERIFY(bench.distanceFromColour(1, pivot - (at - pivot), colours::lit) < 60);
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at.toPoint());
    bench.settle();
    const QPointF after = view.viewPosition(squareMiddle);  // the view may have been fitted to the object
    const double radiusAfter = std::max(40.0, QLineF(after, view.viewPosition(square.front())).length() + 16);
    QVERIFY(bench.distanceFromColour(1, after + QPointF(radiusAfter, 0), colours::selected) < 100);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("drag of 9 elements"));
    bench.document().undo();
    bench.settle();
    QVERIFY(allPositions(bench) == before);
    // Other tools have no ring.
    bench.trigger("toolPin");
    bench.settle();
    QVERIFY(bench.distanceFromColour(1, pivot + QPointF(0, -radius), colours::selected) > 60);
  }

  void escapeRestoresWhatWasBeforeTheDrag() {
    Workbench bench;
    const auto before = allPositions(bench);
    bench.document().selection().set(square);
    bench.settle();
    const QPointF pivot = bench.view(0).viewPosition(squareMiddle);
    const QPoint from = bench.place(0, 22);
    QTest::mousePress(&bench.view(0), Qt::LeftButton, {}, from);
    circle(bench, 0, pivot, from, 24, Qt::ShiftModifier);
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    bench.settle();
    QVERIFY(held(bench).empty());
    QCOMPARE(bench.document().selection().elements(), square);
    QVERIFY(allPositions(bench) == before);
    circle(bench, 0, pivot, from, 60, Qt::ShiftModifier);  // the button is still pressed
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from);
    bench.settle();
    QVERIFY(allPositions(bench) == before);
    QCOMPARE(bench.document().undoStack().count(), 0);
    QVERIFY(bench.document().undoStack().isClean());
  }

  void numbersMoveAndRotateTheSelection() {
    Workbench bench;
    bench.find<QDockWidget>("elementDock")->show();
    bench.document().selection().set(square);
    bench.settle();
    const auto before = allPositions(bench);
    QVERIFY(bench.find<QLabel>("elementState")->text().contains(QStringLiteral("9 elements selected")));
    auto* button = bench.find<QPushButton>("moveElement");
    auto* degrees = bench.find<QLineEdit>("moveDegrees");
    QVERIFY(degrees->isVisible());
    QVERIFY(!bench.find<QComboBox>("moveAxis")->isVisible());  // a plane leaves no choice
    auto* how = bench.find<QComboBox>("moveHow");
    QVERIFY(!how->isEnabled());
    QCOMPARE(how->currentIndex(), 1);
    for (const char* bad : {"", "x", "4000"}) {
      degrees->setText(QLatin1String(bad));
      QVERIFY(!button->isEnabled());
      QVERIFY(button->toolTip().contains(QStringLiteral("degrees")));
    }
    degrees->setText(degrees->locale().toString(-75.0));
    bench.find<QLineEdit>("moveX")->setText(degrees->locale().toString(0.5));
    bench.find<QLineEdit>("moveY")->setText(degrees->locale().toString(-0.25));
    bench.find<QSpinBox>("moveSteps")->setValue(3);
    button->click();
    QTRY_VERIFY(held(bench).empty());
    bench.settle();
    compareTurned(bench, before, square, -75, Point(0.5, -0.25, 0), 1e-5);
    QCOMPARE(bench.document().undoStack().count(), 1);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("drag of 9 elements"));
    QCOMPARE(bench.document().solvers().frame(0)->statistics.passes, 3U);
    const std::vector<Command> drag = bench.document().moves().lastDrag();  // the grab, then equal steps
    QCOMPARE(drag.size(), std::size_t{4});
    for (std::size_t step = 1; step <= 3; ++step) {
      const auto& move = std::get<commands::Drag>(drag[step]);
      QVERIFY(std::abs(move.rotation.degrees + 25.0 * double(step)) < 1e-9);
      QVERIFY((move.target - Point(0.5, -0.25, 0) * double(step) / 3).norm() < 1e-9);
    }
    bench.document().undo();
    bench.settle();
    QVERIFY(allPositions(bench) == before);

    edits::setPinned(bench.document(), square, true);
    QTRY_VERIFY(!button->isEnabled());
    QVERIFY(button->toolTip().contains(QStringLiteral("pinned")));
    bench.document().selection().set({31});
    QVERIFY(!degrees->isVisible());
    QVERIFY(how->isEnabled());
    QCOMPARE(how->currentIndex(), 0);
    QCOMPARE(bench.find<QLineEdit>("moveX")->text(), QStringLiteral("4"));  // where element 31 is
  }

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowHandle)

}  // namespace chainmail::window_handle

#include "window_handle.moc"
