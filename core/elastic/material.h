#pragma once

#include <array>
#include <cstdint>

namespace chainmail {

/// A homogeneous, isotropic elastic material.
struct Material {
  double young = 1;      // Young's modulus, force per square of a mesh unit; above 0
  double poisson = 0.3;  // Poisson's ratio, in [0, 0.5)

  bool operator==(const Material&) const = default;
};

/// Control points of free-form deformation along an axis: fewer span nothing, and of more each costs every element.
inline constexpr std::uint32_t fewest_control_points = 2, most_control_points = 8;

/// What the methods of elasticity are told beside the object.
struct ElasticOptions {
  Material material;
  /// Control points along each axis.
  std::array<std::uint32_t, 3> lattice{4, 4, 4};

  bool operator==(const ElasticOptions&) const = default;
};

/// Throws Error, naming the parameter, where the options are none of the above.
void check(const ElasticOptions& options);

/// Lamé's parameters of a material, as in three dimensions.
struct Lame {
  double mu = 0, lambda = 0;
};
Lame lame(const Material& material);

}  // namespace chainmail
