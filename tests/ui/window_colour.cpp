// Tests colour modes, their ranges and their legends in a real window.

#include <QBuffer>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLocale>
#include <QPainter>
#include <QSvgGenerator>

#include "document/edits.h"
#include "drawing/colour_map.h"
#include "measure/violation.h"
#include "panels/colour_range_menu.h"
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

/// Returns the most violated link of a panel.
LinkId worstLink(Workbench& bench, int panel) {
  LinkId worst = 0;
  for (LinkId link = 0; link < bench.document().mesh()->link_count(); ++link) {
    worst = violationOf(bench, panel, link) > violationOf(bench, panel, worst) ? link : worst;
  }
  return worst;
}

/// Returns how many pixels around the middle of a link, across it, are more like its colour than like the background.
int widthOf(Workbench& bench, int panel, LinkId link, QColor colour) {
  const auto& ends = bench.document().mesh()->links[link];
  const QPointF a = bench.view(panel).viewPosition(ends[0]), b = bench.view(panel).viewPosition(ends[1]);
  const QPointF across = QPointF(b.y() - a.y(), a.x() - b.x()) / std::hypot(b.x() - a.x(), b.y() - a.y());
  const QImage picture = bench.view(panel).grabFramebuffer();
  const auto apart = [](QColor one, QColor other) {
    return std::abs(one.red() - other.red()) + std::abs(one.green() - other.green()) +
           std::abs(one.blue() - other.blue());
  };
  int width = 0;
  for (int step = -20; step <= 20; ++step) {
    const QPointF at = ((a + b) / 2 + step * 0.25 * across) * bench.view(panel).devicePixelRatioF();
    const QColor there = picture.pixelColor(at.toPoint());
    width += apart(there, colour) < apart(there, colours::background) ? 1 : 0;
  }
  return width;
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

  void plainIsAsBeforeAndHasNoLegend() {
    Workbench bench;
    const QImage before = bench.view(0).grabFramebuffer();
    const QSize size = bench.view(0).size();
    colourBy(bench, "colourBy-shear");
    QVERIFY(bench.window.area().legend().isVisible());
    QVERIFY(bench.view(0).grabFramebuffer() != before);
    colourBy(bench, "colourBy-plain");
    QVERIFY(!bench.window.area().legend().isVisible() && !bench.window.panel(0).legend().isVisible());
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
    QVERIFY(bench.window.area().legend().isVisible());
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

  void lengthsOfNowAreComparedWithThoseAtRest() {
    Workbench bench;
    colourBy(bench, "colourBy-length");
    QVERIFY(bench.distanceFromColour(0, middleOf(bench, 0, 31, 32), colour_map::neutral) < alike);
    bench.dragFar();
    double off = 0;  // all links have length 1 at rest
    for (int p = 0; p < 2; ++p) {
      for (const auto& [a, b] : bench.document().mesh()->links) {
        off = std::max(off, std::abs((bench.position(p, a) - bench.position(p, b)).norm() - 1));
      }
    }
    QVERIFY(off > 0.1);
    QTRY_COMPARE(bench.window.panel(0).legend().highest(), shown(1 + off));
    QCOMPARE(bench.window.panel(1).legend().lowest(), shown(1 - off));
  }

  void violatedLinksAreThickerAndOverTheOthers() {
    Workbench bench;
    colourBy(bench, "colourBy-violation");
    edits::setPinned(bench.document(), {40}, true);
    const LinkId valid = *find_link(*bench.document().mesh(), 0, 1);
    const int before = widthOf(bench, 0, valid, colour_map::neutral);
    bench.dragFar();
    bench.settleFigures();
    const LinkId worst = worstLink(bench, 0);
    const int after = widthOf(bench, 0, worst, colour_map::at(1));
    QVERIFY2(after > before + 2, qPrintable(QStringLiteral("%1 %2").arg(before).arg(after)));
    QByteArray drawn;
    QBuffer buffer(&drawn);
    {
      const colours::OnGround light(colours::Ground::light);
      QSvgGenerator svg;
      svg.setOutputDevice(&buffer);
      QPainter painter(&svg);
      bench.view(0).drawIn(painter, Qt::white);
    }
    const QByteArray grey = QColor(colour_map::neutral.on(colours::Ground::light)).name().toLatin1();
    const qsizetype lastValid = drawn.lastIndexOf(QByteArray("stroke=\"").append(grey));
    QVERIFY(lastValid > 0);
    QVERIFY(drawn.indexOf("stroke-width=\"3.5\"") > lastValid);
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

  void linkedPanelsShareOneLegend() {
    Workbench bench;
    const auto shows = [&](int panel) { return bench.window.panel(panel).legend().isVisible(); };
    colourBy(bench, "colourBy-violation");
    QVERIFY(bench.window.area().legend().isVisible() && !shows(0) && !shows(1));
    QCOMPARE(bench.window.area().legend().title(), bench.window.panel(0).legend().title());
    colourBy(bench, "colourBy-distance");  // what is compared differs: the panels show it, without the map
    QVERIFY(bench.window.area().legend().isVisible() && shows(0) && shows(1));
    QVERIFY(bench.window.panel(0).legend().height() < bench.window.area().legend().height());
    bench.window.area().setAlone(0);
    bench.settleFigures();
    QVERIFY(!bench.window.area().legend().isVisible() && shows(0));
    bench.window.area().setAlone(std::nullopt);
    bench.trigger("linkColours");
    bench.settleFigures();
    QVERIFY(!bench.window.area().legend().isVisible() && shows(0) && shows(1));
    bench.trigger("linkColours");
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

  void aFixedRangeAroundACentreIsEquallyLongOnBothSides() {
    Workbench bench;
    colourBy(bench, "colourBy-length");  // 1 is the length at rest
    bench.trigger("colourRange-fixed");
    bench.find<QDoubleSpinBox>("colourRangeHighest")->setValue(1.5);
    bench.find<QDoubleSpinBox>("colourRangeLowest")->setValue(0.75);
    bench.settleFigures();
    const Legend& legend = bench.window.panel(0).legend();
    QCOMPARE(legend.lowest(), shown(0.5));
    QCOMPARE(legend.highest(), shown(1.5));
  }

  void theRangeIsRemembered() {
    {
      Workbench bench;
      colourBy(bench, "colourBy-violation");
      bench.trigger("colourRange-fixed");
      bench.find<QDoubleSpinBox>("colourRangeHighest")->setValue(0.5);
    }
    Workbench again;
    colourBy(again, "colourBy-violation");
    QCOMPARE(again.window.colouring().range().highest, 0.5);
    QSettings().setValue(QStringLiteral("colourRange/violation"),
                         QStringLiteral(R"({"kind": "fixed", "lowest": 2, "highest": 1})"));
    Workbench edited;
    QCOMPARE(edited.window.colouring().range(), ColourRange());
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

  void numbersOfTheLegendAreNeverShortened() {
    Workbench bench;
    colourBy(bench, "colourBy-stretch");
    bench.trigger("colourRange-fixed");
    bench.find<QDoubleSpinBox>("colourRangeHighest")->setValue(123.456);
    bench.find<QDoubleSpinBox>("colourRangeLowest")->setValue(-0.0123);
    bench.settleFigures();
    const Legend& legend = bench.window.area().legend();
    std::size_t most = 0;
    for (const int width : {1, 60, 120, 360}) {
      const auto ticks = legend.ticks(width);
      QCOMPARE(ticks.front().number, legend.lowest());
      QCOMPARE(ticks.back().number, legend.highest());
      double before = -1;
      for (std::size_t i = 1; i + 1 < ticks.size(); ++i) {  // the numbers between the ends are centred at their ticks
        const double at = ticks[i].share * width, half = legend.fontMetrics().horizontalAdvance(ticks[i].number) / 2.0;
        QVERIFY(at - half > before);
        before = at + half;
      }
      most = std::max(most, ticks.size());
    }
    QVERIFY(most >= 4);
    QCOMPARE(legend.ticks(1).size(), std::size_t{2});
  }

  void theLegendGrowsWithItsTexts() {
    Workbench bench;
    colourBy(bench, "colourBy-violation");
    const Legend& legend = bench.window.area().legend();
    const int usual = legend.height();
    QFont large = bench.window.area().font();
    large.setPointSizeF(2 * large.pointSizeF());
    bench.window.area().setFont(large);
    QVERIFY(legend.height() > usual);
    QCOMPARE(legend.height(), legend.wholeHeight());  // else its last line would be cut
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
