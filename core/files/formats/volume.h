#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A medical or other volume: one density per voxel of a regular grid.
struct Volume {
  std::array<std::uint32_t, 3> size{1, 1, 1};  // number of voxels along x, y and z
  Point spacing = Point::Ones();               // distances between voxels (mesh units)
  Point origin = Point::Zero();                // centre of the first voxel (mesh units)
  /// Densities along x, then y, then z, as steps above the lowest density. There are at most 65,535 steps, so that
  /// whole numbers of 16 bits stay exact.
  std::vector<std::uint16_t> densities;
  double lowest = 0;
  double step = 1;

  std::size_t voxel_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
  double density(std::size_t voxel) const { return lowest + step * densities[voxel]; }
};

inline constexpr double most_density_steps = 65535;
/// Largest magnitude of a density. Larger ones are refused, because sums must stay finite in single precision.
inline constexpr double density_limit = 1e30;

/// Largest number of voxels (2 GiB). Larger volumes are refused before memory is taken.
inline constexpr std::uint64_t voxel_limit = std::uint64_t{1} << 30;

/// The range of densities and its step. The step is 1 if all densities are whole numbers and their range is small
/// enough.
class DensityScale {
 public:
  explicit DensityScale(std::string where) : where_(std::move(where)) {}
  void widen(std::size_t voxel, double number);
  double lowest() const { return lowest_; }
  double step() const;

 private:
  std::string where_;
  double lowest_ = 0, highest_ = 0;
  bool whole_ = true;
};

/// Returns the size. Throws Error about `where` if there are no voxels or more than voxel_limit.
std::array<std::uint32_t, 3> checked_volume_size(const std::string& where, const std::array<std::uint64_t, 3>& size);

/// Fills in the densities from the numbers of a file; `number(i)` returns number i as double. Throws Error about
/// `where` if one is not finite.
template <class Number>
void take_densities(Volume& volume, const std::string& where, Number number) {
  DensityScale scale(where);
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    scale.widen(i, number(i));
  }
  volume.lowest = scale.lowest();
  volume.step = scale.step();
  volume.densities.resize(volume.voxel_count());
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    volume.densities[i] = static_cast<std::uint16_t>(std::lround((number(i) - volume.lowest) / volume.step));
  }
}

}  // namespace chainmail
