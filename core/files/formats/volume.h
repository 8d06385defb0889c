#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "files/text/limits.h"
#include "mesh/mesh.h"

namespace chainmail {

/// A medical or other volume: one density per voxel of a regular grid.
struct Volume {
  std::array<std::uint32_t, 3> size{1, 1, 1};  // number of voxels along x, y and z
  Point spacing = Point::Ones();               // distances between voxels (mesh units)
  Point origin = Point::Zero();                // centre of the first voxel (mesh units)
  /// Directions along which voxels follow each other: column k, of length 1, is that of axis k of the voxels. They need
  /// not be at right angles, and may be mirrored.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// Number of voxels of the file along each axis that one voxel is the mean of; along a shorter axis, all of them.
  std::uint32_t merged = 1;
  /// Densities along x, then y, then z, as steps above the lowest density. There are at most 65,535 steps, so that
  /// whole numbers of 16 bits stay exact.
  std::vector<std::uint16_t> densities;
  double lowest = 0;
  double step = 1;

  std::size_t voxel_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
  double density(std::size_t voxel) const { return lowest + step * densities[voxel]; }
  /// Returns the place that is so many voxels behind the first along each axis (mesh units).
  Point at(const Point& voxels) const { return origin + axes * spacing.cwiseProduct(voxels); }
};

inline constexpr double max_density_steps = 65535;
/// Largest magnitude of a density. Larger ones are refused, because sums must stay finite in single precision.
inline constexpr double density_limit = 1e30;

/// Returns true if directions may be the axes of a volume: of length 1, and not in one plane.
bool are_axes(const Eigen::Matrix3d& axes);

/// The range of densities and its step. The step is 1 if all densities are whole numbers and their range is small
/// enough.
class DensityScale {
 public:
  explicit DensityScale(std::string where) : where_(std::move(where)) {}
  void widen(std::size_t voxel, double number) {
    if (!(std::abs(number) <= density_limit)) {
      refuse(voxel);
    }
    lowest_ = voxel == 0 ? number : std::min(lowest_, number);
    highest_ = voxel == 0 ? number : std::max(highest_, number);
    whole_ = whole_ && number == std::floor(number);
  }
  double lowest() const { return lowest_; }
  double step() const;

 private:
  [[noreturn]] void refuse(std::size_t voxel) const;

  std::string where_;
  double lowest_ = 0, highest_ = 0;
  bool whole_ = true;
};

/// Returns the size. Throws Error about `where` if there are no voxels or more than limits::voxels.
std::array<std::uint32_t, 3> checked_volume_size(const std::string& where, const std::array<std::uint64_t, 3>& size);

/// Boxes of voxels with the same number of voxels along each axis, or all voxels of a shorter axis. Those at the upper
/// borders may have fewer voxels.
struct VoxelBoxes {
  /// Boxes of `edge` voxels along each axis of a volume of this size.
  VoxelBoxes(const std::array<std::uint32_t, 3>& volume_size, std::uint32_t edge);

  std::array<std::uint32_t, 3> volume;  // size of the volume (voxels)
  std::array<std::uint32_t, 3> edges;   // voxels of a box along each axis
  std::array<std::uint32_t, 3> count;   // boxes along each axis

  /// Largest edge.
  std::uint32_t edge() const { return *std::max_element(edges.begin(), edges.end()); }
  std::uint64_t total() const { return std::uint64_t{count[0]} * count[1] * count[2]; }
  /// Number of voxels along an axis in box `i`.
  std::uint32_t width(std::size_t axis, std::uint32_t i) const {
    return std::min(edges[axis], volume[axis] - i * edges[axis]);
  }
};

/// Returns the smallest boxes that are at most `most`.
VoxelBoxes boxes_for(const std::array<std::uint32_t, 3>& volume_size, std::uint64_t most);

/// Turns a volume of the size of a file into one of these boxes, without densities.
void merge_voxels(Volume& volume, const VoxelBoxes& boxes);

/// Adds the numbers of a volume, one after another, to the sums of boxes, and calls `take(sum, voxels)` for each box
/// when it is complete. It keeps the sums of the boxes that are not complete: at most one layer.
template <class Sum, class Number, class Take>
void for_each_box(const VoxelBoxes& boxes, Number number, Take take) {
  const auto& [width, height, depth] = boxes.edges;
  const std::size_t in_row = depth > 1 || height > 1 ? boxes.count[0] : 0;  // 0: a box is in one row of voxels
  std::vector<Sum> sums(1 + in_row * (depth > 1 ? boxes.count[1] : 1));
  std::size_t voxel = 0;
  for (std::uint32_t z = 0; z < boxes.volume[2]; ++z) {
    for (std::uint32_t y = 0; y < boxes.volume[1]; ++y) {
      Sum* row = sums.data() + (depth > 1 ? in_row * (y / height) : 0);
      const std::uint32_t rows = boxes.width(1, y / height), layers = boxes.width(2, z / depth);
      const bool is_complete = y % height + 1 == rows && z % depth + 1 == layers;
      for (std::uint32_t x = 0; x < boxes.count[0]; ++x) {
        const std::uint32_t columns = boxes.width(0, x);
        Sum& kept = row[in_row > 0 ? x : 0];
        Sum sum = kept;
        for (std::uint32_t i = columns; i > 0; --i) {
          sum += Sum(number(voxel++));
        }
        if (is_complete) {
          take(sum, std::uint64_t{columns} * rows * layers);
        }
        kept = is_complete ? Sum(0) : sum;
      }
    }
  }
}

/// Fills in the densities from the numbers of a file; `number(i)` returns number i as double. It is called for all
/// numbers in their order, twice. A volume with more than `most` voxels is averaged, so that memory is taken only for
/// the result and one layer of it. Throws Error about `where` if a number is not finite.
template <class Number>
void take_densities(Volume& volume, const std::string& where, Number number,
                    std::uint64_t most = limits::voxels_in_memory) {
  DensityScale scale(where);
  for (std::size_t i = 0; i < volume.voxel_count(); ++i) {
    scale.widen(i, number(i));
  }
  volume.lowest = scale.lowest();
  volume.step = scale.step();
  const VoxelBoxes boxes = boxes_for(volume.size, most);
  merge_voxels(volume, boxes);
  volume.densities.reserve(volume.voxel_count());
  for_each_box<double>(boxes, number, [&volume](double sum, std::uint64_t voxels) {
    // The rounded mean of huge numbers may lie outside their range.
    const double steps = (sum / double(voxels) - volume.lowest) / volume.step + 0.5;
    volume.densities.push_back(static_cast<std::uint16_t>(std::clamp(steps, 0.0, max_density_steps)));
  });
}

}  // namespace chainmail
