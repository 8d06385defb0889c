#pragma once

#include <optional>
#include <span>
#include <vector>

namespace chainmail::report {

/// The smallest of some values that at least a share of them (above 0, up to 1) does not exceed: the nearest
/// rank, so that it is a value that occurred. There must be one.
double percentile(std::vector<double> values, double share);

/// A time at a size.
struct SizedTime {
  double elements = 0;
  double ms = 0;
};

/// How times grow: ms ∝ elements^exponent, by least squares over the logarithms.
struct Growth {
  double exponent = 0;
  double from = 0, to = 0;  // elements
  int sizes = 0;
};

/// Over the sizes of at least `from` elements whose time is above 0; nothing for fewer than three of them.
std::optional<Growth> growth_of(std::span<const SizedTime> times, double from);

}  // namespace chainmail::report
