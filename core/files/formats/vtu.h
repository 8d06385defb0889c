#pragma once

#include <ostream>

#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Writes a VTK XML UnstructuredGrid: every element a point; as cells the faces, tetrahedra and hexahedra none of whose
/// links is cut, and the links along none of these. Two fields of points: `displacement` from rest (3 components, mesh
/// units) and `violation`, the largest of the links of an element that are not cut (rest lengths).
///
/// Numbers stand in base64, so that they read back as the same.
void write_vtu(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
