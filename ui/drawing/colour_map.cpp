#include "drawing/colour_map.h"

#include <algorithm>
#include <cmath>

namespace chainmail::colour_map {

namespace {

constexpr Stops onDark{
    {{100, 92, 186}, {60, 119, 175}, {33, 145, 140}, {53, 183, 121}, {143, 215, 68}, {253, 231, 37}}};
constexpr Stops onLight{{{31, 154, 138}, {36, 126, 142}, {46, 98, 142}, {61, 70, 136}, {72, 36, 117}, {58, 0, 72}}};
constexpr Stops differenceOnDark{
    {{150, 215, 255}, {72, 140, 205}, {52, 78, 108}, {108, 78, 46}, {205, 125, 35}, {255, 205, 120}}};
constexpr Stops differenceOnLight{
    {{0, 45, 105}, {25, 95, 165}, {120, 152, 185}, {185, 145, 105}, {160, 82, 10}, {88, 38, 0}}};

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

QColor of(float value, const ColourScale& scale) {
  if (std::abs(value) <= scale.threshold) {
    return neutral;
  }
  const float range = scale.highest - scale.lowest;
  return at(range > 0 ? double((value - scale.lowest) / range) : 0, stopsOf(scale));
}

}  // namespace chainmail::colour_map
