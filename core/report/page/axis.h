#pragma once

#include <string>
#include <vector>

namespace chainmail::report {

/// A labelled position on an axis.
struct Tick {
  double position = 0;
  std::string label;
  bool is_zero = false;  // the position of 0 on a logarithmic axis
};

/// A value with its label, for the ticks of a linear axis.
struct LabelledValue {
  double value = 0;
  std::string label;
};

/// Maps values to positions along an axis, from 0 at its beginning to 1 at its end.
class Axis {
 public:
  /// Returns a logarithmic axis over the decades of `values`. Values below `smallest` count as 0. If there are any, 0
  /// has its own position between the beginning and the first decade. Values beyond the axis are drawn at its ends.
  static Axis logarithmic(const std::vector<double>& values, double smallest);
  /// Returns a linear axis. Values beyond it have positions below 0 or above 1.
  static Axis linear(double low, double high, const std::vector<LabelledValue>& ticks);
  /// Returns a linear axis from 0 to 1, 2 or 5 times a power of ten, with ticks at both ends and in the middle.
  static Axis from_zero_to(double highest);

  double position(double value) const;
  /// Returns the ticks, few enough that their labels do not overlap.
  const std::vector<Tick>& ticks() const { return ticks_; }
  bool has_zero() const { return has_zero_; }
  /// Returns the position of the first decade. It comes after that of 0.
  double first_decade() const { return has_zero_ ? behind_zero : 0; }

 private:
  static constexpr double of_zero = 0.05, behind_zero = 0.13;

  bool is_logarithmic_ = false, has_zero_ = false;
  double smallest_ = 0;
  double low_ = 0, high_ = 1;  // values; for a logarithmic axis their decades
  std::vector<Tick> ticks_;
};

}  // namespace chainmail::report
