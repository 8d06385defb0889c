#pragma once

#include <optional>
#include <span>
#include <vector>

namespace chainmail::report {

/// Returns the smallest of the values that at least `share` (above 0, up to 1) of them do not exceed (nearest rank).
/// There must be at least one value.
double percentile(std::vector<double> values, double share);

/// A time for an object of a given size.
struct SizedTime {
  double elements = 0;
  double ms = 0;
};

/// Growth of times: ms ∝ elements^power, by least squares over the logarithms.
struct Growth {
  double power = 0;
  double from = 0, to = 0;  // range of sizes (elements)
  int sizes = 0;
};

/// Smallest number of elements of the objects from which reports fit growth. In smaller ones, the fixed cost of a pass
/// is too large a part of the time.
inline constexpr double growth_from = 1000;

/// Returns the growth over the sizes that have at least `from` elements and a time above 0; none if these are fewer
/// than three.
std::optional<Growth> growth_of(std::span<const SizedTime> times, double from);

}  // namespace chainmail::report
