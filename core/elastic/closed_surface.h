#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "elastic/kelvin.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Splits triangles into surfaces that are connected along edges, and gives the triangles of each the same orientation.
/// Returns the indices of the triangles of each surface, ascending; surfaces are in the order of their first triangles.
/// Throws Error if a surface is open, cut open or one-sided, or if three triangles meet at an edge.
std::vector<std::vector<std::uint32_t>> part_into_shells(const Mesh& mesh, const Cuts& cuts,
                                                         std::vector<std::array<ElementId, 3>>& triangles);

/// Throws Error if the surface of triangles is open, or if three triangles meet at an edge. Cuts do not count.
void check_closed(const Mesh& mesh);

/// An elastic solid, described by the surface that encloses it.
struct Solid {
  /// Corners of each triangle, counterclockwise as seen from outside the material. For a cavity, this is as seen from
  /// inside the cavity.
  std::vector<std::array<ElementId, 3>> triangles;
  /// The same triangles in the units of unit_position.
  std::vector<Facet> facets;
  /// The elements inside, ascending: corners of the volume's whole cells that are not corners of `triangles`.
  std::vector<ElementId> inner;
  std::vector<Point> inner_positions;  // in the units of unit_position
};

/// Returns the solids that a surface of triangles encloses, or those made of the whole cells of a volume. The triangles
/// may have any orientation. A surface inside another one is a cavity of its solid, and a surface inside a cavity is
/// again a solid. Throws Error if a surface is open, too large, one-sided or encloses nothing, if a triangle is flat,
/// or if three triangles meet at an edge. Throws Cancelled.
std::vector<Solid> enclosed_solids(const MeshPointer& mesh, const Cuts& cuts, const Progress& progress = {});

/// Returns the rest position of an element relative to the centre of the object's box, in units of the box diagonal. So
/// a surface far from the origin keeps its digits, and no power of a large coordinate overflows.
Point unit_position(const Mesh& mesh, ElementId element);

}  // namespace chainmail
