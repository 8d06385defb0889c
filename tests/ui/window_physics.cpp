// Tests the elastic methods in a real window: which are available, which pins they need, and their settings.

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <future>
#include <limits>

#include "document/edits.h"
#include "panels/legend.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_physics {

namespace {

MeshPointer gridInAPlane() { return generate({MeshKind::grid, {9, 7, 1}, 1, {}}); }

void dragOne(Workbench& bench) {
  const QPoint from = bench.place(0, 31);
  bench.stroke(0, {from, from + QPoint(60, -40)});
}

/// Opens a menu as a click does, so that its items are updated.
void open(Workbench& bench, const char* menu) { emit bench.find<QMenu>(menu)->aboutToShow(); }

QString words(Workbench& bench, const char* action) {
  return bench.find<QAction>(action)->text().remove(QLatin1Char('&'));
}

}  // namespace

class WindowPhysics : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void layersArePinnedAtOnceAndUndone() {
    Workbench bench(gridInAPlane());
    open(bench, "pinLayers");
    QCOMPARE(words(bench, "pinBottom"), QStringLiteral("Bottom layer (9 elements)"));
    QCOMPARE(words(bench, "pinLeft"), QStringLiteral("Left layer (7 elements)"));
    QCOMPARE(words(bench, "pinBoundary"), QStringLiteral("Boundary (28 elements)"));
    QVERIFY(!bench.find<QAction>("pinFront")->isVisible());  // a plane has no depth
    bench.trigger("pinBottom");
    QCOMPARE(bench.document().pins(), (std::vector<ElementId>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    QVERIFY(bench.find<QLabel>("physicsPins")->text().contains(QStringLiteral("<b>9</b> of 63")));
    bench.trigger("pinLeft");  // the corner already has a pin
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("pin 6 elements"));
    open(bench, "pinLayers");
    QVERIFY(!bench.find<QAction>("pinLeft")->isEnabled());
    bench.document().undo();
    QCOMPARE(bench.document().pins().size(), std::size_t{9});
    bench.document().undo();
    QVERIFY(bench.document().pins().empty());
    QVERIFY(bench.find<QAction>("pinLeft")->isEnabled());
  }

  void theLawOfTheMaterialIsChosen() {
    Workbench bench(gridInAPlane());
    auto* law = bench.find<QComboBox>("law");
    auto* limit = bench.find<QDoubleSpinBox>("gent-limitSpin");
    auto* exponent = bench.find<QDoubleSpinBox>("fung-exponentSpin");
    const auto choose = [&](StrainLaw::Kind kind) {
      law->setCurrentIndex(law->findData(int(kind)));
      emit law->activated(law->currentIndex());
    };
    QVERIFY(limit->parentWidget()->isHidden() && exponent->parentWidget()->isHidden());
    choose(StrainLaw::Kind::gent);
    QVERIFY(bench.document().elastic().law.kind == StrainLaw::Kind::gent);
    QVERIFY(!limit->parentWidget()->isHidden() && exponent->parentWidget()->isHidden());
    limit->setValue(3);
    QCOMPARE(bench.document().elastic().law.gent_limit, 3.0);
    QCOMPARE(limit->value(), 3.0);
    // A material that hardly changes its volume is needed: the field shows what is there.
    bench.find<QDoubleSpinBox>("poissonSpin")->setValue(0);
    QCOMPARE(bench.document().elastic().material.poisson, 0.3);
    QCOMPARE(bench.find<QDoubleSpinBox>("poissonSpin")->value(), 0.3);
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("does not exist for a Poisson's ratio of 0")));
    bench.document().undo();
    bench.document().undo();
    QVERIFY(bench.document().elastic() == ElasticOptions());
    QCOMPARE(law->currentData().toInt(), int(StrainLaw::Kind::neo_hookean));
    choose(StrainLaw::Kind::fung);
    QVERIFY(limit->parentWidget()->isHidden() && !exponent->parentWidget()->isHidden());
    exponent->setValue(0.25);
    QCOMPARE(bench.document().elastic().law.fung_exponent, 0.25);
    QCOMPARE(exponent->value(), 0.25);
    bench.document().undo();
    QCOMPARE(exponent->value(), StrainLaw().fung_exponent);
  }

  void withoutPinsItOffersThemOnce() {
    Workbench bench(gridInAPlane());
    auto* bar = bench.find<QWidget>("pinsBar");
    bench.choose(1, "Linear FEM");
    QVERIFY(!bar->isVisible());
    dragOne(bench);
    QTRY_VERIFY(bar->isVisible());
    QVERIFY(bench.find<QLabel>("pinsAbout")->text().contains(QStringLiteral("so Linear FEM has no solution")));
    QVERIFY(!bench.window.messages().isVisible());
    QTRY_VERIFY(bench.find<QLabel>("state1")->toolTip().contains(QStringLiteral("nothing pinned: no solution")));
    // The other panel still follows the drag.
    QVERIFY(bench.position(0, 31) != bench.document().mesh()->rest_position(31));
    bench.find<QPushButton>("pinsCancel")->click();
    dragOne(bench);
    QVERIFY(!bar->isVisible());
    bench.choose(1, "Neo-Hookean FEM");
    dragOne(bench);
    QTRY_VERIFY(bar->isVisible());
    edits::resetObject(bench.document());
    bench.find<QPushButton>("pinsAgree")->click();
    QCOMPARE(bench.document().pins().size(), std::size_t{9});
    QVERIFY(!bar->isVisible());
  }

  void oncePinnedThePanelAnswers() {
    Workbench bench(gridInAPlane());
    bench.choose(1, "Linear FEM");
    bench.trigger("pinBottom");
    dragOne(bench);
    QVERIFY(!bench.window.messages().isVisible());
    const Mesh& mesh = *bench.document().mesh();
    QVERIFY((bench.position(1, 31) - bench.position(0, 31)).norm() < 1e-5);  // both panels have it at the handle
    // All unpinned elements follow. The farther from the handle, the less they move.
    const auto way = [&](ElementId e) { return (bench.position(1, e) - mesh.rest_position(e)).norm(); };
    QCOMPARE(way(4), 0.0);
    QVERIFY(way(60) > 0 && way(13) > 0 && way(13) < way(22) && way(22) < way(31));
    QTRY_VERIFY(bench.find<QLabel>("statistics1")->text().contains(QStringLiteral("solved for <b>63</b>")));
    bench.document().undo();
    bench.settle();
    QCOMPARE(way(60), 0.0);
  }

  /// The reference solution takes positions from panel A alone.
  void theReferenceWaitsForNoOtherPanel() {
    Workbench bench(gridInAPlane());
    bench.trigger("colourBy-truth");
    bench.trigger("pinBottom");
    dragOne(bench);
    const auto title = [&](int panel) { return bench.window.panel(panel).legend().title(); };
    QTRY_VERIFY(title(0).contains(QStringLiteral("relative error")));
    std::promise<void> slow;
    bench.document().solvers().ask(1, [end = slow.get_future().share()](const Simulation&) { end.wait(); });
    edits::setPinned(bench.document(), {62}, true);
    QTRY_VERIFY(!title(0).contains(QStringLiteral("relative error")));
    QTRY_VERIFY2(title(0).contains(QStringLiteral("relative error")), qPrintable(title(0)));
    QVERIFY(!bench.document().solvers().idle(1));
    slow.set_value();
  }

  void theErrorAgainstPhysicsIsRelativeAndInHandleWays() {
    Workbench bench(gridInAPlane());
    bench.choose(0, "Neo-Hookean FEM");
    bench.trigger("colourBy-truth");
    const auto title = [&](int panel) { return bench.window.panel(panel).legend().title(); };
    QTRY_VERIFY(title(0).contains(QStringLiteral("nothing pins the object")));
    QCOMPARE(bench.window.panel(0).legend().highest(), QString());
    bench.trigger("pinBottom");
    QTRY_VERIFY(title(0).contains(QStringLiteral("drag an element first")));
    dragOne(bench);
    QTRY_VERIFY(title(1).contains(QStringLiteral("RMS")) &&
                title(1).endsWith(QStringLiteral(" (of the handle's displacement)")));
    QVERIFY(title(1).contains(QStringLiteral("on the same cells")));
    // The title has the error relative to the displacements of the reference solution and of the handle, and the error
    // of an object at rest. Each number is before its words.
    const auto figureOf = [&](int panel, const QString& words) {
      for (const QString& part : title(panel).split(QStringLiteral(" · "))) {
        bool isNumber = false;
        const double figure = QLocale().toDouble(part.section(QLatin1Char(' '), 0, 0), &isNumber);
        if (isNumber && part.section(QLatin1Char(' '), 1) == words) {
          return figure;
        }
      }
      return std::numeric_limits<double>::quiet_NaN();
    };
    const QString relative = QStringLiteral("relative error on the same cells");
    QTRY_VERIFY(title(0).contains(relative));
    QVERIFY2(figureOf(0, relative) < 1e-4, qPrintable(title(0)));  // this panel runs the reference method
    const double nothing = figureOf(1, QStringLiteral("if nothing moves"));
    QVERIFY2(nothing > 0.5 && nothing < 1, qPrintable(title(1)));
    QVERIFY(figureOf(1, relative) > figureOf(1, QStringLiteral("RMS")));
    const auto highest = [&](int panel) { return QLocale().toDouble(bench.window.panel(panel).legend().highest()); };
    QTRY_VERIFY(!bench.window.panel(1).legend().highest().isEmpty());
    bench.window.colouring().setSharesScale(false);
    QTRY_VERIFY(highest(0) < 1e-4);  // the reference solution, up to the tolerance of Newton's method and of floats
    QVERIFY(highest(1) > 0.05 && highest(1) < 2);
    QCOMPARE(bench.window.panel(1).legend().lowest(), QStringLiteral("0"));
    edits::setPinned(bench.document(), {62}, true);  // another reference solution: the old colours are invalid
    QVERIFY(!bench.window.colouring().title(0).contains(QStringLiteral("displacement")));
    QVERIFY(bench.window.colouring().follow(0) == nullptr);
    QTRY_VERIFY(title(0).contains(QStringLiteral("displacement")));
    edits::resetObject(bench.document());
    QTRY_VERIFY(title(0).contains(QStringLiteral("drag an element first")));
  }
};

CHAINMAIL_WINDOW_TEST(WindowPhysics)

}  // namespace chainmail::window_physics

#include "window_physics.moc"
