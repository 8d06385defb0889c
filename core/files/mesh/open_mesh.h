#pragma once

#include <filesystem>
#include <string>

#include "body/softness.h"
#include "files/formats/imported.h"
#include "files/formats/voxel_block.h"
#include "files/mesh/flaws.h"
#include "files/mesh/mesh_file.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// The object in a file, with remarks for the user.
struct OpenedMesh {
  MeshPointer mesh;
  OwnSoftness softness;  // softness of single links: dense voxels have stiffer links
  MeshFlaws flaws;
  std::string remark;  // description of the conversion of voxels; empty for other files
};

/// Reads a mesh, a volume, or a pair of TetGen files. The format is recognised by the content, else by the ending.
///
/// Throws Error, with the line if the file is text, and Cancelled. Libraries read files in a separate process with
/// limited memory and time.
OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options = {}, const Progress& progress = {});

/// Describes the conversion of voxels to elements: 'voxels from a density of 250, 2 along each axis to an element'.
std::string in_words(const VoxelBlock& block);

/// Builds a mesh from the content of a file, with links along all edges. Flawed faces and cells are left out, unless
/// the reader checked them.
OpenedMesh opened(ImportedMesh imported, const std::filesystem::path& path, const ReadOptions& options,
                  const Progress& progress = {});

}  // namespace chainmail
