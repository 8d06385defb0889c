#pragma once

#include "elastic/energy.h"

namespace chainmail {

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
