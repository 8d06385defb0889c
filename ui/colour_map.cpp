#include "colour_map.h"

#include <algorithm>
#include <cmath>

namespace chainmail::colour_map {

namespace {

constexpr Stops onDark{
    {{100, 92, 186}, {60, 119, 175}, {33, 145, 140}, {53, 183, 121}, {143, 215, 68}, {253, 231, 37}}};
constexpr Stops onLight{{{31, 154, 138}, {36, 126, 142}, {46, 98, 142}, {61, 70, 136}, {72, 36, 117}, {58, 0, 72}}};

}  // namespace

const Stops& stops(colours::Ground ground) { return ground == colours::Ground::dark ? onDark : onLight; }

QColor at(double share, colours::Ground ground) {
  const Stops& all = stops(ground);
  const double along = std::clamp(share, 0.0, 1.0) * (all.size() - 1);
  const auto from = std::min(std::size_t(along), all.size() - 2);
  const double rest = along - double(from);
  const auto mixed = [&](std::size_t k) {
    return int(std::lround(all[from][k] + rest * (all[from + 1][k] - all[from][k])));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

}  // namespace chainmail::colour_map
