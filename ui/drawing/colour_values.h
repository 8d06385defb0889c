#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// The values that colour an object: one per link or per element.
struct ColourValues {
  MeshPointer mesh;
  bool ofLinks = true;
  std::vector<float> values;
  /// Range of the values that count (cut links do not); lowest is above highest if none counts.
  float lowest = 0, highest = 0;
  /// Differs between any two sets of values; 0 before there are any.
  std::uint64_t number = 0;
};

/// The values at the two ends of the colour map. Values whose magnitude is at most the threshold are neutral.
struct ColourScale {
  float lowest = 0, highest = -1;
  float threshold = -1;    // -1: no value is neutral
  bool diverging = false;  // for a difference: 0 is in the middle

  /// True if there are values: painting a panel starts their computation.
  bool known() const { return lowest <= highest; }
  bool operator==(const ColourScale&) const = default;
};

}  // namespace chainmail
