#pragma once

#include <filesystem>
#include <ostream>

#include "files/formats/mesh_state.h"
#include "files/formats/read_options.h"
#include "files/mesh/mesh_formats.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Returns only the mesh of what open_mesh reads (files/mesh/open_mesh.h). Throws Error, with the line where there is
/// one, and Cancelled.
MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options = {},
                      const Progress& progress = {});

/// Writes the object with its cuts at these positions; .dat holds no positions and takes those of its lattice.
/// Throws Error if the format cannot hold the mesh, and Cancelled.
void write_mesh(std::ostream& out, const MeshFormat& format, const MeshState& state, const Progress& progress = {});

/// Writes the same into a file, in the format that its ending names. A failed write leaves the file as it was.
void save_mesh(const std::filesystem::path& path, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
