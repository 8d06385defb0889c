#pragma once

#include <string>
#include <vector>

namespace chainmail::report {

/// A logarithmic axis over whole decades, with a place of its own for 0 where there is one.
///
/// Places run from 0, the axis' beginning, to 1, its end. Values below `smallest` count as 0, which stands
/// between the beginning and the first decade.
class LogAxis {
 public:
  LogAxis(const std::vector<double>& values, double smallest);

  /// Where a value stands; values beyond the axis stand at its ends.
  double place(double value) const;
  bool has_zero() const { return has_zero_; }
  /// Where the first decade begins: behind the place of 0.
  double first_decade() const { return has_zero_ ? behind_zero : 0; }

  struct Tick {
    double place;
    std::string label;
  };
  /// The decades, so many that they do not crowd, and 0.
  std::vector<Tick> ticks() const;

 private:
  static constexpr double of_zero = 0.05, behind_zero = 0.13;

  double smallest_;
  bool has_zero_ = false;
  int low_ = 0, high_ = 1, step_ = 1;  // decades
};

}  // namespace chainmail::report
