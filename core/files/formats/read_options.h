#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "files/formats/voxel_block.h"

#ifndef CHAINMAIL_IMPORT_PROGRAM
#define CHAINMAIL_IMPORT_PROGRAM ""  // the installed package says where it is
#endif

namespace chainmail {

/// Options of the user for data that a file may not contain.
struct ReadOptions {
  /// Size (elements) and spacing (mesh units) of the lattice of a .dat file. They override those in the file or its
  /// name.
  std::optional<std::array<std::uint32_t, 3>> size;
  std::optional<double> spacing;
  /// Space dimension. Default: the one that the file states, else the number of axes along which the mesh extends.
  std::optional<int> space_dimension;
  /// Points this close become one element (mesh units). Default: as the format needs it, see read_stl().
  std::optional<double> weld;
  /// Options for the conversion of voxels to elements.
  VoxelOptions voxels;
  /// True if the header of a volume may name data outside its own folder.
  bool data_outside = false;
  /// Path of chainmail-import, for programs in another folder; see run_import (files/import/import_process.h).
  std::filesystem::path import_program = CHAINMAIL_IMPORT_PROGRAM;
};

/// Returns W x H x D of a text `WxH` or `WxHxD`, each 1 or more. `sizes` is the number of sizes that the text must
/// have (0: two or three). Missing sizes are 1.
std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes = 0);

}  // namespace chainmail
