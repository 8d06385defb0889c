#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "files/formats/volume.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/softness.h"

namespace chainmail {

/// How a volume becomes an object.
struct VoxelOptions {
  /// The lowest density of a voxel that becomes an element. Default: otsu_threshold().
  std::optional<double> threshold;
  /// Number of voxels along each axis that become one element. Default: the smallest with at most voxel_elements
  /// elements.
  std::optional<std::uint32_t> every;
  /// True if links get stiffer with density: from the standard softness at the threshold to rigid at the highest
  /// density. False if all links are alike.
  bool stiff_where_dense = true;
};

/// Up to this number of elements, an object follows the handle in real time.
inline constexpr std::uint64_t voxel_elements = 100'000;

/// An object of the voxels from a density on, linked along the axes: the purpose that ChainMail was made for
/// (Frisken-Gibson 1997).
struct VoxelBlock {
  MeshPointer mesh;                         // its texture is the volume
  std::map<LinkId, LinkSoftness> softness;  // of the links that are stiffer than the standard
  double threshold = 0;
  std::uint32_t every = 1;
};

/// Returns the threshold that best separates the densities of a volume into two classes (Otsu 1979).
double otsu_threshold(const Volume& volume);

/// Throws Error about `where` if no voxel reaches the density, or more than element_limit elements are; and
/// Cancelled.
VoxelBlock voxel_block(const Volume& volume, const VoxelOptions& options, const std::string& where,
                       const Progress& progress = {});

}  // namespace chainmail
