#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A medical or other volume: a density for each voxel of a regular arrangement.
struct Volume {
  std::array<std::uint32_t, 3> size{1, 1, 1};  // voxels along x, y and z
  Point spacing = Point::Ones();               // between voxels (mesh units)
  Point origin = Point::Zero();                // centre of the first voxel (mesh units)
  /// Along x, then y, then z, in at most 65,535 steps from the lowest to the highest density: whole numbers of 16 bits
  /// stay exact.
  std::vector<std::uint16_t> densities;
  double lowest = 0;
  double step = 1;

  std::size_t voxel_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
  double density(std::size_t voxel) const { return lowest + step * densities[voxel]; }
};

inline constexpr double most_density_steps = 65535;
/// Densities beyond this are refused: their sums must stay finite in single precision.
inline constexpr double density_limit = 1e30;

/// More voxels than this are refused before memory is taken: 2 GiB of them.
inline constexpr std::uint64_t voxel_limit = std::uint64_t{1} << 30;

/// The range of densities and its step: 1 if all are whole numbers and their range is small enough.
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

/// Returns the size, or throws Error about `where` if it has no voxels or more than voxel_limit.
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
