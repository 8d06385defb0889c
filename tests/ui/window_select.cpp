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

  void ownSoftnessIsOneStepOfUndoAndStaysUnderTheSlidersOfAllLinks() {
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

    // The rows show what the selection has in common.
    auto* spin = bench.find<QDoubleSpinBox>("selected-compressionSpin");
    bench.document().selection().set({0, 1});
    QCOMPARE(spin->value(), 0.8);
    bench.document().selection().set({10, 11, 12});
    QCOMPARE(spin->value(), 0.3);
    bench.document().selection().set({9, 10, 11});  // links with and without their own softness
    QCOMPARE(spin->value(), 0.8);
    const auto description = [&] { return bench.find<QLabel>("selectedDescription")->text(); };
    QVERIFY(description().contains(QStringLiteral("differs")));
    QVERIFY2(description().startsWith(QStringLiteral("<b>3</b>\u00a0elements, <b>2</b>\u00a0links")),
             qPrintable(description()));
    bench.document().selection().set({10, 11});
    QVERIFY2(description().startsWith(QStringLiteral("<b>2</b>\u00a0elements, <b>1</b>\u00a0link")) &&
                 !description().contains(QStringLiteral("1</b>\u00a0links")),
             qPrintable(description()));

    // A slider of all links keeps their own, and is one step.
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
};

CHAINMAIL_WINDOW_TEST(WindowSelect)

}  // namespace chainmail::window_select

#include "window_select.moc"
