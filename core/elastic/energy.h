#pragma once

#include <Eigen/Core>
#include <functional>

#include "elastic/material.h"
#include "elastic/simplices.h"

namespace chainmail {

/// Up to 12 coordinates of the corners of a tetrahedron, stored on the stack.
using CornerVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
using CornerMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// Displacements of the corners, one per column (n x (n + 1), mesh units).
using CornerDisplacements = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 4>;

/// A part of the energy density as a function of ln J, J = det F, with its first two derivatives.
struct VolumeTerm {
  double value = 0, slope = 0, curvature = 0;
};
/// Returns the part of the energy density that depends on J, for the compressible neo-Hookean material of Bonet and
/// Wood (1997),
///     W = μ/2 (tr FᵀF − 3) − μ ln J + λ/2 (ln J)².
/// The deformation is known on `dimension` axes. On the other axes the material is free of stress, and its stretch
/// minimizes W. So 3 is a solid, 2 is plane stress and 1 is a bar. At small strains each equals linear elasticity.
VolumeTerm volume_term(double log_volume, const Lame& lame, int dimension);

/// Energy of a simplex whose corners are displaced, with its derivatives.
struct SimplexEnergy {
  bool inverted = false;  // or strained beyond the limit of the material: then there is no energy
  double energy = 0;
  double magnitude = 0;   // of the terms whose difference is the energy; rounding is a share of it
  CornerVector gradient;  // by the coordinates of the corners, corner by corner
  CornerMatrix hessian;
};
/// What to compute; each includes those before it. `convex` is the Hessian, or the nearest matrix without negative
/// curvature instead of it (Teran et al. 2005).
enum class Want { energy, gradient, hessian, convex };
SimplexEnergy neo_hookean(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                          const Lame& lame, Want want);

/// The energy of a material: neo_hookean or corotated, for example.
using SimplexModel = std::function<SimplexEnergy(const Simplices& simplices, std::size_t simplex,
                                                 const CornerDisplacements& at, const Lame& lame, Want want)>;

/// Returns the nearest matrix without negative curvature.
CornerMatrix convex_part(const CornerMatrix& hessian);

/// Returns the stiffness of a simplex: the Hessian at rest.
CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame);

}  // namespace chainmail
