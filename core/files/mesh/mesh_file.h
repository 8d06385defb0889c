#pragma once

#include <filesystem>
#include <ostream>

#include "files/formats/mesh_state.h"
#include "files/formats/read_options.h"
#include "files/mesh/mesh_formats.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Reads a file with open_mesh (files/mesh/open_mesh.h) and returns only its mesh. Throws Error, with the line if the
/// file is text, and Cancelled.
MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options = {},
                      const Progress& progress = {});

/// Writes the object with its cuts at the positions of `state`. A .dat file stores no positions. Throws Error if the
/// format cannot store the mesh, and Cancelled.
void write_mesh(std::ostream& out, const MeshFormat& format, const MeshState& state, const Progress& progress = {});
/// Writes an object at rest, with the softness of single links.
void write_mesh(std::ostream& out, const MeshFormat& format, const Mesh& mesh, const OwnSoftness& softness,
                const Progress& progress = {});

/// Writes the object into a file, in the format of the file's ending. If writing fails, the old file stays.
void save_mesh(const std::filesystem::path& path, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
