#pragma once

#include <Eigen/Core>

#include "elastic/material.h"
#include "elastic/simplices.h"

namespace chainmail {

/// Up to the 12 coordinates of a tetrahedron's corners: on the stack.
using CornerVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
using CornerMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// A column a corner (n x (n + 1), mesh units).
using CornerDisplacements = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 4>;

/// How the energy density depends on ln J, J = det F, and its first two derivatives.
struct VolumeTerm {
  double value = 0, slope = 0, curvature = 0;
};
/// Of the compressible neo-Hookean material of Bonet and Wood (1997),
///     W = μ/2 (tr FᵀF − 3) − μ ln J + λ/2 (ln J)²,
/// in `dimension` axes of which the deformation is known; on the others the material is free of stress and stretches by
/// what makes W least. So 3 is a solid, 2 plane stress, 1 a bar, and at small strains each is the linear one.
VolumeTerm volume_term(double log_volume, const Lame& lame, int dimension);

/// A simplex under displacements of its corners (n rows, n + 1 columns, mesh units).
struct SimplexEnergy {
  bool inverted = false;  // then there is no energy
  double energy = 0;
  double magnitude = 0;   // of what the energy is a difference of: rounding is a share of it
  CornerVector gradient;  // by the corners' coordinates, corner after corner
  CornerMatrix hessian;
};
enum class Want { energy, gradient, hessian };
SimplexEnergy neo_hookean(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                          const Lame& lame, Want want);

/// The stiffness of a simplex: the Hessian at rest.
CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame);

}  // namespace chainmail
