#include "document/panel_colour.h"

#include <array>

#include "common/text.h"

namespace chainmail {
namespace {

// Shares of the colour in its shades.
constexpr std::array shares{1.0, 0.58, 0.36, 0.2}, sharesOfGrey{1.0, 0.84, 0.74, 0.66};
constexpr int mostOfGrey = 64;  // HSV saturation, of 255

QColor mixed(const QColor& one, const QColor& other, double share) {
  const auto mix = [share](float a, float b) { return float(share * double(a) + (1 - share) * double(b)); };
  return QColor::fromRgbF(mix(one.redF(), other.redF()), mix(one.greenF(), other.greenF()),
                          mix(one.blueF(), other.blueF()));
}

/// Returns a shade with more contrast to the ground. Grey, which has almost the greatest contrast, gets less.
QRgb shade(const QColor& colour, bool onDark, int copy) {
  const bool grey = colour.hsvSaturation() < mostOfGrey;
  const QColor towards = onDark != grey ? Qt::white : Qt::black;
  return mixed(colour, towards, (grey ? sharesOfGrey : shares)[std::size_t(copy)]).rgb();
}

}  // namespace

colours::Colour algorithmColour(Algorithm algorithm, int copy) {
  const AlgorithmLook& own = info(algorithm).look;
  const AlgorithmLook& look = own.on_dark.empty() || own.on_light.empty() ? info(Algorithm::exact).look : own;
  return {shade(QColor(text(look.on_dark)), true, copy), shade(QColor(text(look.on_light)), false, copy)};
}

colours::Colour panelColour(const Document& document, int panel) {
  int copy = 0;
  for (int earlier = 0; earlier < panel; ++earlier) {
    copy += document.algorithm(earlier) == document.algorithm(panel) ? 1 : 0;
  }
  return algorithmColour(document.algorithm(panel), copy);
}

}  // namespace chainmail
