#pragma once

#include <vector>

namespace chainmail {

/// Spread of times (ms) over repetitions. Quartiles are interpolated between the two nearest times.
struct TimeSpread {
  double median = 0;
  double lower_quartile = 0;
  double upper_quartile = 0;
  double min = 0;
  double max = 0;
  int count = 0;

  bool operator==(const TimeSpread&) const = default;
};
TimeSpread spread_of(std::vector<double> times);

}  // namespace chainmail
