#pragma once

#include <array>
#include <span>
#include <vector>

#include "files/formats/imported.h"

namespace chainmail {

/// Cells and faces of other programs that have no counterpart here, with their corners in the order of Gmsh (Geuzaine
/// and Remacle 2009): the corners first, then the middles of edges, of faces and of the cell. The number is that of
/// all.
enum class DividedKind {
  prism,
  pyramid,
  line3,
  triangle6,
  quadrangle8,
  quadrangle9,
  tetrahedron10,
  pyramid13,
  pyramid14,
  prism15,
  prism18,
  hexahedron20,
  hexahedron27,
  // Those that only VTK has, in its order:
  pentagonal_prism,
  hexagonal_prism,
  quadrangle6,   // of second order along its first and third edge
  triangle7,     // with a middle
  prism12,       // of second order around its triangles
  pyramid19,     // with middles of all faces, and of itself
  hexahedron24,  // with middles of its four upright faces
};

/// Returns the number of corners and middles.
constexpr std::size_t corner_count(DividedKind kind) {
  constexpr std::array<std::size_t, 20> counts{6,  5,  3,  6,  8,  9, 10, 13, 14, 15,  // in the order of kinds
                                               18, 20, 27, 10, 12, 6, 7,  12, 19, 24};
  return counts.at(std::size_t(kind));
}

/// Adds a cell or face in parts, and counts it. Prisms and pyramids become tetrahedra, and neighbours share the
/// diagonals of their sides (Dompierre et al. 1999). A cell or face of second order becomes several of first order,
/// whose elements are its corners and middles: hexahedra of 27 become hexahedra, other solids tetrahedra. Tetrahedra
/// get a positive volume.
void add_divided(ImportedMesh& mesh, DividedKind kind, std::span<const ElementId> corners);

/// Returns corners in another order. `order` begins with the place of each one, and is empty if they stay.
std::vector<ElementId> in_order(const std::vector<ElementId>& corners, std::span<const int> order);

}  // namespace chainmail
