// Tests the valid regions about an element in a real window.

#include <QAction>
#include <QLabel>

#include "common/colours.h"
#include "document/edits.h"
#include "measure/neighbour_regions.h"
#include "window.h"

namespace chainmail::window_regions {

namespace {

constexpr ElementId middle = 31;  // of 9 x 7
constexpr int alike = 60;         // of 255: a line of one or two pixels is blended with the background

}  // namespace

class WindowRegions : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void validRegionsStandAboutTheElementUnderTheCursor() {
    Workbench bench;
    const QImage without = bench.view(0).grabFramebuffer();
    QTest::keyClick(&bench.window, Qt::Key_V);
    QVERIFY(bench.find<QAction>("showValidRegions")->isChecked());
    QTRY_VERIFY(bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("point at an element")));
    bench.document().highlight().set({middle, false, {}});
    for (int p = 0; p < bench.document().panels(); ++p) {
      for (const auto& region : regionsAbout(bench, p, middle)) {
        QVERIFY(region.inside);
        QVERIFY(bench.distanceFromColour(p, corner(bench, p, region), colours::inside) < alike);
      }
    }
    bench.document().highlight().set({});
    QTest::keyClick(&bench.window, Qt::Key_V);
    QTRY_VERIFY(!bench.find<QLabel>("state0")->toolTip().contains(QStringLiteral("regions")));
    QCOMPARE(bench.view(0).grabFramebuffer(), without);
  }

  void whatLiesOutsideIsMarkedSo() {
    Workbench bench;
    edits::setPinned(bench.document(), {middle + 1}, true);
    bench.document().handle().grab(middle);
    bench.document().handle().drag(bench.document().mesh()->rest_position(middle) + Point(-1.5, 0, 0));
    bench.document().handle().release();
    bench.settle();
    bench.trigger("showValidRegions");
    bench.document().highlight().set({middle, false, {}});
    for (int p = 0; p < bench.document().panels(); ++p) {
      const auto regions = regionsAbout(bench, p, middle);
      const auto pinned =
          std::find_if(regions.begin(), regions.end(), [](auto& r) { return r.neighbour == middle + 1; });
      QVERIFY(!pinned->inside);
      // The line that connects it to its region.
      const Point half = (pinned->at + pinned->nearest) / 2;
      QVERIFY(bench.distanceFromColour(p, bench.view(p).viewPosition(half), colours::outside) < alike);
    }
  }

  void regionsAreDrawnOfFewSelectedElementsAndInEveryDimension() {
    for (const auto& mesh :
         {generate({MeshKind::line, {6, 1, 1}, 1, {}}), generate({MeshKind::block, {3, 3, 3}, 1, {}})}) {
      Workbench bench(mesh);
      const QImage without = bench.view(1).grabFramebuffer();
      bench.trigger("showValidRegions");
      bench.document().selection().set({1, 2});
      for (const auto& region : regionsAbout(bench, 1, 1)) {
        const QPointF at =
            mesh->space_dimension == 1 ? bench.view(1).viewPosition(region.low) : corner(bench, 1, region);
        QVERIFY(bench.distanceFromColour(1, at, colours::inside) < alike);
      }
      bench.document().selection().set({});
      QCOMPARE(bench.view(1).grabFramebuffer(), without);
    }
  }

  void aLensMagnifiesSmallRegionsInAPlane() {
    Workbench bench(generate({MeshKind::grid, {61, 61, 1}, 1, {}}));
    bench.trigger("showValidRegions");
    bench.document().highlight().set({});
    const QImage without = bench.view(0).grabFramebuffer();
    bench.document().highlight().set({30 * 61 + 30, false, {}});
    QVERIFY(differenceOf(without, bench.view(0).grabFramebuffer()).width() > 150);  // more than the regions themselves
    bench.document().highlight().set({});
    bench.document().selection().set({30 * 61 + 30});
    QVERIFY(differenceOf(without, bench.view(0).grabFramebuffer()).width() < 100);  // a lens belongs to the cursor
  }

  void regionsFollowTheSoftnessOfTheirLink() {
    Workbench bench;
    bench.trigger("showValidRegions");
    bench.document().highlight().set({middle, false, {}});
    const Point edge = Point(5.2, 2.9, 0);  // a corner of the region for the global softness
    QVERIFY(bench.distanceFromColour(0, bench.view(0).viewPosition(edge), colours::inside) < alike);
    edits::setSoftnessOf(bench.document(), {*find_link(*bench.document().mesh(), middle, middle + 1)},
                         LinkSoftness{1, 1.5, 0.3});
    bench.settle();
    bench.document().highlight().set({middle, false, {}});  // again, because the cursor may be over the window
    QVERIFY(bench.distanceFromColour(0, bench.view(0).viewPosition(edge), colours::inside) > alike);
    QVERIFY(bench.distanceFromColour(0, bench.view(0).viewPosition(Point(5.5, 2.7, 0)), colours::inside) < alike);
  }

 private:
  static std::vector<NeighbourRegion> regionsAbout(Workbench& bench, int panel, ElementId element) {
    const Document& document = bench.document();
    return neighbour_regions(*document.mesh(), *document.wholeSoftness(), document.cuts(),
                             document.solvers().frame(panel)->view(), element, 100);
  }
  /// Returns the rectangle that encloses all differences of two pictures, in pixels.
  static QRect differenceOf(const QImage& one, const QImage& other) {
    QRect different;
    for (int y = 0; y < one.height(); ++y) {
      for (int x = 0; x < one.width(); ++x) {
        different |= one.pixel(x, y) == other.pixel(x, y) ? QRect() : QRect(x, y, 1, 1);
      }
    }
    return different;
  }
  static QPointF corner(Workbench& bench, int panel, const NeighbourRegion& region) {
    return bench.view(panel).viewPosition(region.low);
  }
};

CHAINMAIL_WINDOW_TEST(WindowRegions)

}  // namespace chainmail::window_regions

#include "window_regions.moc"
