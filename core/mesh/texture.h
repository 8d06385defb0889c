#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace chainmail {

/// A position or displacement in mesh units, on the axes x, y and z.
using Point = Eigen::Vector3d;

/// Appearance of an object at rest: a picture on a sheet, or the densities of a volume. It moves with the material: a
/// point of the object shows the texel at its rest position.
struct Texture {
  /// Texels along x, y and z; a picture has depth 1. The first texel has the lowest x, y and z, so the rows of a
  /// picture run upward.
  std::array<std::uint32_t, 3> size{1, 1, 1};
  /// Channels: 1 is grey; 4 is red, green, blue and opacity (not premultiplied).
  int channels = 4;
  std::vector<std::uint8_t> texels;
  /// The lowest and the highest corner (mesh units); the centre of the first texel is half a texel inside.
  std::array<Point, 2> box{Point::Zero(), Point::Zero()};

  std::size_t byte_count() const { return std::size_t{size[0]} * size[1] * size[2] * std::size_t(channels); }
};

}  // namespace chainmail
