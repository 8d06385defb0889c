#pragma once

#include <vector>

#include "drawing/mesh_level.h"
#include "mesh/surface.h"

namespace chainmail {

// The links and faces that are drawn, as ids of elements for the graphics card.

/// Links of a level that are drawn: their numbers, and the two ends of each.
struct DrawnLinks {
  std::vector<std::uint32_t> numbers;
  std::vector<ElementId> ends;
};

/// Returns the links of some clusters that are not cut.
DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters);

/// Returns three corners per face of some clusters, without faces that have a cut side.
std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters);

/// Returns the visible links of a volume: those on its surface, and those that are part of no cell.
DrawnLinks surfaceLinks(const Surface& surface, const Cuts& cuts);

/// Returns the corners of the triangles of the surface, and of the mesh's own triangles that are on no cell and have no
/// cut side.
std::vector<ElementId> surfaceFaces(const Surface& surface, const Cuts& cuts);

/// Returns all elements, or about `atMost` of them, evenly distributed.
std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost);

}  // namespace chainmail
