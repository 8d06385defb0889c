#pragma once

#include <cstdint>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Smallest number of elements of a simplified surface: a tetrahedron has 4 corners.
inline constexpr std::uint64_t fewest_simplified = 4;

/// Returns a surface with this number of elements, by CGAL in the import program: it collapses edges, those that change
/// the shape least first (Lindstrom and Turk 1998). Faces become triangles, links are their edges, and a closed surface
/// stays closed. The elements at borders and at edges of more than two faces stay where they are. The result depends on
/// the arguments only.
///
/// Throws Error about the `elements` if the surface has no more than that or if there are fewer than 4; about the
/// `surface` if it has cells, elements that belong to no face, or too many elements, or if it cannot have so few; and
/// Cancelled.
MeshPointer simplify(const Mesh& surface, std::uint64_t elements, const Progress& progress = {});

}  // namespace chainmail
