#pragma once

#include <Eigen/Core>
#include <span>

#include "mesh/fixed_matrix.h"

namespace chainmail {

/// Rows of the largest matrix: the coordinates of the corners of a tetrahedron.
inline constexpr int max_eigenvector_rows = 12;

/// Finds the eigenvalues of a symmetric matrix of up to max_eigenvector_rows (stored column by column, both triangles),
/// in no order, and replaces the matrix by its eigenvectors: orthonormal, one per column.
void find_eigenvectors(std::span<double> matrix, std::span<double> values);

/// The eigenvalues of a symmetric matrix, in no order, and its eigenvectors, one per column.
template <int Rows>
struct Eigenvectors {
  static_assert(Rows <= max_eigenvector_rows);

  explicit Eigenvectors(const FixedMatrix<double, Rows, Rows>& matrix) : vectors(matrix) {
    find_eigenvectors({vectors.data(), std::size_t(Rows * Rows)}, {values.data(), std::size_t(Rows)});
  }

  FixedMatrix<double, Rows> values;
  FixedMatrix<double, Rows, Rows> vectors;
};

/// Returns the nearest symmetric matrix without negative eigenvalues.
template <int Rows>
FixedMatrix<double, Rows, Rows> without_negative(FixedMatrix<double, Rows, Rows> matrix) {
  const Eigenvectors<Rows> found(matrix);
  for (int i = 0; i < Rows; ++i) {
    if (found.values[i] < 0) {
      add_square(matrix, -found.values[i], column(found.vectors, i));
    }
  }
  return matrix;
}

/// The eigenvalues of a symmetric matrix, ascending, and its eigenvectors of length 1, as columns.
struct AscendingEigenvectors {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};
AscendingEigenvectors ascending_eigenvectors(const Eigen::Matrix3d& matrix);

}  // namespace chainmail
