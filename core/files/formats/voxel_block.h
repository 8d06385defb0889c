#pragma once

#include <cstdint>
#include <optional>

#include "body/softness.h"
#include "files/formats/volume.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Options for the conversion of a volume to an object.
struct VoxelOptions {
  /// Lowest density of voxels that become elements. Default: otsu_threshold().
  std::optional<double> threshold;
  /// Number of voxels along each axis that become one element; along a shorter axis, all of them. Default: chosen from
  /// the size, so that there are at most voxel_elements elements.
  std::optional<std::uint32_t> every;
  /// True if links are stiffer where the density is higher: from the default softness at the threshold to rigid at the
  /// highest density. False if all links have the default softness.
  bool stiff_where_dense = true;
};

/// Largest number of elements of an object that follows the handle in real time.
inline constexpr std::uint64_t voxel_elements = 100'000;

/// An object made of the voxels above a density, with links along the axes. ChainMail was developed for such objects
/// (Frisken-Gibson 1997).
struct VoxelBlock {
  MeshPointer mesh;      // the mesh, with the volume as texture
  OwnSoftness softness;  // softness of the links that are stiffer than the default
  double threshold = 0;
  std::uint32_t every = 1;
};

/// Returns the threshold that best separates the densities of a volume into two classes (Otsu 1979).
double otsu_threshold(const Volume& volume);

/// Converts a volume to an object. Throws Error about `where` if no voxel reaches the density, or if there are more
/// than element_limit elements. Throws Cancelled.
VoxelBlock voxel_block(const Volume& volume, const VoxelOptions& options, const std::string& where,
                       const Progress& progress = {});

}  // namespace chainmail
