// Tests colour modes, their ranges and their legends in a real window.

#include <QDoubleSpinBox>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLocale>

#include "document/edits.h"
#include "drawing/colour_map.h"
#include "measure/violation.h"
#include "panels/legend.h"
#include "panels/panel_area.h"
#include "window.h"
#include "window/window_layout.h"

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

double violationOf(Workbench& bench, int panel, LinkId link) {
  return link_violation(*bench.document().mesh(), {}, bench.document().solvers().frame(panel)->view(), link);
}

/// Returns the colour range of a session's layout.
QJsonObject storedRange(Workbench& bench) {
  const auto layout = QByteArray::fromStdString(layoutOf(bench.window));
  return QJsonDocument::fromJson(layout).object()[QStringLiteral("colourRange")].toObject();
}

void applyRange(Workbench& bench, const char* range) {
  applyLayout(bench.window,
              QByteArray(R"({"colour": "violation", "colourRange": )").append(range).append('}').toStdString());
  bench.settleFigures();
}

}  // namespace

class WindowColour : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void valuesUpToTheThresholdAreNeutral() {
    ColourScale scale;
    scale.threshold = 0.5F;
    scale.highest = 2;
    QCOMPARE(colour_map::of(0.5F, scale), QColor(colour_map::neutral));
    QCOMPARE(colour_map::of(-0.5F, scale), QColor(colour_map::neutral));
    QVERIFY(colour_map::of(0.6F, scale) != QColor(colour_map::neutral));
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

  /// As for distances: each corner of a face has the largest violation of its links.
  void facesInSpaceShowViolation() {
    Workbench bench(generate({MeshKind::tetra, {5, 4, 3}, 1, {}}));
    edits::setPinned(bench.document(), {0}, true);
    colourBy(bench, "colourBy-violation");
    bench.document().handle().grab(59);
    bench.document().handle().drag({9, 7, 5});
    bench.document().handle().release();
    bench.settleFigures();
    const ColourValues* values = bench.window.colouring().follow(0);
    const Mesh& mesh = *bench.document().mesh();
    QCOMPARE(values->atElements.size(), std::size_t{mesh.element_count()});
    std::vector<float> largest(mesh.element_count());
    for (LinkId link = 0; link < mesh.link_count(); ++link) {
      for (const ElementId end : mesh.links[link]) {
        largest[end] = std::max(largest[end], float(violationOf(bench, 0, link)));
      }
    }
    QVERIFY(std::ranges::max(largest) > 0.1F);
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      QVERIFY(std::abs(values->atElements[e] - largest[e]) < 1e-4F);
    }
    bench.trigger("showSurface");
    bench.settleFigures();
    const QImage violated = bench.view(0).grabFramebuffer();
    bench.trigger("colourBy-plain");
    bench.settleFigures();
    QVERIFY(bench.view(0).grabFramebuffer() != violated);
  }

  void theRangeIsAutomaticFixedOrLogarithmic() {
    Workbench bench;
    edits::setPinned(bench.document(), {40}, true);
    colourBy(bench, "colourBy-violation");
    bench.dragFar();
    bench.settleFigures();
    const Legend& legend = bench.window.panel(0).legend();
    const QString automatic = legend.highest();
    bench.trigger("colourRange-logarithmic");
    bench.settleFigures();
    QCOMPARE(legend.highest(), automatic);
    QVERIFY(bench.window.colouring().scale(0).logarithmic);
    QVERIFY(legend.ticks(360).size() >= 4);  // the powers of ten
    bench.trigger("colourRange-fixed");
    bench.find<QDoubleSpinBox>("colourRangeHighest")->setValue(0.25);
    bench.find<QDoubleSpinBox>("colourRangeLowest")->setValue(0.1);
    bench.settleFigures();
    QCOMPARE(legend.lowest(), shown(0.1));
    QCOMPARE(legend.highest(), shown(0.25));
    bench.find<QDoubleSpinBox>("colourRangeLowest")->setValue(7);  // above the highest
    QVERIFY(bench.window.colouring().range().valid());
    colourBy(bench, "colourBy-distance");  // has other units, so it has its own range
    QVERIFY(bench.find<QAction>("colourRange-automatic")->isChecked());
    QVERIFY(!bench.find<QDoubleSpinBox>("colourRangeLowest")->isEnabled());
    colourBy(bench, "colourBy-violationDifference");
    QVERIFY(!bench.find<QAction>("colourRange-logarithmic")->isEnabled());
    colourBy(bench, "colourBy-violation");
    QVERIFY(bench.find<QAction>("colourRange-fixed")->isChecked());
    bench.trigger("colourRange-automatic");
    bench.settleFigures();
    QCOMPARE(legend.highest(), automatic);
  }

  void sessionsHaveTheRange() {
    Workbench bench;
    applyRange(bench, R"({"kind": "fixed", "lowest": 0.25, "highest": 4})");
    QCOMPARE(bench.window.colouring().range(), (ColourRange{ColourRange::Kind::fixed, 0.25, 4}));
    const QJsonObject stored = storedRange(bench);
    QCOMPARE(stored[QStringLiteral("kind")].toString(), QStringLiteral("fixed"));
    QCOMPARE(stored[QStringLiteral("highest")].toDouble(), 4.0);
    for (const char* wrong :
         {R"({"kind": "huge"})", R"({"kind": "fixed"})", R"({"kind": "fixed", "lowest": 3, "highest": 3})",
          R"({"kind": "fixed", "lowest": "0", "highest": 1})", R"({"kind": "fixed", "lowest": 0, "highest": 1e300})",
          R"({"kind": 2, "lowest": 0, "highest": 1})", "[]", "7"}) {
      applyRange(bench, wrong);
      QCOMPARE(storedRange(bench), stored);
    }
    applyRange(bench, R"({"kind": "logarithmic"})");
    QCOMPARE(bench.window.colouring().range().kind, ColourRange::Kind::logarithmic);
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

  void theMeshMayChangeUnderAnyMode() {
    Workbench bench;
    for (const char* mode : {"colourBy-stretch", "colourBy-length", "colourBy-violation", "colourBy-distance"}) {
      colourBy(bench, mode);
      for (const auto kind : {MeshKind::tetra, MeshKind::line}) {
        edits::replaceMesh(bench.document(), generate({kind, {6, 5, 4}, 1, {}}), QStringLiteral("other"),
                           QStringLiteral("build"));
        bench.settle();
        QVERIFY(bench.window.area().legend().isVisible());
      }
      bench.document().undoStack().undo();
      bench.settle();
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowColour)

}  // namespace chainmail::window_colour

#include "window_colour.moc"
