#pragma once

#include <cstddef>
#include <optional>

#include "files/formats/divided_cells.h"

namespace chainmail {

/// Gmsh's numbers of the types of elements that have a counterpart here (Geuzaine and Remacle 2009).
enum MshNumber { msh_line = 1, msh_triangle, msh_quadrangle, msh_tetrahedron, msh_hexahedron, msh_point = 15 };

/// A type of element of Gmsh.
struct MshType {
  int number;
  std::size_t corners;                 // with the middles
  std::optional<DividedKind> divided;  // of types that have no counterpart here
};

/// Returns the type with this number, or null if it is of higher order or uncommon.
const MshType* msh_type(int number);

}  // namespace chainmail
