// Tests the cut tool in a real window.

#include <QLabel>

#include "common/colours.h"
#include "document/edits.h"
#include "window.h"

namespace chainmail::window_cut {

namespace {

/// Returns a vertical stroke between the fourth and the fifth column of a 9 x 7 grid.
QList<QPoint> strokeBetweenColumns(Workbench& bench) {
  const QPoint top = (bench.place(0, 57) + bench.place(0, 58)) / 2;
  const QPoint bottom = (bench.place(0, 3) + bench.place(0, 4)) / 2;
  return {top - QPoint(0, 20), bottom + QPoint(0, 20)};
}

}  // namespace

class WindowCut : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aStrokeLightsItsLinksAndCutsThemInBothPanels() {
    Workbench bench;
    bench.trigger("toolCut");
    const auto places = strokeBetweenColumns(bench);
    bench.stroke(0, places, false);
    QCOMPARE(bench.document().highlight().marks().links.size(), 7U);  // one per row
    QCOMPARE(bench.document().cuts().count(), 0U);
    const QPointF between = (bench.view(0).viewPosition(30) + bench.view(0).viewPosition(40)) / 2;  // two rows
    QVERIFY(bench.distanceFromColour(0, between, colours::marked) < 20);  // the stroke is drawn
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, places.last());
    bench.settle();
    QVERIFY(bench.distanceFromColour(0, between, colours::marked) > 20);
    QCOMPARE(bench.document().cuts().count(), 7U);
    for (ElementId row = 0; row < 7; ++row) {
      const auto link = find_link(*bench.document().mesh(), 9 * row + 3, 9 * row + 4);
      QVERIFY(bench.document().cuts().is_cut(*link));
    }
    QVERIFY(bench.document().highlight().marks().links.empty());

    // The object now has two parts: dragging one does not move the other.
    bench.trigger("toolDrag");
    const QPoint from = bench.place(1, 35);
    bench.stroke(1, {from, from + QPoint(100, -120)});
    for (int p = 0; p < 2; ++p) {
      QVERIFY(bench.position(p, 35) != bench.document().mesh()->rest_position(35));
      for (const ElementId left : {0U, 3U, 30U, 57U}) {
        QCOMPARE(bench.position(p, left), bench.document().mesh()->rest_position(left));
      }
    }
  }

  /// The links that would be cut light up in all panels, also where marks are not linked.
  void theLinksToBeCutLightUpInAllPanels() {
    Workbench bench;
    bench.trigger("toolCut");
    bench.find<QAction>("linkMarks")->setChecked(false);
    const auto places = strokeBetweenColumns(bench);
    bench.stroke(0, places, false);
    for (int p = 0; p < 2; ++p) {
      const QPointF beside = 0.3 * bench.view(p).viewPosition(30) + 0.7 * bench.view(p).viewPosition(31);
      QVERIFY2(bench.distanceFromColour(p, beside, colours::lit) < 20,
               qPrintable(QString::number(bench.distanceFromColour(p, beside, colours::lit))));
    }
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, places.last());
    bench.settle();
  }

  void cutsAreUndoneAndRedone() {
    Workbench bench;
    bench.trigger("toolCut");
    bench.stroke(0, strokeBetweenColumns(bench));
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("cut 7 links"));
    QTest::keyClick(&bench.window, Qt::Key_Z, Qt::ControlModifier);
    bench.settle();
    QCOMPARE(bench.document().cuts().count(), 0U);
    QCOMPARE(bench.document().parts(), 1U);
    QTRY_VERIFY(!bench.find<QLabel>("state0")->text().contains(QStringLiteral("parts")));
    bench.trigger("redo");
    QCOMPARE(bench.document().cuts().count(), 7U);
    QCOMPARE(bench.document().parts(), 2U);
    bench.trigger("undo");
    bench.trigger("toolDrag");
    const QPoint from = bench.place(0, 35);
    bench.stroke(0, {from, from + QPoint(250, 0)});
    QVERIFY(bench.position(1, 30) != bench.document().mesh()->rest_position(30));  // the object is whole again
  }

  /// A part of a large mesh is in view. Partial uploads to the graphics card for a drag, a cut and its undo must give
  /// the same picture as a complete upload.
  void aPicturePatchedIsThePictureDrawnAnew() {
    Workbench bench(generate({MeshKind::cloth, {260, 250, 1}, 1, {}}));
    edits::setSoftness(bench.document(), {0.2, 2, 0.5}, QStringLiteral("soft"));
    View& view = bench.view(0);
    view.camera()->zoom(9, QPointF(view.width() / 2.0, view.height() / 2.0), view.size());
    const Camera near = *view.camera();
    const auto picture = [&] {
      bench.settle();
      return view.grabFramebuffer();
    };
    const auto dragBy = [&bench](double travel) {
      bench.document().handle().grab(32'630);
      bench.document().handle().drag(bench.position(0, 32'630) + Point(travel, travel / 2, 0));
      bench.document().handle().release();
      bench.settle();
    };
    const QImage before = picture();
    dragBy(4);
    const QPointF at = view.viewPosition(32'500);
    edits::cut(bench.document(), view.search().linksCrossing(QLineF(at - QPointF(80, 60), at + QPointF(70, 60))));
    edits::cut(bench.document(), view.search().linksCrossing(QLineF(at - QPointF(80, -60), at + QPointF(70, -60))));
    bench.document().undoStack().undo();
    QVERIFY(bench.document().cuts().count() > 0);
    dragBy(3);
    const QImage patched = picture();
    QVERIFY(patched != before);

    edits::replaceMesh(bench.document(), generate({MeshKind::line, {5, 1, 1}, 1, {}}), QStringLiteral("other"),
                       QStringLiteral("build"));
    bench.settle();
    bench.document().undoStack().undo();  // everything is uploaded again
    *view.camera() = near;
    QCOMPARE(picture(), patched);
  }

  void undoInMidStrokeGivesTheStrokeUp() {
    Workbench bench;
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {40, 30, 1}, 1, {}}), QStringLiteral("large"),
                       QStringLiteral("build large"));
    bench.settle();
    bench.trigger("toolCut");
    const QPoint from = bench.place(0, 700);
    bench.stroke(0, {from + QPoint(-50, 3), from + QPoint(50, 3)}, false);
    QVERIFY(!bench.document().highlight().marks().links.empty());
    bench.document().undoStack().undo();  // the small mesh has no such links
    QVERIFY(bench.document().highlight().marks().links.empty());
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, from);
    bench.settle();
    QCOMPARE(bench.document().cuts().count(), 0U);
  }
};

CHAINMAIL_WINDOW_TEST(WindowCut)

}  // namespace chainmail::window_cut

#include "window_cut.moc"
