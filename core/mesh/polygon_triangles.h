#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Polygons with more corners are divided from their first corner, whatever their shape: dividing a concave one takes
/// time that grows with the square of its corners.
inline constexpr std::size_t max_concave_corners = 1000;

/// Divides a polygon into two triangles less than it has corners, and appends them. A convex polygon is a fan from its
/// first corner. From a concave one, ears are cut (Meisters 1975), so that no triangle is outside; it is seen along its
/// mean normal (Newell), so it may be slightly out of a plane. `at(i)` returns the position of its corner i.
void divide_polygon(std::span<const ElementId> corners, std::span<const Point> at,
                    std::vector<std::array<ElementId, 3>>& triangles);

}  // namespace chainmail
