#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// What an object is coloured by: a number for each of its links or of its elements.
struct ColourValues {
  MeshPointer mesh;
  bool ofLinks = true;
  std::vector<float> values;
  /// Of those that count; lowest above highest where none does.
  float lowest = 0, highest = 0;
  /// Others have another number; never 0.
  std::uint64_t number = 0;
};

/// The values at the two ends of the colour map. What is no larger than the threshold, whatever its sign, is neutral.
struct ColourScale {
  float lowest = 0, highest = -1;
  float threshold = -1;    // no magnitude is below 0: none is
  bool diverging = false;  // a difference: 0 lies in the middle

  /// Whether there are values; they are worked out when a panel is painted.
  bool known() const { return lowest <= highest; }
  bool operator==(const ColourScale&) const = default;
};

}  // namespace chainmail
