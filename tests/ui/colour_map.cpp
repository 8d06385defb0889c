// Tests the colour map: its ends, its lightness, and the colours of differences.

#include "drawing/colour_map.h"

#include <QTest>
#include <cmath>

#include "common/colours.h"
#include "drawing/colour_values.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::colour_map {

using colours::Ground;

namespace {

double linear(int channel) {
  const double share = channel / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

/// Returns the CIE 1976 lightness, 0 to 100.
double lightness(QColor colour) {
  const double y = 0.2126 * linear(colour.red()) + 0.7152 * linear(colour.green()) + 0.0722 * linear(colour.blue());
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

}  // namespace

class ColourMap : public QObject {
  Q_OBJECT

 private slots:
  void endsAtItsFirstAndLastColour() {
    const auto is = [](QColor colour, const std::array<int, 3>& stop) {
      return colour == QColor(stop[0], stop[1], stop[2]);
    };
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const auto& stops = colour_map::stops(ground);
      QVERIFY(is(colour_map::at(0, ground), stops.front()));
      QVERIFY(is(colour_map::at(1, ground), stops.back()));
      QVERIFY(is(colour_map::at(-3, ground), stops.front()));
      QVERIFY(is(colour_map::at(7, ground), stops.back()));
      QVERIFY(is(colour_map::at(0.4, ground), stops[2]));  // the third of six colours
    }
  }

  void itsLightnessLeavesTheGroundsAllTheWay() {
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const double away = ground == Ground::dark ? 1 : -1;
      const auto at = [&](double share) { return away * lightness(colour_map::at(share, ground)); };
      for (int i = 1; i <= 50; ++i) {
        QVERIFY(at(i / 50.0) > at((i - 1) / 50.0));
      }
      QVERIFY(at(1) - at(0) > 45);
      QVERIFY(at(0) - away * lightness(colours::background.on(ground)) > 25);
    }
  }

  /// Both sides of a difference have the same contrast to the ground, and blue is always the side below 0.
  void differencesStandOutBothWays() {
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const auto at = [&](double share) { return colour_map::at(share, colour_map::differenceStops(ground)); };
      double before = lightness(colours::background.on(ground));
      for (const double off : {0.1, 0.3, 0.5}) {  // the colours between these are linear
        const QColor below = at(0.5 - off), above = at(0.5 + off);
        QVERIFY(below.blue() > below.red() && above.red() > above.blue());
        QVERIFY(std::abs(lightness(below) - lightness(above)) < 5);  // neither side seems larger
        QVERIFY((lightness(below) - before) * (ground == Ground::dark ? 1 : -1) > 10);
        before = lightness(below);
      }
    }
  }
};

CHAINMAIL_TEST(ColourMap)

}  // namespace chainmail::colour_map

#include "colour_map.moc"
