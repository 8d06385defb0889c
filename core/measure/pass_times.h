#pragma once

#include <chrono>
#include <deque>

namespace chainmail {

/// The times of the passes of the last second.
class PassTimes {
 public:
  using Clock = std::chrono::steady_clock;

  struct Summary {
    double median_ms = 0;
    double worst_ms = 0;
    int passes = 0;
  };

  void add(Clock::time_point when, double milliseconds);
  /// What the second before `now` held.
  Summary summary(Clock::time_point now);

 private:
  void forget_before(Clock::time_point limit);

  struct Entry {
    Clock::time_point when;
    double milliseconds;
  };
  std::deque<Entry> entries_;
};

}  // namespace chainmail
