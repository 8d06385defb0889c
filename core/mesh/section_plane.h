#pragma once

#include "mesh/texture.h"

namespace chainmail {

/// A plane across an axis of the object at rest. The part in front of it is hidden, to show the inside.
struct SectionPlane {
  /// 0 x, 1 y, 2 z.
  int axis = 0;
  /// Position on the axis (mesh units).
  double at = 0;
  /// True if the hidden part is below the plane instead of above it.
  bool flipped = false;

  /// Returns the distance of a rest position in front of the plane, negative behind it (mesh units).
  double before(const Point& rest) const { return flipped ? at - rest[axis] : rest[axis] - at; }
  bool operator==(const SectionPlane&) const = default;
};

}  // namespace chainmail
