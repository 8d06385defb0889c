#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Returns, for each point, the id of the point that it is joined to: an earlier one that differs by at most
/// `tolerance` (mesh units) in every coordinate and is not joined itself, or its own id.
std::vector<ElementId> first_within(const std::vector<Point>& points, double tolerance);

/// Joins each point to the one that first_within() names. The other points keep their order. Returns the number of
/// points that are gone.
std::uint64_t join_close(MeshParts& parts, double tolerance);

/// Gives the corners of all pieces their new ids: `ids[e]` instead of e. The points stay.
void rename_elements(MeshParts& parts, const std::vector<ElementId>& ids);

/// Returns the largest extent of the points along an axis (mesh units).
double largest_extent(const MeshParts& parts);

}  // namespace chainmail
