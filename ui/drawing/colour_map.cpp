#include "drawing/colour_map.h"

#include <algorithm>

namespace chainmail::colour_map {

namespace {

constexpr Stops onDark{{{72, 92, 232}, {60, 136, 208}, {36, 170, 205}, {80, 200, 140}, {165, 224, 84}, {253, 231, 37}}};
constexpr Stops onLight{{{50, 135, 240}, {60, 108, 215}, {66, 80, 186}, {72, 52, 152}, {72, 24, 115}, {52, 0, 66}}};
constexpr Stops differenceOnDark{
    {{150, 190, 255}, {84, 146, 222}, {58, 108, 180}, {165, 92, 30}, {218, 134, 44}, {246, 186, 104}}};
constexpr Stops differenceOnLight{
    {{0, 40, 100}, {20, 85, 155}, {62, 125, 190}, {190, 108, 40}, {150, 72, 5}, {88, 38, 0}}};

}  // namespace

const Stops& stops(colours::Ground ground) { return ground == colours::Ground::dark ? onDark : onLight; }

const Stops& differenceStops(colours::Ground ground) {
  return ground == colours::Ground::dark ? differenceOnDark : differenceOnLight;
}

QColor at(double share, colours::Ground ground) { return at(share, stops(ground)); }

QColor at(double share, const Stops& all) {
  const double along = std::clamp(share, 0.0, 1.0) * (all.size() - 1);
  const auto from = std::min(std::size_t(along), all.size() - 2);
  const double rest = along - double(from);
  const auto mixed = [&](std::size_t k) {
    return int(std::lround(all[from][k] + rest * (all[from + 1][k] - all[from][k])));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

const Stops& stopsOf(const ColourScale& scale) { return scale.diverging ? differenceStops() : stops(); }

double shareOf(float value, const ColourScale& scale) {
  if (scale.diverging) {
    const double side = std::abs(double(value < scale.centre ? scale.lowest : scale.highest) - double(scale.centre));
    return side > 0 ? std::clamp(0.5 + 0.5 * (double(value) - double(scale.centre)) / side, 0.0, 1.0) : 0.5;
  }
  const auto along = [&](float one) {
    return scale.logarithmic ? std::log(double(std::max(one, scale.lowest))) : double(one);
  };
  const double range = along(scale.highest) - along(scale.lowest);
  return range > 0 ? std::clamp((along(value) - along(scale.lowest)) / range, 0.0, 1.0) : 0;
}

QColor of(float value, const ColourScale& scale) {
  return scale.isNeutral(value) ? QColor(neutral) : at(shareOf(value, scale), stopsOf(scale));
}

}  // namespace chainmail::colour_map
