#include "elastic/dense.h"

#include <cmath>

namespace chainmail {
namespace {

/// Factors a small matrix, column by column.
bool factor_small(Dense matrix) {
  const Eigen::Index size = matrix.rows();
  for (Eigen::Index k = 0; k < size; ++k) {
    double* const pivots = &matrix(0, k);
    if (!(pivots[k] > 0)) {
      return false;
    }
    pivots[k] = std::sqrt(pivots[k]);
    for (Eigen::Index i = k + 1; i < size; ++i) {
      pivots[i] /= pivots[k];
    }
    for (Eigen::Index j = k + 1; j < size; ++j) {
      double* const column = &matrix(0, j);
      for (Eigen::Index i = j; i < size; ++i) {
        column[i] -= pivots[j] * pivots[i];
      }
    }
  }
  return true;
}

}  // namespace

void add_product(Dense sum, double factor, ConstDense a, ConstDense b) { sum.noalias() += factor * a * b; }

void add_transposed_product(Dense sum, double factor, ConstDense a, ConstDense b) {
  sum.noalias() += factor * a.transpose() * b;
}

void add_outer_product(Dense sum, double factor, ConstDense a, ConstDense b) {
  sum.noalias() += factor * a * b.transpose();
}

bool factor_positive(Dense matrix) {
  constexpr Eigen::Index small = 16;
  const Eigen::Index size = matrix.rows(), half = size / 2;
  if (size <= small) {
    return factor_small(matrix);
  }
  Dense below = matrix.bottomLeftCorner(size - half, half), rest = matrix.bottomRightCorner(size - half, size - half);
  if (!factor_positive(matrix.topLeftCorner(half, half))) {
    return false;
  }
  solve_on_the_right(matrix.topLeftCorner(half, half), below);
  subtract_square(rest, below);
  return factor_positive(rest);
}

// A block that is written to is given by value.
// NOLINTBEGIN(performance-unnecessary-value-param)
void solve_lower(ConstDense lower, Dense right) { lower.triangularView<Eigen::Lower>().solveInPlace(right); }

void solve_lower_transposed(ConstDense lower, Dense right) {
  lower.triangularView<Eigen::Lower>().transpose().solveInPlace(right);
}

void solve_on_the_right(ConstDense lower, Dense left) {
  lower.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(left);
}
// NOLINTEND(performance-unnecessary-value-param)

void subtract_square(Dense from, ConstDense b) { from.selfadjointView<Eigen::Lower>().rankUpdate(b, -1); }

}  // namespace chainmail
