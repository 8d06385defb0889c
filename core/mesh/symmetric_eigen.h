#pragma once

#include <Eigen/Core>

namespace chainmail {

/// The eigenvalues of a symmetric matrix, ascending, and its eigenvectors of length 1, as columns.
struct SymmetricEigen {
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  Eigen::Matrix3d vectors = Eigen::Matrix3d::Identity();
};

/// Finds them, up to rounding of the largest one, by rotations (Jacobi 1846). They are not numbers if the matrix has
/// numbers that are not finite.
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

}  // namespace chainmail
