#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/imported.h"
#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads PLY (Turk 1994), text or binary: vertices, faces, and edges of vertex1 and vertex2, in any order. Ids follow
/// the order of the vertices; everything else is skipped. This reader uses no library: CGAL skips edges, and Assimp
/// changes the order of the vertices. Throws Error, with the line if the file is text; and Cancelled.
ImportedMesh read_ply(std::string_view bytes, const std::filesystem::path& path, const Progress& progress = {});

/// Writes ASCII PLY (Turk 1994): vertices in double, the faces without a cut link, and the other uncut links as
/// elements `edge` of vertex1 and vertex2.
void write_ply(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
