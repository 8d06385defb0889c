#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/fixed_matrix.h"

namespace chainmail {

/// A convex quadratic function of a few numbers: the energy of the links of one element, over the displacement d of
/// that element (mesh units), ½ dᵀ A d − fᵀ d.
template <int Dimension>
class SmallQuadratic {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Matrix = FixedMatrix<double, Dimension, Dimension>;

  /// Adds ½ axial (direction · d − along)² + ½ lateral |d − all|², less a constant.
  void add(double axial, const Vector& direction, double along, double lateral, const Vector& all) {
    matrix_ += outer_product(axial * direction, direction) + lateral * Matrix::Identity();
    force_ += axial * along * direction + lateral * all;
  }

  /// Returns the minimiser in the box from `low` to `high`. It is 0 on an axis where the box is empty, and in the
  /// directions in which the function is constant, unless the box requires otherwise.
  Vector least_inside(const Vector& low, const Vector& high) const {
    const Vector free = solved(matrix_, force_);
    bool is_inside = true;
    for (int k = 0; k < Dimension; ++k) {
      is_inside = is_inside && low[k] <= free[k] && free[k] <= high[k];
    }
    return is_inside ? free : least_on_side(free, low, high);
  }

 private:
  /// Solves a positive semidefinite system, in the range of the matrix only.
  static Vector solved(const Matrix& matrix, const Vector& right) {
    const double size = matrix.trace() / Dimension;
    if (!(size > 0)) {
      return {};
    }
    const Matrix scaled = matrix / size, adjoint = adjugate(scaled);
    const double product = determinant(scaled, adjoint);
    return product > 1e-6 ? adjoint / product * (right / size) : solved_in_range(scaled, right / size);
  }
  /// By eigenvalues, those of a matrix of three rows: axes beyond the dimension have 0.
  static Vector solved_in_range(const Matrix& matrix, const Vector& right) {
    Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
    Eigen::Vector3d given = Eigen::Vector3d::Zero();
    for (int k = 0; k < Dimension; ++k) {
      given[k] = right[k];
      for (int l = 0; l < Dimension; ++l) {
        all(k, l) = matrix(k, l);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(all);
    Vector result;
    for (int k = 0; k < 3; ++k) {
      if (const double value = parts.eigenvalues()[k]; value > singular) {
        const Eigen::Vector3d mode = parts.eigenvectors().col(k);
        for (int l = 0; l < Dimension; ++l) {
          result[l] += mode.dot(given) / value * mode[l];
        }
      }
    }
    return result;
  }

  /// Returns the best of the minimisers over the sides, edges and corners of the box: on each axis the displacement is
  /// free, at the lower or at the upper bound. Most often it is on the bounds that the free minimiser is beyond.
  Vector least_on_side(const Vector& free, const Vector& low, const Vector& high) const {
    const int nearest = side_of(free, low, high);
    if (Vector displacement = least_on(nearest, low, high); is_least(displacement, nearest)) {
      return displacement;
    }
    Vector best;
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
    bool rises = true;
    for (int k = 0; k < Dimension; ++k, side /= 3) {
      rises =
          rises && !std::isnan(displacement[k]) && (side % 3 == 0 || (side % 3 == 1 ? slope[k] >= 0 : slope[k] <= 0));
    }
    return rises;
  }

  /// Returns the minimiser on one side, whose digits to base 3 are 0 for an axis that is free, 1 for the lower and 2
  /// for the upper bound; not a number if it is outside the box or if another side is the same.
  Vector least_on(int side, const Vector& low, const Vector& high) const {
    Vector displacement;
    std::array<bool, Dimension> is_free{};
    for (int k = 0; k < Dimension; ++k, side /= 3) {
      const bool is_empty = low[k] > high[k];
      if (is_empty && side % 3 != 0) {
        return nowhere();
      }
      is_free[k] = side % 3 == 0 && !is_empty;
      displacement[k] = side % 3 == 0 ? 0 : side % 3 == 1 ? low[k] : high[k];
    }
    for (int k = 0; k < Dimension; ++k) {
      if (!std::isfinite(displacement[k])) {
        return nowhere();
      }
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
        for (int l = 0; l < Dimension; ++l) {
          matrix(k, l) = matrix(l, k) = 0;
        }
        matrix(k, k) = size;
        right[k] = 0;
      }
    }
    return displacement + solved(matrix, right);
  }

  static Vector nowhere() {
    Vector result;
    for (int k = 0; k < Dimension; ++k) {
      result[k] = std::numeric_limits<double>::quiet_NaN();
    }
    return result;
  }

  /// Eigenvalues below this share of the mean one count as 0.
  static constexpr double singular = 1e-10;

  Matrix matrix_;
  Vector force_;
};

}  // namespace chainmail
