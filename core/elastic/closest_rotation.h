#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace chainmail {

// The rotation R closest to a matrix A: it maximises tr RᵀA over all rotations. For a positive determinant, it is the
// rotation of the polar decomposition. For a negative one, it is that of the decomposition in which the smallest
// singular value is negative (Irving, Teran and Fedkiw 2004), so inverted cells turn back on the shortest way. R enters
// as the start of the search: the nearer, the faster.

inline void turn_to_closest(const Eigen::Matrix<double, 1, 1>& /*matrix*/, Eigen::Matrix<double, 1, 1>& rotation) {
  rotation.setOnes();
}

inline void turn_to_closest(const Eigen::Matrix2d& matrix, Eigen::Matrix2d& rotation) {
  const double cosine = matrix(0, 0) + matrix(1, 1), sine = matrix(1, 0) - matrix(0, 1);
  const double size = std::sqrt(cosine * cosine + sine * sine);
  if (size > 0) {
    rotation(0, 0) = rotation(1, 1) = cosine / size;
    rotation(1, 0) = sine / size;
    rotation(0, 1) = -rotation(1, 0);
  }
}

/// By singular values: slow, for matrices that are nearly singular.
inline Eigen::Matrix3d closest_by_singular_values(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d left = svd.matrixU();
  if (left.determinant() * svd.matrixV().determinant() < 0) {
    left.col(2) = -left.col(2);  // of the smallest singular value
  }
  return left * svd.matrixV().transpose();
}

/// In space, by Newton's method for the angles. All maxima of tr RᵀA have the same value, so a stationary point with
/// negative curvature is the answer. Where Newton finds none in a few steps, the singular values decide.
inline void turn_to_closest(const Eigen::Matrix3d& matrix, Eigen::Matrix3d& rotation) {
  constexpr int max_steps = 8;
  constexpr double enough = 1e-8;           // radians; the error after a step is of the order of its square
  constexpr double least_curvature = 1e-6;  // of the size of the matrix
  const double size = matrix.norm();
  for (int i = 0; i < max_steps; ++i) {
    const Eigen::Matrix3d product = matrix * rotation.transpose();
    const Eigen::Vector3d torque(product(2, 1) - product(1, 2), product(0, 2) - product(2, 0),
                                 product(1, 0) - product(0, 1));
    Eigen::Matrix3d curvature = -(product + product.transpose()) / 2;
    curvature.diagonal().array() += product.trace();
    const double minor = curvature(0, 0) * curvature(1, 1) - curvature(0, 1) * curvature(0, 1);
    const double determinant = curvature.determinant(), floor = least_curvature * size;
    if (!(curvature(0, 0) > floor && minor > floor * floor && determinant > floor * floor * floor)) {
      break;
    }
    Eigen::Matrix3d adjugate;
    adjugate.col(0) = curvature.col(1).cross(curvature.col(2));
    adjugate.col(1) = curvature.col(2).cross(curvature.col(0));
    adjugate.col(2) = curvature.col(0).cross(curvature.col(1));
    const Eigen::Vector3d turn = adjugate * torque / determinant;
    const double squared = turn.squaredNorm();
    if (!(squared < 1)) {
      break;
    }
    rotation = Eigen::Quaterniond(1, turn[0] / 2, turn[1] / 2, turn[2] / 2).normalized().toRotationMatrix() * rotation;
    if (squared < enough * enough) {
      // Removes what rounding adds to the rotation over many searches.
      rotation = rotation * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * rotation.transpose() * rotation).eval();
      return;
    }
  }
  rotation = closest_by_singular_values(matrix);
}

}  // namespace chainmail
