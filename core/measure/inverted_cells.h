#pragma once

#include <cstdint>
#include <optional>

#include "body/positions.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Returns the number of cells that are turned inside out, or flat: a tetrahedron whose volume no longer has the sign
/// that it has at rest, a hexahedron with such a corner, and in a plane a face. None for an object that has no such
/// cells: a surface in space has no inside.
std::optional<std::uint64_t> inverted_cells(const Mesh& mesh, const PositionView& positions);

}  // namespace chainmail
