#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/positions.h"
#include "mesh/mesh.h"

namespace chainmail {

/// A set of points, with triangles between them if it is a surface (mesh units).
struct PointSurface {
  std::vector<Point> points;
  std::vector<std::array<ElementId, 3>> triangles;
};

/// Returns the outer surface of a deformed object: its faces, or the visible sides of its cells, with their corners. An
/// object without faces and cells is the set of its elements. Cuts do not matter.
PointSurface surface_of(const Mesh& mesh, const PositionView& positions);

/// Returns the Hausdorff distance of two surfaces, in mesh units: the largest distance from a point of one to the
/// nearest point of the other, taken both ways over the points that are given. 0 if one of them is empty.
///
/// The distance from a point to a triangle is exact (Ericson 2005, 5.1.5). Triangles are in a tree of boxes, so that
/// 100,000 elements take a fraction of a second.
double hausdorff_distance(const PointSurface& one, const PointSurface& other);

/// Returns the same for two states of an object, in its mean rest lengths.
double hausdorff_distance(const Mesh& mesh, const PositionView& one, const PositionView& other);

}  // namespace chainmail
