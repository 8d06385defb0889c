// Tests the colour map: its ends, its lightness, the colours of differences, and what all eyes tell apart.

#include "drawing/colour_map.h"

#include <QTest>
#include <cmath>

#include "colour_vision.h"
#include "common/colours.h"
#include "document/panel_colour.h"
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

  /// 3 is the contrast of marks (WCAG 2.1, 1.4.11).
  void everyLinkStandsOutFromTheGround() {
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const QColor behind = colours::background.on(ground);
      QVERIFY(colours::contrast(neutral.on(ground), behind) >= 3);
      for (const Stops& stops : {colour_map::stops(ground), colour_map::differenceStops(ground)}) {
        for (const auto& [red, green, blue] : stops) {
          QVERIFY(colours::contrast(QColor(red, green, blue), behind) >= 3);
        }
      }
    }
  }

  /// The scale of violation begins at a hue that all eyes tell apart from the grey of valid links.
  void allEyesTellViolatedLinksFromValidOnes() {
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const QColor valid = neutral.on(ground);
      QVERIFY(colour_vision::leastDistance(colour_map::at(0, ground), valid) >= 50);
      for (int i = 0; i <= 100; ++i) {
        QVERIFY(colour_vision::leastDistance(colour_map::at(i / 100.0, ground), valid) >= 21);
      }
    }
  }

  void noColourOfTheScaleIsThatOfPins() {
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const QColor pin = colours::pinned.on(ground);
      QVERIFY(colour_vision::leastDistance(colour_map::at(1, ground), pin) >= 28);
      for (int i = 0; i <= 100; ++i) {
        QVERIFY(colour_vision::leastDistance(colour_map::at(i / 100.0, ground), pin) >= 19);
      }
      QVERIFY(colour_vision::leastDistance(neutral.on(ground), pin) >= 15);
    }
  }

  void aLogarithmicScaleHasEqualRatiosEquallyFarApart() {
    ColourScale scale;
    scale.lowest = 0.001F;
    scale.highest = 10;
    scale.logarithmic = true;
    QVERIFY(std::abs(shareOf(0.1F, scale) - 0.5) < 1e-6);
    QCOMPARE(shareOf(0, scale), 0.0);
    QCOMPARE(shareOf(20, scale), 1.0);
    scale.logarithmic = false;
    QVERIFY(std::abs(shareOf(0.1F, scale) - 0.0099) < 1e-4);
  }

  /// Values around 1, such as lengths divided by rest lengths.
  void neutralValuesAreThoseNearTheCentre() {
    ColourScale scale{0.5F, 1.5F, 0.01F, 1, true};
    QVERIFY(scale.isNeutral(1.005F) && !scale.isNeutral(0) && !scale.isNeutral(1.02F));
    QCOMPARE(shareOf(1, scale), 0.5);
  }

  /// Also if the window adapts them to the ground, and for eyes without red or green cones. See the table of
  /// algorithms.
  void allEyesTellAlgorithmsApart() {
    using colour_vision::distance, colour_vision::leastDistance;
    double usual = 1000, any = 1000;
    for (const Ground ground : {Ground::dark, Ground::light}) {
      const auto all = every_algorithm();
      for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const QColor one = algorithmColour(all[i].algorithm).on(ground);
          const QColor other = algorithmColour(all[j].algorithm).on(ground);
          usual = std::min(usual, distance(one, other));
          any = std::min(any, leastDistance(one, other));
        }
      }
      QVERIFY(leastDistance(algorithmColour(Algorithm::generalized).on(ground),
                            algorithmColour(Algorithm::linear_fem).on(ground)) >= 24);
    }
    QVERIFY2(usual >= 24, qPrintable(QString::number(usual)));
    QVERIFY2(any >= 9.5, qPrintable(QString::number(any)));
  }
};

CHAINMAIL_TEST(ColourMap)

}  // namespace chainmail::colour_map

#include "colour_map.moc"
