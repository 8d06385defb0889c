#include "elastic/stiffening.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chainmail {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int most_turns = 60;  // far more than Newton needs for a convex function of one unknown
constexpr int longest_search =
    200;  // turns; bisection alone reaches the rounding of a double in 60, from a bound found in as many

/// f and its first two derivatives at I₁ − 3 = x.
struct Shape {
  double value = 0, slope = 0, curvature = 0;
};
Shape shape_inside(double x, const StrainLaw& law, double mu) {
  if (law.kind == StrainLaw::Kind::gent) {
    const double left = 1 - x / law.gent_limit;
    return left > 0 ? Shape{-mu / 2 * law.gent_limit * std::log1p(-x / law.gent_limit), mu / 2 / left,
                            mu / 2 / (law.gent_limit * left * left)}
                    : Shape{infinite, infinite, infinite};
  }
  if (law.kind == StrainLaw::Kind::fung) {
    const double b = law.fung_exponent, grown = std::exp(b * x);
    return {mu / 2 * std::expm1(b * x) / b, mu / 2 * grown, mu / 2 * b * grown};
  }
  return {mu / 2 * x, mu / 2, 0};
}

/// f as it is, or continued by a parabola from the end of its range on.
enum class Range { physical, extended };

double end_of_range(const StrainLaw& law) {
  switch (law.kind) {
    case StrainLaw::Kind::gent:
      return 0.99 * law.gent_limit;
    case StrainLaw::Kind::fung:
      return 8 / law.fung_exponent;
    default:
      return infinite;
  }
}

Shape shape_of(double x, const StrainLaw& law, double mu, Range range = Range::physical) {
  if (const double end = end_of_range(law); range == Range::extended && x > end) {
    const Shape last = shape_inside(end, law, mu);
    const double beyond = x - end;
    return {last.value + beyond * (last.slope + beyond * last.curvature / 2), last.slope + beyond * last.curvature,
            last.curvature};
  }
  return shape_inside(x, law, mu);
}

/// Finds ln s for the stretch s on the axes that are free of stress: 2 f'(I₁ − 3) s² − μ + λ' (ln J + m ln s) = 0.
class FreeStretch {
 public:
  FreeStretch(double s, double l, const StrainLaw& law, const Lame& lame, double corrected, int axes, Range range)
      : s_(s), l_(l), law_(law), mu_(lame.mu), lambda_(corrected), axes_(axes), range_(range) {}

  /// Newton's method between bounds, which are halved where it leaves them: the left side grows with ln s.
  double log() const {
    double low = -1, high = 1, a = 0;
    while (slope(low) > 0 && low > -longest_search) {
      low *= 2;
    }
    while (slope(high) < 0 && high < longest_search) {
      high *= 2;
    }
    for (int turn = 0; turn < longest_search; ++turn) {
      const double here = slope(a);
      (here > 0 ? high : low) = a;
      const double to = a - here / curvature(a);
      const double next = to > low && to < high ? to : (low + high) / 2;  // also if it is not a number
      const double step = next - a;
      a = next;
      if (std::abs(step) <= 1e-15 * (1 + std::abs(a))) {
        break;
      }
    }
    return a;
  }
  double curvature(double a) const {
    const Shape f = at(a);
    const double squared = std::exp(2 * a);
    return 4 * squared * (f.slope + axes_ * squared * f.curvature) + axes_ * lambda_;
  }

 private:
  Shape at(double a) const { return shape_of(s_ + axes_ * std::expm1(2 * a), law_, mu_, range_); }
  double slope(double a) const { return 2 * at(a).slope * std::exp(2 * a) - mu_ + lambda_ * (l_ + axes_ * a); }

  double s_, l_;
  const StrainLaw& law_;
  double mu_, lambda_;
  int axes_;
  Range range_;
};

/// For the neo-Hookean material Newton starts to the right of the root of a convex function, so it does not overshoot.
double neo_hookean_stretch(double l, const Lame& lame, int axes) {
  double a = -lame.lambda * l / (2 * lame.mu + axes * lame.lambda);
  for (int turn = 0; turn < most_turns; ++turn) {
    const double squared = std::exp(2 * a);
    const double step =
        (lame.mu * (squared - 1) + lame.lambda * (l + axes * a)) / (2 * lame.mu * squared + axes * lame.lambda);
    a -= step;
    if (std::abs(step) <= 1e-15 * (1 + std::abs(a))) {
      break;
    }
  }
  return a;
}

/// The term of the neo-Hookean material at any strain.
StiffeningTerm neo_hookean_term(double s, double l, const Lame& lame, int axes) {
  const auto [mu, lambda] = lame;
  const double a = axes == 0 ? 0 : neo_hookean_stretch(l, lame, axes);
  const double squared = std::exp(2 * a), whole = l + axes * a;
  const double shape = mu / 2 * s, volume = mu / 2 * axes * std::expm1(2 * a) - mu * whole + lambda / 2 * whole * whole;
  StiffeningTerm term;
  term.value = shape + volume;
  term.magnitude = std::abs(shape) + std::abs(volume);
  term.slope_s = mu / 2;
  term.slope_l = lambda * whole - mu;
  term.curvature_ll = lambda * 2 * mu * squared / (2 * mu * squared + axes * lambda);
  return term;
}

StiffeningTerm term_of(double s, double l, const StrainLaw& law, const Lame& lame, int dimension, Range range) {
  const double corrected = lame.lambda - 4 * shape_of(0, law, lame.mu).curvature;
  const int axes = 3 - dimension;
  const FreeStretch free(s, l, law, lame, corrected, axes, range);
  const bool has_limit = law.kind == StrainLaw::Kind::gent && range == Range::physical;
  StiffeningTerm term;
  // The stretch on the free axes lowers S by less than 1 each.
  term.infinite = !std::isfinite(s) || (has_limit && s - axes >= law.gent_limit);
  if (term.infinite) {
    return term;
  }
  const double a = axes == 0 ? 0 : free.log();
  const double squared = std::exp(2 * a), whole = l + axes * a;
  const Shape f = shape_of(s + axes * std::expm1(2 * a), law, lame.mu, range);
  term.infinite = !std::isfinite(f.value) || !std::isfinite(f.curvature);
  if (term.infinite) {
    return term;
  }
  term.value = f.value - lame.mu * whole + corrected / 2 * whole * whole;
  term.magnitude = std::abs(f.value) + std::abs(lame.mu * whole) + corrected / 2 * whole * whole;
  term.slope_s = f.slope;
  term.slope_l = corrected * whole - lame.mu;
  const double by_s = axes == 0 ? 0 : -2 * f.curvature * squared / free.curvature(a);  // derivatives of a
  const double by_l = axes == 0 ? 0 : -corrected / free.curvature(a);
  term.curvature_ss = f.curvature * (1 + 2 * axes * squared * by_s);
  term.curvature_sl = 2 * f.curvature * axes * squared * by_l;
  term.curvature_ll = corrected * (1 + axes * by_l);
  return term;
}

}  // namespace

StiffeningTerm stiffening_term(double s, double l, const StrainLaw& law, const Lame& lame, int dimension) {
  return law.kind == StrainLaw::Kind::neo_hookean ? neo_hookean_term(s, l, lame, 3 - dimension)
                                                  : term_of(s, l, law, lame, dimension, Range::physical);
}

ExtendedDensity::ExtendedDensity(const StrainLaw& law, const Lame& lame, int dimension, bool free_axes)
    : law_(law), lame_(lame), dimension_(free_axes ? dimension : 3) {
  set_least_volume(0.5);
}

void ExtendedDensity::set_least_volume(double least_volume) {
  least_volume_ = least_volume;
  const StiffeningTerm last = term_of(0, std::log(least_volume), law_, lame_, dimension_, Range::extended);
  slope_ = last.slope_l / least_volume;
  curvature_ = (last.curvature_ll - last.slope_l) / (least_volume * least_volume);
}

ExtendedDensity::Value ExtendedDensity::at(double s, double j) const {
  const double inside = std::max(j, least_volume_), below = j - inside;  // 0 where J is inside
  const StiffeningTerm term = term_of(s, std::log(inside), law_, lame_, dimension_, Range::extended);
  return {term.value + below * (term.slope_l / inside + curvature_ / 2 * below),
          term.slope_s + term.curvature_sl / inside * below, term.slope_l / inside + curvature_ * below};
}

ExtendedDensity::Curvature ExtendedDensity::curvature_at(double s, double j) const {
  const double inside = std::max(j, least_volume_);
  const StiffeningTerm term = term_of(s, std::log(inside), law_, lame_, dimension_, Range::extended);
  return {term.curvature_ss, term.curvature_sl / inside,
          j < inside ? curvature_ : (term.curvature_ll - term.slope_l) / (inside * inside)};
}

SimplexModel model_of(const StrainLaw& law) {
  return [law](const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at, const Lame& lame,
               Want want) { return energy_of_law(simplices, simplex, at, law, lame, want); };
}

}  // namespace chainmail
