#include "elastic/closest_rotation.h"

#include <array>

#include "mesh/eigenvectors.h"

namespace chainmail {
namespace {

using Matrix3 = FixedMatrix<double, 3, 3>;
using Vector = FixedMatrix<double, 3>;
using Quaternion = FixedMatrix<double, 4>;

/// Returns the rotation of a quaternion w + xi + yj + zk of any length.
Matrix3 rotation_of(const Quaternion& quaternion) {
  const auto [w, x, y, z] = std::array{quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
  const double twice = 2 / quaternion.squaredNorm();
  Matrix3 rotation;
  rotation(0, 0) = 1 - twice * (y * y + z * z);
  rotation(1, 1) = 1 - twice * (x * x + z * z);
  rotation(2, 2) = 1 - twice * (x * x + y * y);
  rotation(0, 1) = twice * (x * y - w * z);
  rotation(1, 0) = twice * (x * y + w * z);
  rotation(0, 2) = twice * (x * z + w * y);
  rotation(2, 0) = twice * (x * z - w * y);
  rotation(1, 2) = twice * (y * z - w * x);
  rotation(2, 1) = twice * (y * z + w * x);
  return rotation;
}

/// Returns twice the axial vector of the antisymmetric part of a matrix.
Vector torque_of(const Matrix3& matrix) {
  return {matrix(2, 1) - matrix(1, 2), matrix(0, 2) - matrix(2, 0), matrix(1, 0) - matrix(0, 1)};
}

/// By the quaternion q for which tr RᵀA, a quadratic form, is largest (Horn 1987): slow, for matrices that are nearly
/// singular.
Matrix3 closest_by_eigenvector(const Matrix3& matrix) {
  const Vector torque = torque_of(matrix);
  FixedMatrix<double, 4, 4> form;
  form(0, 0) = matrix.trace();
  for (int i = 0; i < 3; ++i) {
    form(0, i + 1) = form(i + 1, 0) = torque[i];
    for (int j = 0; j < 3; ++j) {
      form(i + 1, j + 1) = matrix(i, j) + matrix(j, i) - (i == j ? matrix.trace() : 0);
    }
  }
  const Eigenvectors<4> eigen(form);
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    largest = eigen.values[i] > eigen.values[largest] ? i : largest;
  }
  return rotation_of(column(eigen.vectors, largest));
}

}  // namespace

void turn_to_closest(const Matrix3& matrix, Matrix3& rotation) {
  constexpr int max_steps = 8;
  constexpr double enough = 1e-8;           // radians; the error after a step is of the order of its square
  constexpr double least_curvature = 1e-6;  // of the size of the matrix
  const double size = matrix.norm(), floor = least_curvature * size;
  for (int i = 0; i < max_steps; ++i) {
    const Matrix3 product = matrix * transposed(rotation);
    Matrix3 curvature = (product + transposed(product)) * -0.5;
    for (int k = 0; k < 3; ++k) {
      curvature(k, k) += product.trace();
    }
    const Matrix3 adjoint = adjugate(curvature);
    const double minor = adjoint(2, 2), volume = determinant(curvature, adjoint);
    if (!(curvature(0, 0) > floor && minor > floor * floor && volume > floor * floor * floor)) {
      break;
    }
    const Vector turn = adjoint * torque_of(product) / volume;
    const double squared = turn.squaredNorm();
    if (!(squared < 1)) {
      break;
    }
    rotation = rotation_of({1, turn[0] / 2, turn[1] / 2, turn[2] / 2}) * rotation;
    if (squared < enough * enough) {
      // Removes what rounding adds to the rotation over many searches.
      rotation = rotation * (1.5 * Matrix3::Identity() - 0.5 * (transposed(rotation) * rotation));
      return;
    }
  }
  rotation = closest_by_eigenvector(matrix);
}

}  // namespace chainmail
