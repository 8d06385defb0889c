#pragma once

#include <cstddef>
#include <optional>

#include "files/formats/divided_cells.h"

namespace chainmail {

/// A type of element of Gmsh (Geuzaine and Remacle 2009).
struct MshType {
  int number;
  std::size_t corners;
  std::optional<DividedKind> divided;  // of types that have no counterpart here
};

/// Returns the type with this number, or null if it is of higher order or uncommon.
const MshType* msh_type(int number);

}  // namespace chainmail
