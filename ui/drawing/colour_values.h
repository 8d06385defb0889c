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
  /// Range of the values, without those of cut links. `lowest` is greater than `highest` if there are no values.
  float lowest = 0, highest = 0;
  /// Unique number of this set of values; 0 before the first set.
  std::uint64_t number = 0;
};

/// The values at the two ends of the colour map. Values whose magnitude is at most the threshold are neutral.
struct ColourScale {
  float lowest = 0, highest = -1;
  float threshold = -1;    // -1: no value is neutral
  bool diverging = false;  // true for differences: 0 is in the middle of the map

  /// True if there are values. They are computed after a panel is painted for the first time.
  bool known() const { return lowest <= highest; }
  bool operator==(const ColourScale&) const = default;
};

}  // namespace chainmail
