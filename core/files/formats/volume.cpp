#include "files/formats/volume.h"

#include <Eigen/LU>

#include "mesh/error.h"

namespace chainmail {

void DensityScale::refuse(std::size_t voxel) const {
  throw Error(where_, "the density of voxel " + std::to_string(voxel) + " is not a number, or is beyond 1e30",
              "use finite densities");
}

double DensityScale::step() const {
  const double range = highest_ - lowest_;
  return whole_ && range <= max_density_steps ? 1 : range > 0 ? range / max_density_steps : 1;
}

std::array<std::uint32_t, 3> checked_volume_size(const std::string& where, const std::array<std::uint64_t, 3>& size) {
  const double voxels = double(size[0]) * double(size[1]) * double(size[2]);
  if (voxels == 0) {
    throw Error(where, "a size is 0, so there are no voxels", "use a volume of 1 voxel or more along each axis");
  }
  if (voxels > double(limits::voxels)) {
    throw Error(where, "there are more than " + std::to_string(limits::voxels) + " voxels", "use a smaller volume");
  }
  std::array<std::uint32_t, 3> result{};
  std::transform(size.begin(), size.end(), result.begin(), [](auto one) { return static_cast<std::uint32_t>(one); });
  return result;
}

VoxelBoxes::VoxelBoxes(const std::array<std::uint32_t, 3>& volume_size, std::uint32_t edge)
    : volume(volume_size), edges{}, count{} {
  for (std::size_t k = 0; k < 3; ++k) {
    edges[k] = std::min(edge, volume[k]);
    count[k] = (volume[k] - 1) / edges[k] + 1;
  }
}

VoxelBoxes boxes_for(const std::array<std::uint32_t, 3>& volume_size, std::uint64_t most) {
  std::uint32_t low = 1, high = *std::max_element(volume_size.begin(), volume_size.end());
  while (low < high) {  // the number of boxes falls as they grow
    const std::uint32_t middle = low + (high - low) / 2;
    if (VoxelBoxes(volume_size, middle).total() <= most) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return {volume_size, low};
}

void merge_voxels(Volume& volume, const VoxelBoxes& boxes) {
  volume.merged = boxes.edge();
  volume.size = boxes.count;
  const Point edges(boxes.edges[0], boxes.edges[1], boxes.edges[2]);
  volume.origin = volume.at((edges - Point::Ones()) / 2);
  volume.spacing = volume.spacing.cwiseProduct(edges);
}

bool are_axes(const Eigen::Matrix3d& axes) {
  constexpr double rounding = 1e-3, least_volume = 1e-3;
  return axes.allFinite() && ((axes.colwise().norm().array() - 1).abs() < rounding).all() &&
         std::abs(axes.determinant()) > least_volume;
}

}  // namespace chainmail
