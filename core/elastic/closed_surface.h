#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "elastic/kelvin.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// An elastic solid by what encloses it.
struct Solid {
  /// Elements, as seen from outside the material, counterclockwise; in a cavity, that is from inside it.
  std::vector<std::array<ElementId, 3>> triangles;
  /// The same in the units of unit_position.
  std::vector<Facet> facets;
  /// The elements inside: corners of a volume's whole cells, and not of triangles. Ascending.
  std::vector<ElementId> inner;
  std::vector<Point> inner_positions;  // in these units
};

/// The solids that the triangles of a surface enclose, or those about the whole cells of a volume; whichever way the
/// triangles are turned. A surface within another is a cavity of its solid, one within a cavity a solid again. Throws
/// Error where they are open, too many, flat, where three meet at an edge, where a surface has one side alone or
/// encloses nothing; and Cancelled.
std::vector<Solid> enclosed_solids(const MeshPointer& mesh, const Cuts& cuts, const Progress& progress = {});

/// Where an element is at rest, from the middle of the object's box, whose diagonal is 1: a surface far from the origin
/// keeps its digits, and a large one no power that overflows.
Point unit_position(const Mesh& mesh, ElementId element);

}  // namespace chainmail
