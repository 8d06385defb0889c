#pragma once

#include <algorithm>
#include <cmath>

#include "equilibrium/block_vectors.h"
#include "equilibrium/preconditioner.h"

namespace chainmail {

/// Conjugate gradients with a preconditioner, one step at a time. The iterate belongs to the caller.
template <int D>
class ConjugateGradients {
 public:
  using Matrix = LinkMatrix<double, D>;
  using Vectors = typename Matrix::Vectors;

  /// Begins with this negative gradient.
  Vectors& begin() {
    is_first_step_ = true;
    return residual_;
  }

  /// Runs a step. Returns by how much the energy decreases.
  double step(const Matrix& matrix, Preconditioner<D>& preconditioner, Vectors& x) {
    preconditioner.apply(residual_, preconditioned_);
    const double slope = dot(residual_, preconditioned_);
    if (!(slope > 0)) {
      slope_ = 0;
      return 0;
    }
    // After Polak and Ribière, which forgives a preconditioner in float.
    const double beta = is_first_step_ ? 0 : std::max(0.0, -step_ * dot(product_, preconditioned_) / slope_);
    direction_.resize(residual_.size());
    for (std::size_t i = 0; i < direction_.size(); ++i) {
      direction_[i] = is_first_step_ ? preconditioned_[i] : preconditioned_[i] + beta * direction_[i];
    }
    slope_ = slope;
    is_first_step_ = false;
    matrix.apply(direction_, product_);
    const double curvature = dot(direction_, product_), along = dot(residual_, direction_);
    if (!(curvature > 0)) {
      return 0;
    }
    step_ = along / curvature;
    const double before = dot(residual_, residual_);
    double after = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += step_ * direction_[i];
      residual_[i] -= step_ * product_[i];
      after += residual_[i].squaredNorm();
    }
    shrunk_ = before > 0 ? std::sqrt(after / before) : 0;
    return step_ * along / 2;
  }

  /// Estimates the distance of the iterate from the minimum after the last step: √(twice the energy of the distance).
  double distance() const { return std::sqrt(std::max(0.0, slope_)) * shrunk_; }

 private:
  bool is_first_step_ = true;
  double slope_ = 0, step_ = 0, shrunk_ = 1;
  Vectors residual_, preconditioned_, direction_, product_;
};

}  // namespace chainmail
