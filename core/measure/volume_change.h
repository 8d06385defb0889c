#pragma once

#include <optional>

#include "body/positions.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Returns the volume of a deformed object (mesh units to the power 3): of its cells, or of what its faces enclose. In
/// a plane it is the area of its faces. Cells and faces count with the sign that they have at rest: a part that is
/// turned inside out counts negative. None for an object without cells and faces, and for faces in space that are not
/// closed.
std::optional<double> volume_of(const Mesh& mesh, const PositionView& positions);

/// Returns the change of the volume, relative to that at rest: −0.1 if a tenth is lost. None where volume_of has none,
/// or if the volume at rest is 0.
std::optional<double> volume_change(const Mesh& mesh, const PositionView& positions);

}  // namespace chainmail
