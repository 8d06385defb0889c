#pragma once

#include "mesh/texture.h"

namespace chainmail {

/// A plane across an axis of the object at rest. What lies on its far side is
/// in front of it, and is taken away to show the inside.
struct SectionPlane {
  /// 0 x, 1 y, 2 z.
  int axis = 0;
  /// Where it stands along the axis (mesh units).
  double at = 0;
  /// Whether what is taken away lies below it, instead of beyond.
  bool flipped = false;

  /// How far in front of it a place at rest lies, negative behind it (mesh
  /// units).
  double before(const Point& rest) const { return flipped ? at - rest[axis] : rest[axis] - at; }
  bool operator==(const SectionPlane&) const = default;
};

}  // namespace chainmail
