// The colour map: its ends, its lightness, and what stands for links where elements are drawn.

#include "colour_map.h"

#include <QTest>
#include <cmath>

#include "colour_values.h"
#include "colours.h"
#include "mesh/generate.h"

using namespace chainmail;

namespace {

double linear(int channel) {
  const double share = channel / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

/// CIE 1976 lightness, 0 to 100.
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
    QVERIFY(is(colour_map::at(0), colour_map::stops.front()));
    QVERIFY(is(colour_map::at(1), colour_map::stops.back()));
    QVERIFY(is(colour_map::at(-3), colour_map::stops.front()));
    QVERIFY(is(colour_map::at(7), colour_map::stops.back()));
    QVERIFY(is(colour_map::at(0.4), colour_map::stops[2]));  // the third of six
  }

  void itsLightnessGrowsAllTheWay() {
    for (int i = 1; i <= 50; ++i) {
      QVERIFY(lightness(colour_map::at(i / 50.0)) > lightness(colour_map::at((i - 1) / 50.0)));
    }
    QVERIFY(lightness(colour_map::at(1)) - lightness(colour_map::at(0)) > 45);
    QVERIFY(lightness(colour_map::at(0)) - lightness(colours::background) > 25);
  }
};

QTEST_GUILESS_MAIN(ColourMap)
#include "colour_map.moc"
