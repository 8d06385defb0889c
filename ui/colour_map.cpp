#include "colour_map.h"

#include <algorithm>
#include <cmath>

namespace chainmail::colour_map {

QColor at(double share) {
  const double along = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto from = std::min(std::size_t(along), stops.size() - 2);
  const double rest = along - double(from);
  const auto mixed = [&](std::size_t k) {
    return int(std::lround(stops[from][k] + rest * (stops[from + 1][k] - stops[from][k])));
  };
  return {mixed(0), mixed(1), mixed(2)};
}

}  // namespace chainmail::colour_map
