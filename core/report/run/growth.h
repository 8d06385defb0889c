#pragma once

#include <optional>
#include <span>
#include <vector>

namespace chainmail::report {

/// Returns the smallest value that is not below a share (above 0, up to 1) of the values: the nearest rank, which is
/// one of the values. There must be a value.
double percentile(std::vector<double> values, double share);

/// A time at a size.
struct SizedTime {
  double elements = 0;
  double ms = 0;
};

/// Growth of times: ms ∝ elements^exponent, by least squares over the logarithms.
struct Growth {
  double exponent = 0;
  double from = 0, to = 0;  // elements
  int sizes = 0;
};

/// Returns the growth over the sizes of at least `from` elements with a time above 0; nothing for fewer than three
/// sizes.
std::optional<Growth> growth_of(std::span<const SizedTime> times, double from);

}  // namespace chainmail::report
