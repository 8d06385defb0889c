#pragma once

#include <span>

#include "mesh/fixed_matrix.h"

namespace chainmail {

/// Finds the eigenvalues of a symmetric matrix of up to 12 rows (stored column by column, both triangles), in no order,
/// and replaces the matrix by its eigenvectors: orthonormal, one per column.
void find_eigenvectors(std::span<double> matrix, std::span<double> values);

/// The eigenvalues of a symmetric matrix, in no order, and its eigenvectors, one per column.
template <int Rows>
struct Eigenvectors {
  explicit Eigenvectors(const FixedMatrix<double, Rows, Rows>& matrix) : vectors(matrix) {
    find_eigenvectors({vectors.data(), std::size_t(Rows * Rows)}, {values.data(), std::size_t(Rows)});
  }

  FixedMatrix<double, Rows> values;
  FixedMatrix<double, Rows, Rows> vectors;
};

}  // namespace chainmail
