// Tests colour modes and their legends in a real window.

#include <QComboBox>
#include <QLocale>

#include "document/edits.h"
#include "drawing/colour_map.h"
#include "measure/violation.h"
#include "panels/legend.h"
#include "window.h"

namespace chainmail::window_colour {

namespace {

constexpr int alike = 45;  // of 255: a line of one pixel is blended with the background

void colourBy(Workbench& bench, const char* name) {
  bench.trigger(name);
  bench.settleFigures();
}

QPointF middleOf(Workbench& bench, int panel, ElementId a, ElementId b) {
  return (bench.view(panel).viewPosition(a) + bench.view(panel).viewPosition(b)) / 2;
}

QString shown(double value) { return QLocale().toString(value, 'g', 3); }

}  // namespace

class WindowColour : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void valuesUpToTheThresholdAreNeutral() {
    ColourScale scale;
    scale.threshold = 0.5F;
    scale.highest = 2;
    QCOMPARE(colour_map::of(0.5F, scale), QColor(colour_map::neutral));
    QCOMPARE(colour_map::of(-0.5F, scale), QColor(colour_map::neutral));
    QVERIFY(colour_map::of(0.6F, scale) != QColor(colour_map::neutral));
  }

  void plainIsAsBeforeAndHasNoLegend() {
    Workbench bench;
    const QImage before = bench.view(0).grabFramebuffer();
    const QSize size = bench.view(0).size();
    colourBy(bench, "colourBy-shear");
    QVERIFY(bench.window.panel(0).legend().isVisible());
    QVERIFY(bench.view(0).grabFramebuffer() != before);
    colourBy(bench, "colourBy-plain");
    QVERIFY(!bench.window.panel(0).legend().isVisible());
    QTRY_COMPARE(bench.view(0).size(), size);
    bench.settle();
    QCOMPARE(bench.view(0).grabFramebuffer(), before);
  }

  void coloursAndLegendFollowTheSoftness() {
    Workbench bench;
    colourBy(bench, "colourBy-stretch");
    const auto highest = [&](int panel) { return bench.window.panel(panel).legend().highest(); };
    QCOMPARE(highest(0), shown(1.2));
    edits::setSoftness(bench.document(), {0.8, 1.6, 0.1}, QStringLiteral("stretch"));
    bench.settleFigures();
    QCOMPARE(highest(0), shown(1.6));
    QCOMPARE(highest(1), shown(1.6));
    bench.document().undo();
    bench.settleFigures();
    QCOMPARE(highest(0), shown(1.2));
  }

  void fieldAndMenuSayTheSame() {
    Workbench bench;
    auto* field = bench.find<QComboBox>("colourBy");
    QVERIFY(bench.find<QAction>("colourBy-plain")->isChecked());
    bench.trigger("colourBy-violation");
    QCOMPARE(field->currentText(), QStringLiteral("Violation of links"));
    field->setCurrentIndex(field->findText(QStringLiteral("Distance between panels")));
    emit field->activated(field->currentIndex());
    QVERIFY(bench.find<QAction>("colourBy-distance")->isChecked());
    QVERIFY(!bench.find<QAction>("colourBy-violation")->isChecked());
  }

  void softnessOfLinks_data() {
    QTest::addColumn<QByteArray>("mode");
    QTest::addColumn<double>("own");
    QTest::addColumn<double>("global");
    QTest::newRow("compression") << QByteArray("colourBy-compression") << 0.2 << 0.8;
    QTest::newRow("stretch") << QByteArray("colourBy-stretch") << 2.5 << 1.2;
    QTest::newRow("shear") << QByteArray("colourBy-shear") << 0.7 << 0.1;
  }
  void softnessOfLinks() {
    QFETCH(QByteArray, mode);
    QFETCH(double, own);
    QFETCH(double, global);
    Workbench bench;
    edits::setSoftnessOf(bench.document(), {*find_link(*bench.document().mesh(), 30, 31)}, LinkSoftness{0.2, 2.5, 0.7});
    // A cut of an earlier link: each colour must stay with its own link.
    edits::cut(bench.document(), {*find_link(*bench.document().mesh(), 0, 1)});
    colourBy(bench, mode);
    for (int p = 0; p < 2; ++p) {
      QCOMPARE(bench.window.panel(p).legend().lowest(), shown(std::min(own, global)));
      QCOMPARE(bench.window.panel(p).legend().highest(), shown(std::max(own, global)));
      const QColor ofOwn = colour_map::at(own > global ? 1 : 0), ofGlobal = colour_map::at(own > global ? 0 : 1);
      QVERIFY(bench.distanceFromColour(p, middleOf(bench, p, 30, 31), ofOwn) < alike);
      QVERIFY(bench.distanceFromColour(p, middleOf(bench, p, 30, 31), ofGlobal) > alike);
      QVERIFY(bench.distanceFromColour(p, middleOf(bench, p, 31, 32), ofGlobal) < alike);
      QVERIFY(bench.distanceFromColour(p, middleOf(bench, p, 31, 32), ofOwn) > alike);
    }
    bench.document().undoStack().undo();
    bench.document().undoStack().undo();
    bench.settle();
    QTRY_COMPARE(bench.window.panel(0).legend().highest(), shown(global));
    QTRY_COMPARE(bench.window.panel(0).legend().lowest(), shown(global));
  }

  void withoutALinkThereIsNoScale() {
    Workbench bench(generate({MeshKind::line, {3, 1, 1}, 1, {}}));
    colourBy(bench, "colourBy-stretch");
    QCOMPARE(bench.window.panel(0).legend().highest(), shown(1.2));
    edits::cut(bench.document(), {0, 1});
    bench.settle();
    QTRY_COMPARE(bench.window.panel(0).legend().highest(), QString());
    QVERIFY(bench.window.panel(0).legend().isVisible());
  }

  void violationFollowsTheFramesOnOneScale() {
    Workbench bench;
    colourBy(bench, "colourBy-violation");
    QVERIFY(bench.window.panel(0).legend().title().contains(QStringLiteral("live")));
    QVERIFY(bench.distanceFromColour(0, middleOf(bench, 0, 31, 32), colour_map::neutral) < alike);  // at rest
    edits::setPinned(bench.document(), {40}, true);  // the sequential algorithms violate a link next to this pin
    bench.dragFar();
    double largest = 0;
    std::array<LinkId, 2> worst{};
    for (int p = 0; p < 2; ++p) {
      const Frame& frame = *bench.document().solvers().frame(p);
      double here = 0;
      for (LinkId link = 0; link < frame.mesh->link_count(); ++link) {
        const double one = link_violation(*frame.mesh, {}, frame.view(), link);
        worst[std::size_t(p)] = one > here ? link : worst[std::size_t(p)];
        here = std::max(here, one);
      }
      largest = std::max(largest, here);
    }
    QVERIFY(largest > 0.5);
    for (int p = 0; p < 2; ++p) {
      QTRY_COMPARE(bench.window.panel(p).legend().highest(), shown(largest));
    }
    const Frame& left = *bench.document().solvers().frame(0);
    const double share = link_violation(*left.mesh, {}, left.view(), worst[0]) / largest;
    const auto& ends = left.mesh->links[worst[0]];
    QVERIFY(bench.distanceFromColour(0, middleOf(bench, 0, ends[0], ends[1]), colour_map::at(share)) < alike);
  }

  void distanceBetweenThePanels() {
    Workbench bench;
    colourBy(bench, "colourBy-distance");
    QCOMPARE(bench.window.panel(0).legend().highest(), shown(0));
    bench.dragFar();
    double largest = 0;
    ElementId furthest = 0;
    for (ElementId e = 0; e < bench.document().mesh()->element_count(); ++e) {
      const double apart = (bench.position(0, e) - bench.position(1, e)).norm();  // all links have length 1
      furthest = apart > largest ? e : furthest;
      largest = std::max(largest, apart);
    }
    QVERIFY(largest > 0.5);
    for (int p = 0; p < 2; ++p) {
      QTRY_COMPARE(bench.window.panel(p).legend().highest(), shown(largest));
      QVERIFY(bench.distanceFromColour(p, bench.place(p, furthest), colour_map::at(1)) < alike);
      // Both panels have it at the handle.
      QVERIFY(bench.distanceFromColour(p, bench.place(p, 31), colour_map::at(0)) < alike);
    }
  }

  void aMeshDrawnCoarselyIsColouredToo() {
    Workbench bench(generate({MeshKind::grid, {512, 512, 1}, 1, {}}));
    QTRY_VERIFY(bench.view(0).drawnStep() > 1);
    colourBy(bench, "colourBy-violation");
    const QPoint from = bench.place(0, 131'328);
    bench.stroke(0, {from, from + QPoint(60, 30)});
    double largest = 0;
    for (int p = 0; p < 2; ++p) {
      const Frame& frame = *bench.document().solvers().frame(p);
      largest = std::max(largest, measure_violation(*frame.mesh, {}, bench.document().cuts(), frame.view()).max);
    }
    QTRY_COMPARE(bench.window.panel(1).legend().highest(), shown(std::max(largest, 1e-4)));
  }

  void theMeshMayChangeUnderAnyMode() {
    Workbench bench;
    for (const char* mode : {"colourBy-stretch", "colourBy-violation", "colourBy-distance"}) {
      colourBy(bench, mode);
      for (const auto kind : {MeshKind::tetra, MeshKind::line}) {
        edits::replaceMesh(bench.document(), generate({kind, {6, 5, 4}, 1, {}}), QStringLiteral("other"),
                           QStringLiteral("build"));
        bench.settle();
        QVERIFY(bench.window.panel(1).legend().isVisible());
      }
      bench.document().undoStack().undo();
      bench.settle();
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowColour)

}  // namespace chainmail::window_colour

#include "window_colour.moc"
