#pragma once

#include <Eigen/Core>

namespace chainmail {

// Operations on dense matrices and on blocks of them. As expressions of Eigen, each costs a second to compile wherever
// it is written; these are compiled once.

using Dense = Eigen::Ref<Eigen::MatrixXd>;
using ConstDense = const Eigen::Ref<const Eigen::MatrixXd>&;

/// Adds factor · a b to a sum.
void add_product(Dense sum, double factor, ConstDense a, ConstDense b);
/// Adds factor · aᵀ b.
void add_transposed_product(Dense sum, double factor, ConstDense a, ConstDense b);
/// Adds factor · a bᵀ.
void add_outer_product(Dense sum, double factor, ConstDense a, ConstDense b);

/// Replaces the lower triangle of a symmetric matrix by its Cholesky factor L. Returns false if the matrix is not
/// positive definite. The upper triangle is not used.
[[nodiscard]] bool factor_positive(Dense matrix);
/// Replaces right sides, one per column, by the solutions of L x = b, or of Lᵀ x = b.
void solve_lower(ConstDense lower, Dense right);
void solve_lower_transposed(ConstDense lower, Dense right);
/// Replaces B by the solution of X Lᵀ = B.
void solve_on_the_right(ConstDense lower, Dense left);
/// Subtracts b bᵀ from the lower triangle of a matrix.
void subtract_square(Dense from, ConstDense b);

}  // namespace chainmail
