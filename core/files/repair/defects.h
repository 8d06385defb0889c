#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// The defects of a mesh that can be repaired, with the elements that they concern.
///
/// Holes and edges are those of the faces, so an object of cells has none. Holes are found as if duplicates were one
/// element: a seam between two rows of duplicates is not a hole. Their ids are the lowest ones at their positions.
struct Defects {
  /// Elements at exactly the position of an element with a lower id; ascending.
  std::vector<ElementId> duplicates;
  /// Loose elements (see loose_elements), ascending.
  std::vector<ElementId> loose;
  /// The elements around each hole, in order.
  std::vector<std::vector<ElementId>> holes;
  /// Edges of more than two faces.
  std::vector<std::array<ElementId, 2>> non_manifold;
  /// Cells that are inside out while others are not: tetrahedra by their index, then hexahedra.
  std::vector<std::uint32_t> inverted;
  /// Number of closed borders that are not holes but the outline of an open surface, like that of a cloth.
  std::size_t outlines = 0;

  bool empty() const {
    return duplicates.empty() && loose.empty() && holes.empty() && non_manifold.empty() && inverted.empty();
  }
  /// Number of edges around all holes.
  std::size_t hole_edges() const;
};

/// Finds the defects of a mesh at rest. Throws Cancelled.
///
/// A closed border of the faces is a hole if it is short compared with the connected faces that it belongs to: its
/// length squared is below 6 times their area. A half sphere without its cap has 2π, a flat disc 4π, a square sheet 16
/// and a cube without one side 3.2.
Defects find_defects(const Mesh& mesh, const Progress& progress = {});

/// Describes each kind of defect that occurs: '3 duplicate vertices', '12 loose points', '2 holes (14 edges)',
/// '1 non-manifold edge', '5 cells inside out'.
std::vector<std::string> in_words(const Defects& defects);

/// Returns for each element whether it is loose: without links, faces and cells, in a mesh with links.
std::vector<bool> loose_elements(const Mesh& mesh);

/// Returns the triangles of a mesh with duplicates as one element (see first_at_position), without those that then use
/// an element twice.
std::vector<std::array<ElementId, 3>> joined_triangles(const Mesh& mesh, const std::vector<ElementId>& first);

}  // namespace chainmail
