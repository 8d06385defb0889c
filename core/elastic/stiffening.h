#pragma once

#include "elastic/energy.h"

namespace chainmail {

/// Elastic materials that stiffen as they are stretched. Their energy density is
///     W = f(I₁ − 3) − μ ln J + λ'/2 (ln J)²,   λ' = λ − 4 f''(0),
/// with J = det F and I₁ = tr FᵀF, and with a function f of slope f'(0) = μ/2:
///     neo-Hookean  f(x) = μ/2 x                           (Bonet and Wood 1997)
///     Gent         f(x) = −μ/2 J_m ln(1 − x / J_m)        (Gent 1996): infinite from x = J_m on
///     Fung         f(x) = μ/(2b) (exp(b x) − 1)           (Demiray 1972, an isotropic form of Fung's)
/// f''(0) is 0, μ / (2 J_m) and μ b / 2. The correction of λ keeps the linear elasticity of small strains: f adds
/// f''(0)/2 (2 tr ε)² to the energy there. λ' must not be below 0, which limits J_m and b.
///
/// As in energy.h, the stretch on axes along which the deformation is not known minimizes W.
SimplexModel model_of(const StrainLaw& law);

/// The energy density as a function of S = tr FᵀF − n and L = ln det F of the n axes that exist, with its derivatives.
struct StiffeningTerm {
  bool infinite = false;  // then there are no values
  double value = 0, magnitude = 0;
  double slope_s = 0, slope_l = 0;
  double curvature_ss = 0, curvature_sl = 0, curvature_ll = 0;
};
StiffeningTerm stiffening_term(double s, double l, const StrainLaw& law, const Lame& lame, int dimension);

}  // namespace chainmail
