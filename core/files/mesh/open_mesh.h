#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "files/formats/imported.h"
#include "files/formats/voxel_block.h"
#include "files/mesh/flaws.h"
#include "files/mesh/mesh_file.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/softness.h"

namespace chainmail {

/// The object of a file, and what the user should know about it.
struct OpenedMesh {
  MeshPointer mesh;
  std::map<LinkId, LinkSoftness> softness;  // of links with their own: dense voxels have stiffer links
  MeshFlaws flaws;
  std::string remark;  // how voxels became elements, else empty
};

/// Reads a mesh, a volume, or a pair of TetGen files. Its content decides the format, else its ending does.
///
/// Throws Error, with the line where there is one, and Cancelled. Libraries read in a process of their own, within
/// limits of memory and time.
OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options = {}, const Progress& progress = {});

/// True if the file is a volume of voxels. Throws as detect_format.
bool is_volume(const std::filesystem::path& path);

/// Returns the voxels of such a file. Throws as open_mesh.
Volume read_volume(const std::filesystem::path& path, const Progress& progress = {});

/// Describes how voxels became elements: 'voxels from a density of 250, 2 along each axis to an element'.
std::string in_words(const VoxelBlock& block);

/// Builds the mesh that a reader took from a file, with links along all edges. Flawed faces and cells are left out,
/// unless the reader checked them.
OpenedMesh opened(ImportedMesh imported, const std::filesystem::path& path, const ReadOptions& options,
                  const Progress& progress = {});

}  // namespace chainmail
