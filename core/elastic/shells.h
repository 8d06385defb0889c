#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Splits triangles into surfaces that are connected along edges, and gives the triangles of each the same orientation.
/// Returns the indices of the triangles of each surface, ascending; surfaces are in the order of their first triangles.
/// Throws Error if a surface is open, cut open or one-sided, or if three triangles meet at an edge.
std::vector<std::vector<std::uint32_t>> part_into_shells(const Mesh& mesh, const Cuts& cuts,
                                                         std::vector<std::array<ElementId, 3>>& triangles);

/// Throws Error if the surface of triangles is open, or if three triangles meet at an edge. Cuts do not count.
void check_closed(const Mesh& mesh);

}  // namespace chainmail
