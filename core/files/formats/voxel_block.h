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
  /// The lowest density of what is there; by default where it parts the densities best (Otsu 1979).
  std::optional<double> threshold;
  /// How many voxels along each axis become one element; by default as many as leave voxel_elements at most.
  std::optional<std::uint32_t> every;
  /// The denser, the stiffer: from the standard softness at the threshold to rigid at the highest density. Else all
  /// links are alike.
  bool stiff_where_dense = true;
};

/// Fewer elements than these answer a hand in real time.
inline constexpr std::uint64_t voxel_elements = 100'000;

/// A volume's voxels above a threshold, linked along the axes: what ChainMail was made for (Frisken-Gibson 1997).
struct VoxelBlock {
  MeshPointer mesh;                         // its texture is the volume
  std::map<LinkId, LinkSoftness> softness;  // of the links that are stiffer than the standard
  double threshold = 0;
  std::uint32_t every = 1;
};

/// The threshold that parts a volume's densities best into two classes (Otsu 1979).
double otsu_threshold(const Volume& volume);

/// Throws Error, said of `where`, where nothing is above the threshold, or more than element_limit elements are; and
/// Cancelled.
VoxelBlock voxel_block(const Volume& volume, const VoxelOptions& options, const std::string& where,
                       const Progress& progress = {});

}  // namespace chainmail
