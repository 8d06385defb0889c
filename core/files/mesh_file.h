#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string_view>

#include "files/mesh_formats.h"
#include "files/voxel_block.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// What a reader takes from outside the file.
struct ReadOptions {
  /// The lattice of a .dat file and its spacing (mesh units), before what the file or its name says.
  std::optional<std::array<std::uint32_t, 3>> size;
  std::optional<double> spacing;
  /// By default what the file says, else the axes on which the mesh is not constant.
  std::optional<int> space_dimension;
  /// How the voxels of a volume are taken.
  VoxelOptions voxels;
  /// Whether the header of a volume may name data outside its own folder.
  bool data_outside = false;
};

/// The mesh alone of what open_mesh reads (files/open_mesh.h). Throws Error, with the line where there is one, and
/// Cancelled.
MeshPointer read_mesh(const std::filesystem::path& path, const ReadOptions& options = {},
                      const Progress& progress = {});

/// W x H x D of a text `WxH` or `WxHxD`, each 1 or more; `sizes` says how many there must be (0: two or
/// three). The sizes left out are 1.
std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes = 0);

/// The rest positions as they are read in place; valid as long as the mesh.
PositionView rest_positions(const Mesh& mesh);

/// An object as it is to be written. All must outlive the writing.
struct MeshState {
  const Mesh& mesh;
  const Cuts& cuts;
  PositionView positions;
  const Softness& softness;  // what formats that tell the violation of links measure it by
};

/// Writes the object as it is cut and stands; .dat holds no positions and takes those of its lattice.
/// Throws Error where the format cannot hold the mesh, and Cancelled.
void write_mesh(std::ostream& out, MeshFormat format, const MeshState& state, const Progress& progress = {});

/// The same into a file, in the format that its ending names, whole or not at all.
void save_mesh(const std::filesystem::path& path, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
