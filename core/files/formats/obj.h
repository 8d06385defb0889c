#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/imported.h"
#include "files/formats/mesh_state.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads Wavefront OBJ: vertices, faces, and `l` lines as links. Ids are the file's vertex order. Other statements of
/// the format are skipped. Throws Error with the line, and Cancelled. `path` appears in errors.
ImportedMesh read_obj(std::string_view text, const std::filesystem::path& path, const Progress& progress = {});

/// Writes the positions, the faces without a cut link, and the other uncut links as `l` lines.
void write_obj(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
