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

/// Returns the stiffness of a simplex: the Hessian at rest, the same for all laws.
CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame);

/// Returns the corotated energy of a simplex (Sifakis and Barbič 2012),
///     W = μ |F − R|² + λ/2 (tr RᵀF − n)²,
/// with its exact derivatives: R, the rotation closest to F, turns with the corners. The force of Müller and Gross
/// (2004), which leaves out that R changes, is not the gradient of an energy. At small strains without a rotation it is
/// linear elasticity; 2 dimensions are plane stress, and 1 is a bar. It has a value for inverted cells, too.
SimplexEnergy corotated(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                        const Lame& lame, Want want);

/// Returns the parameters that give linear elasticity in this number of dimensions: plane stress in 2, a bar in 1.
Lame lame_of_dimension(const Lame& lame, int dimension);

}  // namespace chainmail
