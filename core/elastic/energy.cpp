#include "elastic/energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace chainmail {
namespace {

constexpr int max_turns = 60;  // far more than Newton needs for a convex function of one unknown

/// Returns ln s for the stretch s on the axes that are free of stress: μ (s² − 1) + λ (ln J + m ln s) = 0.
double log_of_free_stretch(double log_volume, const Lame& lame, int free_axes) {
  // The linear answer is to the right of the root, and the function is convex, so Newton does not overshoot.
  double a = -lame.lambda * log_volume / (2 * lame.mu + free_axes * lame.lambda);
  for (int turn = 0; turn < max_turns; ++turn) {
    const double squared = std::exp(2 * a);
    const double value = lame.mu * (squared - 1) + lame.lambda * (log_volume + free_axes * a);
    const double step = value / (2 * lame.mu * squared + free_axes * lame.lambda);
    a -= step;
    if (std::abs(step) <= 1e-15 * (1 + std::abs(a))) {
      break;
    }
  }
  return a;
}

}  // namespace

CornerMatrix convex_part(const CornerMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<CornerMatrix> modes(hessian);
  const CornerMatrix& vectors = modes.eigenvectors();
  return vectors * modes.eigenvalues().cwiseMax(0).asDiagonal() * vectors.transpose();
}

VolumeTerm volume_term(double log_volume, const Lame& lame, int dimension) {
  const auto [mu, lambda] = lame;
  const int free_axes = 3 - dimension;
  const double a = free_axes == 0 ? 0 : log_of_free_stretch(log_volume, lame, free_axes);
  const double squared = std::exp(2 * a), whole = log_volume + free_axes * a;
  return {mu / 2 * free_axes * std::expm1(2 * a) - mu * whole + lambda / 2 * whole * whole, lambda * whole - mu,
          lambda * 2 * mu * squared / (2 * mu * squared + free_axes * lambda)};
}

SimplexEnergy neo_hookean(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                          const Lame& lame, Want want) {
  const int n = simplices.dimension;
  const auto rest_gradients = simplices.gradients_of(simplex);
  const double volume = simplices.volumes[simplex];
  const SmallMatrix strain = at * rest_gradients.transpose();  // F − 1
  const SmallMatrix deformation = SmallMatrix::Identity(n, n) + strain;
  SimplexEnergy result;
  const double determinant = deformation.determinant();
  result.inverted = !(determinant > 0);
  if (result.inverted) {
    return result;
  }
  const VolumeTerm term = volume_term(std::log(determinant), lame, n);
  // Written in terms of F − 1, tr FᵀF − n keeps its digits for a small deformation.
  const double shape = lame.mu / 2 * (2 * strain.trace() + strain.squaredNorm());
  result.energy = volume * (shape + term.value);
  result.magnitude = volume * (std::abs(shape) + std::abs(term.value));
  if (want == Want::energy) {
    return result;
  }
  const CornerDisplacements gradients =
      deformation.inverse().transpose() * rest_gradients;  // of the shape functions in the deformed simplex
  const CornerDisplacements forces = volume * (lame.mu * (deformation * rest_gradients) + term.slope * gradients);
  result.gradient = Eigen::Map<const CornerVector>(forces.data(), forces.size());
  if (want == Want::gradient) {
    return result;
  }
  result.hessian.resize(n * (n + 1), n * (n + 1));
  for (int a = 0; a <= n; ++a) {
    for (int b = 0; b <= n; ++b) {
      auto block = result.hessian.block(n * a, n * b, n, n);
      block = volume * (term.curvature * gradients.col(a) * gradients.col(b).transpose() -
                        term.slope * gradients.col(b) * gradients.col(a).transpose());
      block.diagonal().array() += volume * lame.mu * rest_gradients.col(a).dot(rest_gradients.col(b));
    }
  }
  if (want == Want::convex) {
    result.hessian = convex_part(result.hessian);
  }
  return result;
}

CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame) {
  const CornerDisplacements rest = CornerDisplacements::Zero(simplices.dimension, simplices.dimension + 1);
  return neo_hookean(simplices, simplex, rest, lame, Want::hessian).hessian;
}

}  // namespace chainmail
