#pragma once

#include <vector>

#include "drawing/mesh_level.h"
#include "mesh/surface.h"

namespace chainmail {

// The links and faces to draw, as ids of elements for the graphics card.

/// The links to draw: their numbers, and the two ends of each.
struct DrawnLinks {
  std::vector<std::uint32_t> numbers;
  std::vector<ElementId> ends;
};

/// Returns every `nth` of the uncut links of these clusters.
DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters,
                      std::size_t nth = 1);

/// Returns the corners of the faces of these clusters, three per face. Leaves out faces with a cut side.
std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters);

/// Returns every `nth` of the visible links of a volume: links on its surface, and uncut links that belong to no cell.
DrawnLinks surfaceLinks(const Surface& surface, const Cuts& cuts, std::size_t nth = 1);

/// Returns the corners of the triangles of the surface that no cut has revealed, and of the mesh's own triangles that
/// belong to no cell and have no cut side.
std::vector<ElementId> surfaceFaces(const Surface& surface, const Cuts& cuts);

/// Returns the corners of the triangles inside the uncut volume that cuts have made visible.
std::vector<ElementId> freshSurfaceFaces(const Surface& surface);

/// Returns all elements if there are at most `atMost`; otherwise about that many, evenly distributed.
std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost);

}  // namespace chainmail
