#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "files/formats/voxel_block.h"

namespace chainmail {

/// What a caller says about a file that the file itself may leave open.
struct ReadOptions {
  /// The lattice of a .dat file and its spacing (mesh units); they override what the file or its name states.
  std::optional<std::array<std::uint32_t, 3>> size;
  std::optional<double> spacing;
  /// Default: what the file states, else the number of axes on which the mesh is not constant.
  std::optional<int> space_dimension;
  /// How the voxels of a volume become elements.
  VoxelOptions voxels;
  /// True if the header of a volume may name data outside its own folder.
  bool data_outside = false;
};

/// Returns W x H x D of a text `WxH` or `WxHxD`, each 1 or more. `sizes` is the number of sizes that the text must
/// have (0: two or three). Missing sizes are 1.
std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes = 0);

}  // namespace chainmail
