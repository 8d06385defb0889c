#include "files/formats/volume.h"

#include <algorithm>

#include "mesh/error.h"

namespace chainmail {

void DensityScale::widen(std::size_t voxel, double number) {
  if (!(std::abs(number) <= density_limit)) {
    throw Error(where_, "the density of voxel " + std::to_string(voxel) + " is not a number, or is beyond 1e30",
                "use finite densities");
  }
  lowest_ = voxel == 0 ? number : std::min(lowest_, number);
  highest_ = voxel == 0 ? number : std::max(highest_, number);
  whole_ = whole_ && number == std::floor(number);
}

double DensityScale::step() const {
  const double range = highest_ - lowest_;
  return whole_ && range <= most_density_steps ? 1 : range > 0 ? range / most_density_steps : 1;
}

std::array<std::uint32_t, 3> checked_volume_size(const std::string& where, const std::array<std::uint64_t, 3>& size) {
  const double voxels = double(size[0]) * double(size[1]) * double(size[2]);
  if (voxels == 0) {
    throw Error(where, "a size is 0, so there are no voxels", "use a volume of 1 voxel or more along each axis");
  }
  if (voxels > double(voxel_limit)) {
    throw Error(where, "there are more than " + std::to_string(voxel_limit) + " voxels", "use a smaller volume");
  }
  std::array<std::uint32_t, 3> result{};
  std::transform(size.begin(), size.end(), result.begin(), [](auto one) { return static_cast<std::uint32_t>(one); });
  return result;
}

}  // namespace chainmail
