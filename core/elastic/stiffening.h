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

/// The energy density as a function of S and of J = det F, for all deformations, inverted ones included.
///
/// Below a least J, a parabola in J continues it, with the same value and slope. Beyond I₁ − 3 = .99 J_m (Gent) or 8/b
/// (Fung), f goes on as a parabola of the same value and first two derivatives. Within these limits it is the energy of
/// stiffening_term, so a minimum inside them is the same.
class ExtendedDensity {
 public:
  /// `dimension` is that of F; where it is below 3, the other axes are free of stress, or keep their length.
  ExtendedDensity(const StrainLaw& law, const Lame& lame, int dimension, bool free_axes = true);
  /// Sets the J below which the parabola begins. The lower it is, the stiffer are inverted cells.
  void set_least_volume(double least_volume);
  double least_volume() const { return least_volume_; }
  /// Slope and curvature of the parabola where it begins.
  double slope_below() const { return slope_; }
  double curvature_below() const { return curvature_; }

  /// A density with its derivatives by S and by J.
  struct Value {
    double value = 0, by_shape = 0, by_volume = 0;
  };
  Value at(double s, double j) const;
  /// The second derivatives, for an approximation of the curvature; those of a parabola beyond J are not all exact.
  struct Curvature {
    double by_shape = 0, by_both = 0, by_volume = 0;
  };
  Curvature curvature_at(double s, double j) const;

 private:
  StrainLaw law_;
  Lame lame_;
  int dimension_;  // 3 if no axis is free of stress
  double least_volume_ = 0, slope_ = 0, curvature_ = 0;
};

}  // namespace chainmail
