#pragma once

#include <vector>

#include "drawing/mesh_level.h"
#include "mesh/surface.h"

namespace chainmail {

/// What to draw of a mesh, as elements' ids for the graphics card.

/// The links of a level that are drawn: their numbers, and the two ends of each.
struct DrawnLinks {
  std::vector<std::uint32_t> numbers;
  std::vector<ElementId> ends;
};

/// Those of some cells that are not cut.
DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& cells);

/// The three corners of every face of some cells none of whose sides is cut.
std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& cells);

/// Those of a volume that can be seen: on its surface, or in no cell.
DrawnLinks surfaceLinks(const Surface& surface, const Cuts& cuts);

/// The corners of the surface's triangles, and of the mesh's own that lie on no cell, where no side is cut.
std::vector<ElementId> surfaceFaces(const Surface& surface, const Cuts& cuts);

/// All of the elements, or about `atMost` of them, spread evenly.
std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost);

}  // namespace chainmail
