// Tests the select tool and the softness of selected links in a real window.

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>

#include "common/colours.h"
#include "document/edits.h"
#include "mesh/parameters.h"
#include "window.h"

namespace chainmail::window_select {

namespace {

/// Nine elements (three by three) with twelve links between them.
const std::vector<ElementId> square{10, 11, 12, 19, 20, 21, 28, 29, 30};
constexpr std::size_t squareLinks = 12;

/// Selects with a rectangle that is slightly larger than the area between two elements.
void selectBetween(Workbench& bench, ElementId a, ElementId b, Qt::KeyboardModifiers modifiers = {}) {
  const QPoint from = bench.place(0, a), to = bench.place(0, b);
  const QPoint beyond(to.x() >= from.x() ? 6 : -6, to.y() >= from.y() ? 6 : -6);
  bench.stroke(0, {from - beyond, to + beyond}, true, modifiers);
}

void setSquare(Workbench& bench, double compression) {
  QTest::keyClick(&bench.window, Qt::Key_S);
  selectBetween(bench, 10, 30);
  bench.find<QDoubleSpinBox>("selected-compressionSpin")->setValue(compression);
  bench.find<QPushButton>("setSelected")->click();
}

/// Selects the square and begins a stroke of the brush elsewhere, which replaces the selection until it is given up.
bool holdsABrushStroke(Workbench& bench) {
  bench.trigger("toolSelect");
  selectBetween(bench, 10, 30);
  bench.find<QToolButton>("selectBrush")->click();
  bench.stroke(0, {bench.place(0, 45), bench.place(0, 53)}, false);
  return bench.document().selection().elements() != square;
}

}  // namespace

class WindowSelect : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aRectangleSelects() {
    Workbench bench;
    QTest::keyClick(&bench.window, Qt::Key_S);
    QVERIFY(bench.find<QAction>("toolSelect")->isChecked());
    selectBetween(bench, 10, 30);
    QCOMPARE(bench.document().selection().elements(), square);
    QCOMPARE(bench.document().selection().links().size(), squareLinks);
    selectBetween(bench, 62, 52);  // from the other corner; replaces the first selection
    QCOMPARE(bench.document().selection().elements(), (std::vector<ElementId>{52, 53, 61, 62}));
    QVERIFY(!bench.document().undoStack().canUndo());
  }

  void keysAddRemoveAndClear() {
    Workbench bench;
    bench.trigger("toolSelect");
    selectBetween(bench, 10, 12);
    selectBetween(bench, 19, 30, Qt::ShiftModifier);
    QCOMPARE(bench.document().selection().elements(), square);
    for (const auto modifier : {Qt::ControlModifier, Qt::AltModifier}) {
      selectBetween(bench, 20, 20, modifier);
      QVERIFY(!std::binary_search(bench.document().selection().elements().begin(),
                                  bench.document().selection().elements().end(), ElementId{20}));
      QCOMPARE(bench.document().selection().elements().size(), square.size() - 1);
      selectBetween(bench, 20, 20, Qt::ShiftModifier);
    }
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(bench.document().selection().empty());
  }

  void escapeInAFieldKeepsTheSelection() {
    Workbench bench;
    bench.trigger("toolSelect");
    bench.document().selection().set(square);
    auto& selector = bench.window.panel(0).selector();
    selector.setFocus();
    QTRY_COMPARE(QApplication::focusWidget(), &selector);
    QTest::keyClick(&selector, Qt::Key_Escape);
    QCOMPARE(bench.document().selection().elements(), square);
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(bench.document().selection().empty());
  }

  void aClickSelectsTheNearestOrNone() {
    Workbench bench;
    bench.trigger("toolSelect");
    bench.click(1, 31);
    QCOMPARE(bench.document().selection().elements(), std::vector<ElementId>{31});
    QTest::mouseClick(&bench.view(1), Qt::LeftButton, {}, QPoint(4, 4));
    QVERIFY(bench.document().selection().empty());
  }

  void theBrushSelectsAlongItsWay() {
    Workbench bench;
    bench.trigger("toolSelect");
    QVERIFY(!bench.find<QSpinBox>("brushRadius")->isEnabled());
    bench.find<QToolButton>("selectBrush")->click();
    bench.find<QSpinBox>("brushRadius")->setValue(10);
    bench.stroke(0, {bench.place(0, 9), bench.place(0, 17)}, false);
    const std::vector<ElementId> row{9, 10, 11, 12, 13, 14, 15, 16, 17};
    QCOMPARE(bench.document().selection().elements(), row);  // also during the stroke
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, bench.place(0, 17));
    QCOMPARE(bench.document().selection().elements(), row);
    // A brush that reaches the neighbouring rows.
    const int link = bench.place(0, 10).x() - bench.place(0, 9).x();
    bench.find<QSpinBox>("brushRadius")->setValue(link * 11 / 10);
    bench.stroke(0, {bench.place(0, 9), bench.place(0, 17)});
    QCOMPARE(bench.document().selection().elements().size(), 27U);
  }

  void escapeGivesABrushStrokeUp() {
    Workbench bench;
    QVERIFY(holdsABrushStroke(bench));
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QCOMPARE(bench.document().selection().elements(), square);
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, bench.place(0, 53));
    QCOMPARE(bench.document().selection().elements(), square);
  }

  /// Another window may receive the release. The next move of the mouse then has no pressed button.
  void aBrushStrokeWithoutItsReleaseIsGivenUp() {
    Workbench bench;
    QVERIFY(holdsABrushStroke(bench));
    View& view = bench.view(0);
    const QPointF at = bench.place(0, 53);
    QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&view, &move);
    QTRY_COMPARE(bench.document().selection().elements(), square);
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at.toPoint());
    QCOMPARE(bench.document().selection().elements(), square);
  }

  void anotherMeshInMidStrokeIsSafe() {
    Workbench bench;
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {40, 30, 1}, 1, {}}), QStringLiteral("large"),
                       QStringLiteral("build large"));
    bench.settle();
    bench.trigger("toolSelect");
    selectBetween(bench, 1000, 1199);
    QVERIFY(!bench.document().selection().empty());
    bench.find<QToolButton>("selectBrush")->click();
    bench.stroke(0, {bench.place(0, 45), bench.place(0, 53)}, false);
    bench.document().undoStack().undo();  // the other mesh does not have those elements
    QVERIFY(bench.document().selection().empty());
    bench.settle();
    QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, QPoint(4, 4));
    QVERIFY(bench.document().selection().empty());
  }

  void theSelectionIsMarkedInBothPanels() {
    Workbench bench;
    const QImage before[]{bench.view(0).grabFramebuffer(), bench.view(1).grabFramebuffer()};
    bench.document().selection().set({31});
    bench.settle();
    for (int p = 0; p < 2; ++p) {
      const QPointF ring = QPointF(bench.place(p, 31)) + QPointF(4, 4);  // next to the lines of the grid
      QVERIFY(bench.distanceFromColour(p, ring, colours::selected) < 40);
    }
    bench.document().selection().set({});
    bench.settle();
    for (int p = 0; p < 2; ++p) {
      QCOMPARE(bench.view(p).grabFramebuffer(), before[p]);
    }
  }

  void withNothingSelectedTheGroupSaysWhatToDo() {
    Workbench bench;
    QVERIFY(!bench.find<QPushButton>("setSelected")->isEnabled());
    QVERIFY(!bench.find<QPushButton>("selectedToGlobal")->isEnabled());
    QVERIFY(!bench.find<QDoubleSpinBox>("selected-shearSpin")->isEnabled());
    QVERIFY(bench.find<QLabel>("selectedDescription")->text().contains(QStringLiteral("Nothing selected")));
  }

  void setIsOneStepOfUndoAndBackToGlobalAnother() {
    Workbench bench;
    setSquare(bench, 0.3);
    const auto own = [&bench] { return bench.document().wholeSoftness()->links; };
    QCOMPARE(own().size(), squareLinks);
    for (const LinkId link : bench.document().selection().links()) {
      QCOMPARE(*bench.document().wholeSoftness()->links.find(link), (LinkSoftness{0.3, 1.2, 0.1}));
    }
    QCOMPARE(bench.document().softness(), LinkSoftness());
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("softness of 12 links"));
    bench.document().undoStack().undo();
    QVERIFY(own().empty());
    bench.document().undoStack().redo();
    QCOMPARE(own().size(), squareLinks);

    bench.document().selection().set({10, 11});
    bench.find<QPushButton>("selectedToGlobal")->click();
    QCOMPARE(own().size(), squareLinks - 1);
    QVERIFY(!bench.find<QPushButton>("selectedToGlobal")->isEnabled());
    bench.document().undoStack().undo();
    QCOMPARE(own().size(), squareLinks);
  }

  void theRowsShowWhatTheSelectionHasInCommon() {
    Workbench bench;
    setSquare(bench, 0.3);
    auto* spin = bench.find<QDoubleSpinBox>("selected-compressionSpin");
    bench.document().selection().set({0, 1});
    QCOMPARE(spin->value(), 0.8);
    bench.document().selection().set({10, 11, 12});
    QCOMPARE(spin->value(), 0.3);
    bench.document().selection().set({9, 10, 11});  // links with and without their own softness
    QCOMPARE(spin->value(), 0.8);
    QVERIFY(bench.find<QLabel>("selectedDescription")->text().contains(QStringLiteral("differs")));
  }

  void theRowsFollowWhatIsSetAndUndone() {
    Workbench bench;
    bench.document().selection().set({10, 11, 12});
    auto* spin = bench.find<QDoubleSpinBox>("selected-compressionSpin");
    edits::setSoftness(bench.document(), {0.4, 1.2, 0.1}, QStringLiteral("compression"));
    QCOMPARE(spin->value(), 0.4);  // these links have no softness of their own
    bench.document().undo();
    QCOMPARE(spin->value(), 0.8);
    edits::setSoftnessOf(bench.document(), bench.document().selection().links(), LinkSoftness{0.6, 1.2, 0.1});
    QCOMPARE(spin->value(), 0.6);
    QVERIFY(bench.find<QPushButton>("selectedToGlobal")->isEnabled());
    bench.document().undo();
    QCOMPARE(spin->value(), 0.8);
    QVERIFY(!bench.find<QPushButton>("selectedToGlobal")->isEnabled());
  }

  void aSliderGoesFromItsLowestToItsHighestValue() {
    Workbench bench;
    const std::vector<std::pair<const char*, Parameter>> sliders{
        {"compression", parameters::compression}, {"stretch", parameters::stretch}, {"shear", parameters::shear}};
    for (const auto& [name, parameter] : sliders) {
      auto* slider = bench.find<QSlider>((std::string(name) + "Slider").c_str());
      const auto* spin = bench.find<QDoubleSpinBox>((std::string(name) + "Spin").c_str());
      for (const double share : {1.0, 0.25, 0.0}) {
        slider->setValue(int(share * slider->maximum()));
        QCOMPARE(spin->value(), parameter.lowest + share * (parameter.slider_highest - parameter.lowest));
        QCOMPARE(slider->value(), int(share * slider->maximum()));
      }
    }
    QCOMPARE(bench.document().softness().compression, parameters::compression.lowest);
    QCOMPARE(bench.document().softness().stretch, parameters::stretch.lowest);
    QCOMPARE(bench.document().softness().shear, parameters::shear.lowest);
  }

  void aSliderOfAllLinksKeepsTheirOwnAndIsOneStep() {
    Workbench bench;
    setSquare(bench, 0.3);
    auto* slider = bench.find<QSlider>("stretchSlider");
    slider->setSliderDown(true);
    for (int at = 200; at <= 400; at += 20) {
      slider->setValue(at);
    }
    slider->setSliderDown(false);
    QCOMPARE(bench.document().undoStack().count(), 2);
    QCOMPARE(bench.document().wholeSoftness()->links.size(), squareLinks);
    QVERIFY(bench.document().softness().stretch > 1.2);
    bench.document().undoStack().undo();
    QCOMPARE(bench.document().softness(), LinkSoftness());
    QCOMPARE(bench.document().wholeSoftness()->links.size(), squareLinks);
    bench.trigger("resetStiffness");
    QCOMPARE(*bench.document().wholeSoftness(), standard_softness());
  }

  void aStiffLinkDoesNotGive() {
    Workbench bench(generate({MeshKind::line, {6, 1, 1}, 1, {}}));
    bench.document().selection().set({0, 1});
    bench.find<QDoubleSpinBox>("selected-stretchSpin")->setValue(1);
    bench.find<QPushButton>("setSelected")->click();
    const QPoint from = bench.place(0, 0);
    bench.stroke(0, {from, from - QPoint(40, 0)});
    for (int p = 0; p < 2; ++p) {
      QVERIFY(bench.position(p, 0).x() < -0.2);
      QVERIFY(std::abs(bench.position(p, 1).x() - bench.position(p, 0).x() - 1) < 1e-5);
      QVERIFY(bench.position(p, 2).x() - bench.position(p, 1).x() > 1.1);
    }
  }

  void ownSoftnessGoesWithTheMeshAndComesBack() {
    Workbench bench;
    setSquare(bench, 0.3);
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {4, 4, 1}, 1, {}}), QStringLiteral("small"),
                       QStringLiteral("build small"));
    QVERIFY(bench.document().selection().empty());
    QVERIFY(bench.document().wholeSoftness()->links.empty());
    bench.document().undoStack().undo();
    QCOMPARE(bench.document().wholeSoftness()->links.size(), squareLinks);
  }
};

CHAINMAIL_WINDOW_TEST(WindowSelect)

}  // namespace chainmail::window_select

#include "window_select.moc"
