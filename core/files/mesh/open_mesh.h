#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "files/formats/imported.h"
#include "files/mesh/flaws.h"
#include "files/mesh/mesh_file.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/softness.h"

namespace chainmail {

/// What a file holds, and what there is to say of it.
struct OpenedMesh {
  MeshPointer mesh;
  std::map<LinkId, LinkSoftness> softness;  // of links with their own: a volume's, which are stiff where it is dense
  MeshFlaws flaws;
  std::string remark;  // how a volume was taken, or empty
};

/// Reads a mesh, a volume, or a pair of TetGen's files, in the format that its content tells, else its ending.
///
/// Throws Error, with the line where there is one, and Cancelled. What libraries read they read in a process of their
/// own, within limits of memory and time.
OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options = {}, const Progress& progress = {});

/// Whether a file's content, else its ending, tells that it is a volume of voxels. Throws as detect_format.
bool is_volume(const std::filesystem::path& path);

/// The voxels of such a file. Throws as open_mesh.
Volume read_volume(const std::filesystem::path& path, const Progress& progress = {});

/// What voxels are taken as, in words: 'voxels from a density of 250, 2 along each axis to an element'.
std::string in_words(const VoxelBlock& block);

/// What an import gave, as a mesh: flawed parts left out, links along all edges.
OpenedMesh opened(ImportedMesh imported, const std::filesystem::path& path, const ReadOptions& options,
                  const Progress& progress);

}  // namespace chainmail
