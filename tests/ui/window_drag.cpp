// Tests dragging in a real window: a drag in one panel moves the object in both.

#include <QWheelEvent>

#include "document/edits.h"
#include "window.h"

namespace chainmail::window_drag {

class WindowDrag : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void theObjectIsDrawnAndHoverHighlightsItInBothPanels() {
    Workbench bench;
    QVERIFY(bench.shown);
    const QColor background = bench.view(0).grabFramebuffer().pixelColor(3, 3);
    const double ratio = bench.view(0).devicePixelRatioF();
    for (int p = 0; p < 2; ++p) {
      const QPoint at = (QPointF(bench.place(p, 31)) * ratio).toPoint();
      const QImage picture = bench.view(p).grabFramebuffer();
      bool drawn = false;
      for (int dx = -2; dx <= 2; ++dx) {
        for (int dy = -2; dy <= 2; ++dy) {
          drawn = drawn || picture.pixelColor(at + QPoint(dx, dy)) != background;
        }
      }
      QVERIFY(drawn);
    }
    QTest::mouseMove(&bench.view(1), bench.place(1, 31) + QPoint(4, 3));
    QTRY_COMPARE(bench.document().highlight().marks().element, std::optional<ElementId>(31));
    QVERIFY(!bench.document().highlight().marks().grabbed);
    QTest::mouseMove(&bench.view(1), QPoint(2, 2));
    QTRY_VERIFY(!bench.document().highlight().marks().element);
  }

  void aHoverPreparesTheDrag() {
    Workbench bench;
    Document& document = bench.document();
    edits::setAlgorithm(document, 1, Algorithm::exact);
    edits::setSoftness(document, {1, 1, 0}, QStringLiteral("rigid"));
    bench.settle();
    QCOMPARE(document.solvers().prepared(), 0);
    const QPoint from = bench.place(1, 31);
    QTest::mouseMove(&bench.view(1), from + QPoint(2, 1));
    QTRY_COMPARE(document.solvers().prepared(), 1);
    bench.stroke(1, {from, from + QPoint(60, -80)}, false);
    bench.settle();
    QCOMPARE(document.solvers().frame(1)->statistics.last_pass.moved, std::uint64_t{62});
    QTest::mouseRelease(&bench.view(1), Qt::LeftButton, {}, from + QPoint(60, -80));
  }

  void dragFollowsTheHandInBothPanels_data() {
    QTest::addColumn<int>("panel");
    QTest::newRow("left") << 0;
    QTest::newRow("right") << 1;
  }
  void dragFollowsTheHandInBothPanels() {
    QFETCH(int, panel);
    Workbench bench;
    const ElementId element = 31;  // the middle of 9 x 7
    const QPoint from = bench.place(panel, element), to = from + QPoint(60, -80);
    bench.stroke(panel, {from + QPoint(3, 2), to + QPoint(3, 2)}, false);
    bench.settle();
    QVERIFY(bench.document().highlight().marks().grabbed);
    for (int p = 0; p < 2; ++p) {
      // The element stays under the cursor, up to the rounding of mouse positions.
      QVERIFY((bench.place(p, element) - to).manhattanLength() <= 2);
      QVERIFY(bench.document().solvers().frame(p)->statistics.passes > 0);
    }
    QCOMPARE(bench.position(0, element), bench.position(1, element));
    QTest::mouseRelease(&bench.view(panel), Qt::LeftButton, {}, to);
    QVERIFY(!bench.document().highlight().marks().grabbed);
  }

  void theViewsFollowAnObjectThatWasDraggedOutOfThem() {
    Workbench bench;
    bench.view(0).setFocus();
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(0, 3000)}, false);
    QTRY_VERIFY(!bench.window.area().showsAll());  // not while it is held
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from + QPoint(0, 3000));
    bench.settle();
    QTRY_VERIFY(bench.window.area().showsAll());
    bench.view(0).zoom(4);
    const double height = bench.view(0).camera()->pose().height;
    const QPoint again = bench.place(0, 31);
    bench.stroke(0, {again, again + QPoint(0, -2000)});
    QCOMPARE(bench.view(0).camera()->pose().height, height);  // the user has chosen the view
  }

  void besideTheObjectNothingMovesAndInsideTheRegionsTheGrabbedElementAlone() {
    Workbench bench;
    bench.stroke(0, {QPoint(5, 5), QPoint(80, 80)});
    QCOMPARE(bench.document().solvers().frame(0)->statistics.passes, 0U);
    QCOMPARE(bench.position(0, 0), bench.document().mesh()->rest_position(0));
    const QPoint from = bench.place(0, 31);
    const int link = bench.place(0, 32).x() - from.x();
    bench.stroke(0, {from, from + QPoint(link / 14, 0)});
    for (int p = 0; p < 2; ++p) {
      QVERIFY(bench.document().solvers().frame(p)->statistics.passes > 0);
      QCOMPARE(bench.document().solvers().frame(p)->statistics.last_pass.moved, 0U);
      QCOMPARE(bench.position(p, 32), bench.document().mesh()->rest_position(32));
    }
  }

  void aChainInOneDimensionMovesAlongX() {
    Workbench bench(generate({MeshKind::line, {8, 1, 1}, 1, {}}));
    const QPoint from = bench.place(0, 7);
    bench.stroke(0, {from, from + QPoint(90, -120)});
    for (int p = 0; p < 2; ++p) {
      QVERIFY(bench.position(p, 7).x() > 7.5);
      QCOMPARE(bench.position(p, 7).y(), 0.0);
      QVERIFY(bench.position(p, 0).x() >= 0);
    }
  }

  void aBlockIsDraggedInTheViewPlaneAndTurnsTheWayTheMouseGoes() {
    Workbench bench(generate({MeshKind::tetra, {5, 5, 5}, 1, {}}));
    const ElementId element = 124;
    const QPoint from = bench.place(0, element), to = from + QPoint(50, -70);
    bench.stroke(0, {from, to});
    QVERIFY((bench.place(0, element) - to).manhattanLength() <= 2);
    QVERIFY((bench.place(1, element) - to).manhattanLength() <= 2);

    const QPoint before = bench.place(1, 0);
    View& view = bench.view(0);
    QTest::mousePress(&view, Qt::RightButton, {}, QPoint(100, 100));
    QMouseEvent move(QEvent::MouseMove, QPointF(160, 130), view.mapToGlobal(QPointF(160, 130)), Qt::NoButton,
                     Qt::RightButton, Qt::NoModifier);
    QApplication::sendEvent(&view, &move);
    QTest::mouseRelease(&view, Qt::RightButton, {}, QPoint(160, 130));
    QVERIFY((bench.place(1, 0) - before).manhattanLength() > 20);  // the cameras are linked

    // The near side turns with the mouse, as if the user held it.
    bench.trigger("resetObject");
    bench.settle();
    constexpr ElementId near = 12 + 4 * 25;  // the middle of the front
    const auto turn = [&](QPoint by) {
      bench.trigger("viewFront");
      const QPoint before = bench.place(0, near);
      const QPointF to = QPointF(100, 100) + by;
      QTest::mousePress(&view, Qt::RightButton, {}, QPoint(100, 100));
      QMouseEvent move(QEvent::MouseMove, to, view.mapToGlobal(to), Qt::NoButton, Qt::RightButton, Qt::NoModifier);
      QApplication::sendEvent(&view, &move);
      QTest::mouseRelease(&view, Qt::RightButton, {}, to.toPoint());
      return bench.place(0, near) - before;
    };
    QVERIFY(turn({40, 0}).x() > 5);
    QVERIFY(turn({-40, 0}).x() < -5);
    QVERIFY(turn({0, 40}).y() > 5);
    QVERIFY(turn({0, -40}).y() < -5);
  }

  void theWheelBringsTheObjectNearerAndBack() {
    Workbench bench;
    const auto wheel = [&](int angle) {
      const QPointF at = bench.place(0, 31);
      QWheelEvent event(at, bench.view(0).mapToGlobal(at), {}, {0, angle}, Qt::NoButton, Qt::NoModifier,
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(&bench.view(0), &event);
    };
    const auto link = [&] {
      return bench.view(0).viewPosition(ElementId(32)).x() - bench.view(0).viewPosition(ElementId(31)).x();
    };
    const double before = link();
    const QPoint under = bench.place(0, 31);
    wheel(240);  // away from the user: two wheel steps
    QVERIFY(link() > 1.3 * before);
    QVERIFY((bench.place(0, 31) - under).manhattanLength() <= 2);  // the point under the cursor stays there
    wheel(-240);
    QVERIFY(std::abs(link() - before) < 0.1);
  }

  void theSelectorChangesOnePanelsAlgorithm() {
    Workbench bench;
    auto& selector = bench.window.panel(0).selector();
    selector.setCurrentIndex(selector.findText(QStringLiteral("Spiral")));
    emit selector.activated(selector.currentIndex());
    QCOMPARE(bench.document().algorithm(0), Algorithm::spiral);
    QCOMPARE(bench.document().algorithm(1), Algorithm::natural_queue);
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(120, -200)});
    for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
      QCOMPARE(bench.position(0, e), bench.position(1, e));  // Spiral and Natural Queue have the same result
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowDrag)

}  // namespace chainmail::window_drag

#include "window_drag.moc"
