#include "measure/time_spread.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

/// Returns the value below which a share of the sorted times lies, interpolated.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - double(below));
}

}  // namespace

TimeSpread spread_of(std::vector<double> times) {
  if (times.empty()) {
    return {};
  }
  std::sort(times.begin(), times.end());
  return {quantile(times, 0.5), quantile(times, 0.25), quantile(times, 0.75),
          times.front(),        times.back(),          static_cast<int>(times.size())};
}

}  // namespace chainmail
