#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// The values that colour an object: one per link or per element.
struct ColourValues {
  MeshPointer mesh;
  bool ofLinks = true;
  std::vector<float> values;
  /// For values of links in space: for each element the one of its links that is furthest from the centre, which
  /// colours the faces. Otherwise empty.
  std::vector<float> atElements;
  /// Range of the values, without those of cut links. `lowest` is greater than `highest` if there are no values.
  float lowest = 0, highest = 0;
  /// Unique number of this set of values; 0 before the first set.
  std::uint64_t number = 0;
};

/// The values at the two ends of the colour map. Values that differ from the centre by at most the threshold are
/// neutral.
struct ColourScale {
  float lowest = 0, highest = -1;
  float threshold = -1;  // -1: no value is neutral
  float centre = 0;
  bool diverging = false;    // true for differences: the centre is in the middle of the map, with a range on each side
  bool logarithmic = false;  // true if equal ratios of values are equally far apart; `lowest` is positive then

  /// True if there are values. They are computed after a panel is painted for the first time.
  bool known() const { return lowest <= highest; }
  bool isNeutral(float value) const { return std::abs(value - centre) <= threshold; }
  bool operator==(const ColourScale&) const = default;
};

}  // namespace chainmail
