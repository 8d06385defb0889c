#pragma once

#include <optional>

#include "body/positions.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Returns the largest principal stretch of any cell: the largest factor by which a direction in it is lengthened,
/// which is the largest singular value of its deformation gradient. 1 for an object at rest or moved rigidly. Cells are
/// tetrahedra, the corners of hexahedra, or faces; on a line, and without cells and faces, it is none. Cells that are
/// flat at rest do not count.
std::optional<double> largest_principal_stretch(const Mesh& mesh, const PositionView& positions);

}  // namespace chainmail
