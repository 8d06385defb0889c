// Tests the pin tool in a real window.

#include <QLabel>

#include "common/colours.h"
#include "document/edits.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_pin {

namespace {

constexpr ElementId pinned = 31, dragged = 33;  // in the middle row of 9 x 7

/// Drags so far that every element of the grid would move.
void dragFar(Workbench& bench) {
  const QPoint from = bench.place(0, dragged);
  bench.stroke(0, {from, from + QPoint(60, -220)});
}

}  // namespace

class WindowPin : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aPinHoldsUnderADragAndIsUndone() {
    Workbench bench;
    const Point rest = bench.document().mesh()->rest_position(pinned);
    QTest::keyClick(&bench.window, Qt::Key_P);
    QVERIFY(bench.find<QAction>("toolPin")->isChecked());
    bench.click(1, pinned);
    QCOMPARE(bench.document().pins(), std::vector<ElementId>{pinned});
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("pin 1 element"));
    bench.trigger("toolDrag");
    dragFar(bench);
    for (int p = 0; p < 2; ++p) {
      QCOMPARE(bench.position(p, pinned), rest);
      QVERIFY(bench.position(p, dragged) != bench.document().mesh()->rest_position(dragged));
    }
    QVERIFY(bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("1 pinned")));

    QTest::keyClick(&bench.window, Qt::Key_Z, Qt::ControlModifier);  // undoes the drag, then the pin
    QTest::keyClick(&bench.window, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(bench.document().pins().empty());
    bench.trigger("resetObject");
    bench.settle();
    dragFar(bench);
    QVERIFY(bench.position(1, pinned) != rest);  // without the pin, the element moves
  }

  /// With a tool of clicks, the second press of a double click is another click and does not move the view.
  void twoQuickClicksPinAndUnpin() {
    Workbench bench;
    bench.trigger("toolPin");
    const QPoint place = bench.place(0, dragged);
    QTest::mouseClick(&bench.view(0), Qt::LeftButton, {}, place);
    QCOMPARE(bench.document().pins(), std::vector<ElementId>{dragged});
    QTest::mouseDClick(&bench.view(0), Qt::LeftButton, {}, place);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, place);
    bench.settle();
    QVERIFY(bench.document().pins().empty());
    QCOMPARE(bench.place(0, dragged), place);
  }

  void aPinnedElementIsNotGrabbed() {
    Workbench bench;
    edits::setPinned(bench.document(), {pinned}, true);
    const QPoint from = bench.place(0, pinned);
    bench.stroke(0, {from, from + QPoint(80, -80)}, false);
    QVERIFY(!bench.document().highlight().marks().grabbed);
    QTRY_VERIFY(bench.window.messages().isVisible());
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("it is pinned and may not move")));
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(80, -80));
    bench.settle();
    QCOMPARE(bench.document().solvers().frame(0)->statistics.passes, 0U);
    dragFar(bench);  // the next drag works normally
    QVERIFY(bench.document().solvers().frame(0)->statistics.passes > 0);
  }
};

CHAINMAIL_WINDOW_TEST(WindowPin)

}  // namespace chainmail::window_pin

#include "window_pin.moc"
