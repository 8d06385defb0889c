#pragma once

#include <optional>
#include <vector>

#include "body/body.h"
#include "mesh/split.h"

namespace chainmail {

/// A line of points that is swept both ways along a direction, and cuts through an object.
struct Blade {
  std::vector<Point> line;          // two or more (mesh units), where the elements are at present
  std::optional<Point> along = {};  // of any length; without it, the direction across the plane of the object
};

/// A line has at most this many points: each edge of the object is compared with all segments.
inline constexpr std::size_t blade_point_limit = 10'000;

/// Throws Error if an object has neither cells nor faces that can be split, and if the line or the direction is not one
/// for this object.
void check(const Blade& blade, const Mesh& mesh);

/// Returns the split along a blade: of the cells of an object, or of its faces if it has no cells. Null if nothing
/// comes apart. Links that are neither an edge of a cell nor a side of a face stay. Throws Error as check() does.
SplitPointer split_along(const Blade& blade, const Body& body);

}  // namespace chainmail
