#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace chainmail {

/// Times of the passes of the last second.
class PassTimes {
 public:
  using Clock = std::chrono::steady_clock;

  struct Summary {
    double median_ms = 0;
    double worst_ms = 0;
    int passes = 0;
  };

  PassTimes();
  void add(Clock::time_point when, double milliseconds);
  /// Returns the summary of the second before `now`.
  Summary summary(Clock::time_point now);
  void clear();

 private:
  void forget_before(Clock::time_point limit);

  struct Entry {
    Clock::time_point when;
    double milliseconds;
  };
  // Entries before first_ are too old. All memory is allocated at once, so that a pass allocates none.
  std::vector<Entry> entries_;
  std::size_t first_ = 0;
  std::vector<double> milliseconds_;
};

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
