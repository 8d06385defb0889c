#pragma once

#include <ostream>

#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Writes Gmsh's .msh, version 4.1 in ASCII: a node an element, whose tag is its id + 1; triangles, quadrangles,
/// tetrahedra and hexahedra none of whose links is cut, and the other uncut links as lines, each dimension as one
/// discrete entity. Faces of five corners or more have no place there and are told by their links.
void write_msh(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
