#pragma once

#include <cmath>

namespace chainmail {

/// How the range of a colour scale is chosen: from the values, as a fixed range, or from the values on a logarithmic
/// scale.
struct ColourRange {
  enum class Kind { automatic, fixed, logarithmic };
  static constexpr double limit = 1e6;         // of the magnitude of both ends
  static constexpr double smallestGap = 1e-4;  // between the ends

  Kind kind = Kind::automatic;
  double lowest = 0, highest = 1;  // of a fixed range

  /// True if a fixed range has finite ends in order. Every other kind is valid.
  bool valid() const {
    return kind != Kind::fixed || (std::abs(lowest) <= limit && std::abs(highest) <= limit &&
                                   highest - lowest >= smallestGap * 0.999);  // the ends are rounded
  }
  bool operator==(const ColourRange&) const = default;
};

}  // namespace chainmail
