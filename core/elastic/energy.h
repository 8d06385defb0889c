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

/// The energy of a material that stiffens as it is stretched, or of the compressible neo-Hookean material of Bonet and
/// Wood (1997); see stiffening.h.
SimplexEnergy energy_of_law(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                            const StrainLaw& law, const Lame& lame, Want want);

/// The energy of a material: corotated, for example.
using SimplexModel = std::function<SimplexEnergy(const Simplices& simplices, std::size_t simplex,
                                                 const CornerDisplacements& at, const Lame& lame, Want want)>;

/// Returns the nearest matrix without negative curvature.
CornerMatrix convex_part(const CornerMatrix& hessian);

/// Returns the stiffness of a simplex: the Hessian at rest, the same for all laws.
CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame);

}  // namespace chainmail
