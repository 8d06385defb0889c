#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/read_options.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/solver.h"

namespace chainmail {

/// Reads Wavefront OBJ: the edges of faces and of `l` lines become links, each once; ids are the file's
/// vertex order. `path` appears in errors; `text` is what the file holds.
MeshPointer read_obj(std::string_view text, const std::filesystem::path& path, const ReadOptions& options,
                     const Progress& progress = {});

/// Writes the positions, the faces none of whose links is cut, and the other uncut links as `l` lines.
void write_obj(std::ostream& out, const Mesh& mesh, const Cuts& cuts, const PositionView& positions,
               const Progress& progress = {});

}  // namespace chainmail
