#include "document/panel_colour.h"

#include <algorithm>
#include <array>

#include "common/text.h"

namespace chainmail {
namespace {

constexpr double leastContrast = 4.55;  // of text: 4.5 (WCAG 2.1, 1.4.3), and room for rounding
constexpr colours::Colour window(0xff242930, 0xffeceef1), grey(0xffd4dae2, 0xff3c444e);

// Shares of the colour in its shades. Grey on a dark ground is almost white already: its shades are darker.
constexpr std::array shares{1.0, 0.58, 0.36, 0.2}, sharesOfLightGrey{1.0, 0.8, 0.74, 0.68};

/// Returns the colour, lighter on a dark ground and darker on a light one until text can be read.
QColor readable(const QColor& colour, colours::Ground ground) {
  const double step = ground == colours::Ground::dark ? 0.01 : -0.01;
  const QColor own = colour.toHsl();
  QColor one = own;
  for (double lightness = own.lightnessF(); colours::contrast(one, window.on(ground)) < leastContrast;
       lightness += step) {
    one = QColor::fromHslF(own.hslHueF(), own.hslSaturationF(), float(std::clamp(lightness, 0.0, 1.0)));
  }
  return one;
}

QColor mixed(const QColor& one, const QColor& other, double share) {
  const auto mix = [share](float a, float b) { return float(share * double(a) + (1 - share) * double(b)); };
  return QColor::fromRgbF(mix(one.redF(), other.redF()), mix(one.greenF(), other.greenF()),
                          mix(one.blueF(), other.blueF()));
}

QRgb shade(std::string_view name, colours::Ground ground, int copy) {
  const bool dark = ground == colours::Ground::dark, lightGrey = dark && name.empty();
  const QColor colour = name.empty() ? grey.on(ground) : readable(QColor(text(name)), ground);
  return mixed(colour, dark && !lightGrey ? Qt::white : Qt::black,
               (lightGrey ? sharesOfLightGrey : shares)[std::size_t(copy)])
      .rgb();
}

}  // namespace

colours::Colour algorithmColour(Algorithm algorithm, int copy) {
  const std::string_view name = info(algorithm).style.colour;
  return {shade(name, colours::Ground::dark, copy), shade(name, colours::Ground::light, copy)};
}

colours::Colour panelColour(const Document& document, int panel) {
  int copy = 0;
  for (int earlier = 0; earlier < panel; ++earlier) {
    copy += document.algorithm(earlier) == document.algorithm(panel) ? 1 : 0;
  }
  return algorithmColour(document.algorithm(panel), copy);
}

}  // namespace chainmail
