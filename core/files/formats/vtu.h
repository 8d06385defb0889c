#pragma once

#include <ostream>

#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Writes a VTK XML UnstructuredGrid: one point per element; as cells, the faces, tetrahedra and hexahedra without a
/// cut link, and the other uncut links. Points have two fields: `displacement` from rest (3 components, mesh units) and
/// `violation`, the largest violation of the uncut links of the element (in rest lengths).
///
/// Numbers are written in base64, so that they read back exactly.
void write_vtu(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
