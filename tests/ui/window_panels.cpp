// Tests panels in a real window: swapping, adding, removing, and showing one alone.

#include <QToolButton>

#include "document/edits.h"
#include "panels/legend.h"
#include "window.h"

namespace chainmail::window_panels {

class WindowPanels : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void placesAreSwappedAndStatesStay() {
    Workbench bench;
    bench.dragFar();
    const Point before = bench.position(0, 40);
    bench.trigger("swapPanels");
    bench.settle();
    QVERIFY(bench.window.panel(1).mapToGlobal(QPoint()).x() < bench.window.panel(0).mapToGlobal(QPoint()).x());
    QCOMPARE(bench.position(0, 40), before);
    QCOMPARE(bench.document().algorithm(0), Algorithm::generalized);
    const QPoint from = bench.place(1, 31);  // a drag works where the panel is shown
    bench.stroke(1, {from, from + QPoint(40, 40)});
    QVERIFY(bench.position(0, 40) != before || bench.document().solvers().frame(0)->statistics.last_pass.moved > 0);
    bench.trigger("swapPanels");
    bench.settle();
    QVERIFY(bench.window.panel(0).mapToGlobal(QPoint()).x() < bench.window.panel(1).mapToGlobal(QPoint()).x());
  }

  void theReferenceOfARemovedPanelIsTheFirst() {
    Workbench bench;
    bench.trigger("addPanel");
    bench.settle();
    bench.window.colouring().setReference(2);
    bench.trigger("removePanel");
    bench.settle();
    QCOMPARE(bench.document().panels(), 2);
    QCOMPARE(bench.window.colouring().reference(), 0);
  }

  void panelsAreAddedAsTheObjectStands() {
    Workbench bench;
    Document& document = bench.document();
    edits::cut(document, {0, 5});
    edits::setPinned(document, {8}, true);
    bench.dragFar();
    bench.trigger("addPanel");
    bench.settle();
    QCOMPARE(document.panels(), 3);
    QCOMPARE(document.algorithm(2), Algorithm::exact);
    bench.trigger("addPanel");
    bench.settle();
    QCOMPARE(document.algorithm(3), Algorithm::enhanced);
    QVERIFY(!bench.find<QAction>("addPanel")->isEnabled());
    for (ElementId e = 0; e < document.mesh()->element_count(); ++e) {
      // Exact stores displacements from rest, rounded to floats.
      QVERIFY((bench.position(2, e) - bench.position(0, e)).norm() < 1e-5);
      QCOMPARE(bench.position(3, e), bench.position(0, e));
      // The panels have one camera, so distances are equal relative to the height of the view.
      const auto place = [&](int panel, ElementId one) { return bench.view(panel).viewPosition(one); };
      const QPointF off = (place(3, e) - place(3, 0)) * bench.view(0).height() / bench.view(3).height();
      QVERIFY((off - (place(0, e) - place(0, 0))).manhattanLength() < 0.1);
    }
    // New panels follow the same drags and undo steps, also steps from before they were added.
    const QPoint from = bench.place(3, 12);
    bench.stroke(3, {from, from + QPoint(40, 30)});
    for (int p = 0; p < 4; ++p) {
      QVERIFY(document.solvers().frame(p)->statistics.passes > 0);
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
    QVERIFY(bench.document().solvers().frame(0)->statistics.passes > 0);  // the hidden panel has also computed the drag
    QTest::mouseClick(bench.find<QToolButton>("aloneButton1"), Qt::LeftButton);
    bench.settle();
    QVERIFY(a.isVisible() && b.isVisible());
    QVERIFY(std::abs(a.width() - b.width()) <= 1);
    bench.trigger("showPanelA");
    QVERIFY(!a.isVisible());
    QVERIFY(!bench.find<QAction>("showPanelB")->isEnabled());  // the last visible panel cannot be hidden
    bench.trigger("showPanelA");
    QVERIFY(a.isVisible());
  }
};

CHAINMAIL_WINDOW_TEST(WindowPanels)

}  // namespace chainmail::window_panels

#include "window_panels.moc"
