#include "elastic/energy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "elastic/closest_rotation.h"
#include "elastic/stiffening.h"
#include "mesh/eigenvectors.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {
namespace {

template <int Size>
void set_gradient(SimplexEnergy& energy, const double* gradient) {
  energy.gradient.resize(Size);
  std::copy_n(gradient, Size, energy.gradient.data());
}

template <int Size>
void set_hessian(SimplexEnergy& energy, const FixedMatrix<double, Size, Size>& hessian) {
  energy.hessian.resize(Size, Size);
  std::copy_n(hessian.data(), Size * Size, energy.hessian.data());
}

template <int N>
SimplexEnergy energy_in(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                        const StrainLaw& law, const Lame& lame, Want want) {
  using Square = FixedMatrix<double, N, N>;
  using Corners = FixedMatrix<double, N, N + 1>;
  const Corners rest = Corners::from(simplices.gradients_of(simplex).data());
  const double volume = simplices.volumes[simplex];
  const Square strain = Corners::from(at.data()) * transposed(rest);  // F − 1
  const Square deformation = Square::Identity() + strain, adjoint = adjugate(deformation);
  SimplexEnergy result;
  const double ratio = determinant(deformation, adjoint);
  result.inverted = !(ratio > 0);
  if (result.inverted) {
    return result;
  }
  // Written in terms of F − 1, tr FᵀF − n keeps its digits for a small deformation.
  const StiffeningTerm term = stiffening_term(2 * strain.trace() + strain.squaredNorm(), std::log(ratio), law, lame, N);
  result.inverted = term.infinite;
  if (result.inverted) {
    return result;
  }
  result.energy = volume * term.value;
  result.magnitude = volume * term.magnitude;
  if (want == Want::energy) {
    return result;
  }
  const Corners by_volume = transposed(adjoint) / ratio * rest;  // derivatives of L
  const Corners by_shape = 2 * (deformation * rest);             // of S
  const Corners forces = volume * (term.slope_s * by_shape + term.slope_l * by_volume);
  set_gradient<Corners::size>(result, forces.data());
  if (want == Want::gradient) {
    return result;
  }
  FixedMatrix<double, Corners::size, Corners::size> hessian;
  const FixedMatrix<double, N + 1, N + 1> products = transposed(rest) * rest;
  for (int q = 0; q < Corners::size; ++q) {
    for (int p = 0; p < Corners::size; ++p) {
      const int a = p / N, i = p % N, b = q / N, j = q % N;  // corner and axis
      hessian(p, q) =
          volume *
          (term.curvature_ss * by_shape[p] * by_shape[q] + term.curvature_ll * by_volume[p] * by_volume[q] +
           term.curvature_sl * (by_shape[p] * by_volume[q] + by_volume[p] * by_shape[q]) -
           term.slope_l * by_volume(i, b) * by_volume(j, a) + (i == j ? 2 * term.slope_s * products(a, b) : 0));
    }
  }
  set_hessian(result, want == Want::convex ? without_negative(hessian) : hessian);
  return result;
}

}  // namespace

SimplexEnergy energy_of_law(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                            const StrainLaw& law, const Lame& lame, Want want) {
  switch (simplices.dimension) {
    case 1:
      return energy_in<1>(simplices, simplex, at, law, lame, want);
    case 2:
      return energy_in<2>(simplices, simplex, at, law, lame, want);
    default:
      return energy_in<3>(simplices, simplex, at, law, lame, want);
  }
}

CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame) {
  const CornerDisplacements rest = CornerDisplacements::Zero(simplices.dimension, simplices.dimension + 1);
  return energy_of_law(simplices, simplex, rest, {}, lame, Want::hessian).hessian;
}

namespace {

template <int N>
using Square = FixedMatrix<double, N, N>;

/// One way in which a simplex turns against its rotation: a matrix of size 1, and the second derivative of tr RᵀF along
/// it.
template <int N>
struct Twist {
  Square<N> way;
  double curvature = 0;
};

// A sum of singular values below this is taken as this: there the energy has a ridge, and no second derivative.
constexpr double least_stretch = 1e-9;

std::array<Twist<1>, 0> twists_of(const Square<1>& /*rotation*/, const Square<1>& /*stretch*/) { return {}; }

std::array<Twist<2>, 1> twists_of(const Square<2>& rotation, const Square<2>& stretch) {
  Square<2> quarter;
  quarter(1, 0) = std::sqrt(0.5);
  quarter(0, 1) = -quarter(1, 0);
  return {Twist<2>{rotation * quarter, 2 / std::max(stretch.trace(), least_stretch)}};
}

/// About the principal axes of the stretch (Smith, de Goes and Kim 2019).
std::array<Twist<3>, 3> twists_of(const Square<3>& rotation, const Square<3>& stretch) {
  const Eigenvectors<3> principal((stretch + transposed(stretch)) / 2);
  std::array<Twist<3>, 3> twists;
  for (int i = 0; i < 3; ++i) {
    const FixedMatrix<double, 3> axis = std::sqrt(0.5) * column(principal.vectors, i);
    Square<3> cross;
    for (int k = 0; k < 3; ++k) {
      cross((k + 2) % 3, (k + 1) % 3) = axis[k];
      cross((k + 1) % 3, (k + 2) % 3) = -axis[k];
    }
    const double others = stretch.trace() - principal.values[i];
    twists[std::size_t(i)] = {rotation * cross, 2 / std::max(others, least_stretch)};
  }
  return twists;
}

template <int N>
SimplexEnergy corotated_in(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                           const Lame& whole, Want want) {
  using Corners = FixedMatrix<double, N, N + 1>;
  using Flat = FixedMatrix<double, Corners::size>;
  const auto [mu, lambda] = lame_of_dimension(whole, N);
  const double volume = simplices.volumes[simplex];
  const Corners gradients = Corners::from(simplices.gradients_of(simplex).data()), moved = Corners::from(at.data());
  const Square<N> deformation = Square<N>::Identity() + moved * transposed(gradients);
  Square<N> rotation = Square<N>::Identity();
  turn_to_closest(deformation, rotation);
  const Square<N> stretch = transposed(rotation) * deformation, strain = stretch - Square<N>::Identity();
  const double longer = strain.trace();
  SimplexEnergy result;
  result.energy = volume * (mu * strain.squaredNorm() + lambda / 2 * longer * longer);
  // The strain is a difference of numbers near 1, so its rounding error does not shrink with it.
  result.magnitude = result.energy + volume * (2 * mu + N * lambda) * strain.norm() * (1 + deformation.norm());
  if (want == Want::energy) {
    return result;
  }
  const Corners turned = rotation * gradients;
  const Corners forces = volume * (2 * mu * (deformation * gradients - turned) + lambda * longer * turned);
  set_gradient<Corners::size>(result, forces.data());
  if (want == Want::gradient) {
    return result;
  }
  FixedMatrix<double, Corners::size, Corners::size> hessian;
  const FixedMatrix<double, N + 1, N + 1> products = 2 * mu * (transposed(gradients) * gradients);
  for (int a = 0; a <= N; ++a) {
    for (int b = 0; b <= N; ++b) {
      for (int k = 0; k < N; ++k) {
        hessian(N * a + k, N * b + k) = products(a, b);
      }
    }
  }
  add_square(hessian, lambda, Flat::from(turned.data()));
  for (const Twist<N>& twist : twists_of(rotation, stretch)) {
    const double resists = (lambda * longer - 2 * mu) * twist.curvature;
    // The second derivative along the twist is 2 μ + this; only there it can be negative.
    const double used = want == Want::convex ? std::max(resists, -2 * mu) : resists;
    add_square(hessian, used, Flat::from((twist.way * gradients).data()));
  }
  set_hessian(result, volume * hessian);
  return result;
}

}  // namespace

Lame lame_of_dimension(const Lame& lame, int dimension) {
  const auto [mu, lambda] = lame;
  return dimension == 3   ? lame
         : dimension == 2 ? Lame{mu, 2 * mu * lambda / (2 * mu + lambda)}
                          : Lame{mu * (3 * lambda + 2 * mu) / (lambda + mu) / 2, 0};
}

SimplexEnergy corotated(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                        const Lame& lame, Want want) {
  switch (simplices.dimension) {
    case 1:
      return corotated_in<1>(simplices, simplex, at, lame, want);
    case 2:
      return corotated_in<2>(simplices, simplex, at, lame, want);
    default:
      return corotated_in<3>(simplices, simplex, at, lame, want);
  }
}

}  // namespace chainmail
