#include "elastic/energy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "elastic/closest_rotation.h"
#include "elastic/stiffening.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {
namespace {

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
  result.gradient = Eigen::Map<const CornerVector>(forces.data(), Corners::size);
  if (want == Want::gradient) {
    return result;
  }
  result.hessian.resize(Corners::size, Corners::size);
  const FixedMatrix<double, N + 1, N + 1> products = transposed(rest) * rest;
  for (int q = 0; q < Corners::size; ++q) {
    for (int p = 0; p < Corners::size; ++p) {
      const int a = p / N, i = p % N, b = q / N, j = q % N;  // corner and axis
      result.hessian(p, q) =
          volume *
          (term.curvature_ss * by_shape[p] * by_shape[q] + term.curvature_ll * by_volume[p] * by_volume[q] +
           term.curvature_sl * (by_shape[p] * by_volume[q] + by_volume[p] * by_shape[q]) -
           term.slope_l * by_volume(i, b) * by_volume(j, a) + (i == j ? 2 * term.slope_s * products(a, b) : 0));
    }
  }
  if (want == Want::convex) {
    result.hessian = convex_part(result.hessian);
  }
  return result;
}

}  // namespace

CornerMatrix convex_part(const CornerMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<CornerMatrix> modes(hessian);
  const CornerMatrix& vectors = modes.eigenvectors();
  return vectors * modes.eigenvalues().cwiseMax(0).asDiagonal() * vectors.transpose();
}

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
using Square = Eigen::Matrix<double, N, N>;

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
  quarter << 0, -1, 1, 0;
  return {Twist<2>{rotation * quarter * std::sqrt(0.5), 2 / std::max(stretch.trace(), least_stretch)}};
}

/// About the principal axes of the stretch (Smith, de Goes and Kim 2019).
std::array<Twist<3>, 3> twists_of(const Square<3>& rotation, const Square<3>& stretch) {
  const Eigen::SelfAdjointEigenSolver<Square<3>> principal((stretch + stretch.transpose()) / 2);
  std::array<Twist<3>, 3> twists;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = principal.eigenvectors().col(i);
    Square<3> cross;
    cross << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
    const double others = stretch.trace() - principal.eigenvalues()[i];
    twists[std::size_t(i)] = {rotation * cross * std::sqrt(0.5), 2 / std::max(others, least_stretch)};
  }
  return twists;
}

template <int N>
SimplexEnergy corotated_in(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                           const Lame& whole, Want want) {
  using Corners = Eigen::Matrix<double, N, N + 1>;
  using Flat = Eigen::Matrix<double, N*(N + 1), 1>;
  const auto [mu, lambda] = lame_of_dimension(whole, N);
  const double volume = simplices.volumes[simplex];
  const Corners gradients = simplices.gradients_of(simplex), moved = at;
  const Square<N> deformation = Square<N>::Identity() + moved * gradients.transpose();
  Square<N> rotation = Square<N>::Identity();
  turn_to_closest(deformation, rotation);
  const Square<N> stretch = rotation.transpose() * deformation, strain = stretch - Square<N>::Identity();
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
  result.gradient = Eigen::Map<const Flat>(forces.data());
  if (want == Want::gradient) {
    return result;
  }
  Eigen::Matrix<double, N*(N + 1), N*(N + 1)> hessian;
  const Eigen::Matrix<double, N + 1, N + 1> products = 2 * mu * (gradients.transpose() * gradients);
  for (int a = 0; a <= N; ++a) {
    for (int b = 0; b <= N; ++b) {
      hessian.template block<N, N>(N * a, N * b) = products(a, b) * Square<N>::Identity();
    }
  }
  const auto flat = Eigen::Map<const Flat>(turned.data());
  hessian.noalias() += lambda * flat * flat.transpose();
  for (const Twist<N>& twist : twists_of(rotation, stretch)) {
    const double resists = (lambda * longer - 2 * mu) * twist.curvature;
    const Corners turning = twist.way * gradients;
    const auto of_twist = Eigen::Map<const Flat>(turning.data());
    // The second derivative along the twist is 2 μ + this; only there it can be negative.
    const double used = want == Want::convex ? std::max(resists, -2 * mu) : resists;
    hessian.noalias() += used * of_twist * of_twist.transpose();
  }
  result.hessian = volume * hessian;
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
