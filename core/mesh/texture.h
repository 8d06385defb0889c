#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace chainmail {

/// A position or displacement in mesh units, on the axes x, y and z.
using Point = Eigen::Vector3d;

/// What an object looks like at rest: a picture that lies on a sheet, or the densities of a volume. It goes with the
/// material: a place of the object shows what is at its rest position.
struct Texture {
  /// Texels along x, y and z; a picture is one deep. The first stands at the lowest x, y and z, so that the rows of a
  /// picture run upward.
  std::array<std::uint32_t, 3> size{1, 1, 1};
  /// 1 is grey, 4 is red, green, blue and opacity, not multiplied by it.
  int channels = 4;
  std::vector<std::uint8_t> texels;
  /// Where its outer corners lie (mesh units), the lowest and the highest: the first texel's centre is half a texel in.
  std::array<Point, 2> box{Point::Zero(), Point::Zero()};

  std::size_t byte_count() const { return std::size_t{size[0]} * size[1] * size[2] * std::size_t(channels); }
};

}  // namespace chainmail
