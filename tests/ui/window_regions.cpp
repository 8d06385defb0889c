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

  void upToEightSelectedElementsHaveTheirs() {
    Workbench bench;
    bench.trigger("showValidRegions");
    const auto note = [&] { return bench.find<QLabel>("state0")->toolTip(); };
    QTRY_VERIFY(note().contains(QStringLiteral("point at an element")));
    bench.document().selection().set({0, 1, 2, 3, 4, 5, 6, 7});
    QTRY_VERIFY2(!note().contains(QStringLiteral("point at")) && !note().contains(QStringLiteral("shown for up to")),
                 qPrintable(note()));
    bench.document().selection().set({0, 1, 2, 3, 4, 5, 6, 7, 8});
    QTRY_VERIFY2(note().contains(QStringLiteral("shown for up to 8 selected elements")), qPrintable(note()));
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
