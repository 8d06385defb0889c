#pragma once

#include <array>
#include <cstdint>

#include "mesh/parameters.h"

namespace chainmail {

/// A homogeneous, isotropic elastic material.
struct Material {
  double young = parameters::young.standard;      // Young's modulus: force per square of a mesh unit
  double poisson = parameters::poisson.standard;  // Poisson's ratio

  bool operator==(const Material&) const = default;
};

/// Settings of the methods of elasticity and of free-form deformation.
struct ElasticOptions {
  static constexpr auto control_points = static_cast<std::uint32_t>(parameters::lattice.standard);

  Material material;
  /// Control points along each axis. Fewer than 2 span nothing, and each one costs time for every element.
  std::array<std::uint32_t, 3> lattice{control_points, control_points, control_points};
  /// Most iterations of XPBD and Projective Dynamics for one move.
  std::uint32_t iterations = static_cast<std::uint32_t>(parameters::iterations.standard);

  bool operator==(const ElasticOptions&) const = default;
};

/// Throws Error, with the name of the parameter, if one of the options is out of range.
void check(const ElasticOptions& options);

/// Lamé's parameters of a material in three dimensions.
struct Lame {
  double mu = 0, lambda = 0;
};
Lame lame(const Material& material);

}  // namespace chainmail
