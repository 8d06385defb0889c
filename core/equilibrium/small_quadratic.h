#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <limits>

namespace chainmail {

/// A convex quadratic function of a few numbers: the energy of the links of one element, over the displacement d of
/// that element (mesh units), ½ dᵀ A d − fᵀ d.
template <int Dimension>
class SmallQuadratic {
 public:
  using Vector = Eigen::Matrix<double, Dimension, 1>;
  using Matrix = Eigen::Matrix<double, Dimension, Dimension>;

  /// Adds ½ axial (direction · d − along)² + ½ lateral |d − all|², less a constant.
  void add(double axial, const Vector& direction, double along, double lateral, const Vector& all) {
    matrix_ += axial * direction * direction.transpose();
    matrix_.diagonal().array() += lateral;
    force_ += axial * along * direction + lateral * all;
  }

  /// Returns the minimiser in the box from `low` to `high`. It is 0 on an axis where the box is empty, and in the
  /// directions in which the function is constant, unless the box requires otherwise.
  Vector least_inside(const Vector& low, const Vector& high) const {
    const Vector free = solved(matrix_, force_);
    const bool is_inside = (low.array() <= free.array()).all() && (free.array() <= high.array()).all();
    return is_inside ? free : least_on_side(free, low, high);
  }

 private:
  /// Solves a positive semidefinite system, in the range of the matrix only.
  static Vector solved(const Matrix& matrix, const Vector& right) {
    const double size = matrix.trace() / Dimension;
    if (!(size > 0)) {
      return Vector::Zero();
    }
    const Matrix scaled = matrix / size;
    if (scaled.determinant() > 1e-6) {
      return scaled.inverse() * (right / size);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> parts(scaled);
    Vector along = parts.eigenvectors().transpose() * (right / size);
    for (int k = 0; k < Dimension; ++k) {
      const double value = parts.eigenvalues()[k];
      along[k] = value > singular ? along[k] / value : 0;
    }
    return parts.eigenvectors() * along;
  }

  /// Returns the best of the minimisers over the sides, edges and corners of the box: on each axis the displacement is
  /// free, at the lower or at the upper bound. Most often it is on the bounds that the free minimiser is beyond.
  Vector least_on_side(const Vector& free, const Vector& low, const Vector& high) const {
    const int nearest = side_of(free, low, high);
    if (Vector displacement = least_on(nearest, low, high); is_least(displacement, nearest)) {
      return displacement;
    }
    Vector best = Vector::Zero();
    double least = std::numeric_limits<double>::infinity();
    constexpr int sides = Dimension == 1 ? 3 : Dimension == 2 ? 9 : 27;
    for (int side = 0; side < sides; ++side) {
      const Vector displacement = least_on(side, low, high);  // not a number if it is outside the box
      if (const double value = displacement.dot(matrix_ * displacement / 2 - force_); value < least) {
        least = value;
        best = displacement;
      }
    }
    return best;
  }

  static int side_of(const Vector& free, const Vector& low, const Vector& high) {
    int side = 0;
    for (int k = Dimension - 1; k >= 0; --k) {
      const bool is_empty = low[k] > high[k];
      side = 3 * side + (is_empty ? 0 : free[k] < low[k] ? 1 : free[k] > high[k] ? 2 : 0);
    }
    return side;
  }

  /// True if the function rises from the minimiser on a side to the inside of the box, which has no lower value then
  /// (the conditions of Karush, Kuhn and Tucker).
  bool is_least(const Vector& displacement, int side) const {
    const Vector slope = matrix_ * displacement - force_;
    bool rises = !displacement.hasNaN();
    for (int k = 0; k < Dimension; ++k, side /= 3) {
      rises = rises && (side % 3 == 0 || (side % 3 == 1 ? slope[k] >= 0 : slope[k] <= 0));
    }
    return rises;
  }

  /// Returns the minimiser on one side, whose digits to base 3 are 0 for an axis that is free, 1 for the lower and 2
  /// for the upper bound; not a number if it is outside the box or if another side is the same.
  Vector least_on(int side, const Vector& low, const Vector& high) const {
    Vector displacement = Vector::Zero();
    std::array<bool, Dimension> is_free{};
    for (int k = 0; k < Dimension; ++k, side /= 3) {
      const bool is_empty = low[k] > high[k];
      if (is_empty && side % 3 != 0) {
        return nowhere();
      }
      is_free[k] = side % 3 == 0 && !is_empty;
      displacement[k] = side % 3 == 0 ? 0 : side % 3 == 1 ? low[k] : high[k];
    }
    if (!displacement.allFinite()) {
      return nowhere();
    }
    Vector found = with_fixed(displacement, is_free);
    for (int k = 0; k < Dimension; ++k) {
      if (is_free[k] && !(low[k] <= found[k] && found[k] <= high[k])) {
        return nowhere();
      }
    }
    return found;
  }

  /// Returns the minimiser with the axes that are not free as in `displacement`.
  Vector with_fixed(const Vector& displacement, const std::array<bool, Dimension>& is_free) const {
    Matrix matrix = matrix_;
    Vector right = force_ - matrix_ * displacement;
    const double size = matrix_.trace() / Dimension;
    for (int k = 0; k < Dimension; ++k) {
      if (!is_free[k]) {
        matrix.row(k).setZero();
        matrix.col(k).setZero();
        matrix(k, k) = size;
        right[k] = 0;
      }
    }
    return displacement + solved(matrix, right);
  }

  static Vector nowhere() { return Vector::Constant(std::numeric_limits<double>::quiet_NaN()); }

  /// Eigenvalues below this share of the mean one count as 0.
  static constexpr double singular = 1e-10;

  Matrix matrix_ = Matrix::Zero();
  Vector force_ = Vector::Zero();
};

}  // namespace chainmail
