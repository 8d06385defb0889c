#pragma once

#include <ostream>

#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Writes .msh of Gmsh, version 4.1 in ASCII: one node per element, with tag id + 1; the triangles, quadrangles,
/// tetrahedra and hexahedra without a cut link; the other uncut links as lines. Each dimension is one discrete entity.
/// The format has no faces of five or more corners: their links are written as lines.
void write_msh(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
