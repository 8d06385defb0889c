#include "mesh/symmetric_eigen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chainmail {
namespace {

/// Turns the axes p and q so that a(p, q) becomes 0.
void rotate(Eigen::Matrix3d& a, Eigen::Matrix3d& vectors, int p, int q) {
  if (a(p, q) == 0) {
    return;
  }
  const int r = 3 - p - q;
  const double cotangent = (a(q, q) - a(p, p)) / (2 * a(p, q));  // of twice the angle
  const double tangent = std::copysign(1, cotangent) / (std::abs(cotangent) + std::sqrt(cotangent * cotangent + 1));
  const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
  a(p, p) -= tangent * a(p, q);
  a(q, q) += tangent * a(p, q);
  a(p, q) = a(q, p) = 0;
  const double rp = a(r, p), rq = a(r, q);
  a(r, p) = a(p, r) = cosine * rp - sine * rq;
  a(r, q) = a(q, r) = sine * rp + cosine * rq;
  for (int k = 0; k < 3; ++k) {
    const double kp = vectors(k, p), kq = vectors(k, q);
    vectors(k, p) = cosine * kp - sine * kq;
    vectors(k, q) = sine * kp + cosine * kq;
  }
}

}  // namespace

SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix) {
  constexpr int max_rounds = 32;  // usually 4 to 6
  Eigen::Matrix3d a = matrix, vectors = Eigen::Matrix3d::Identity();
  for (int round = 0; round < max_rounds; ++round) {
    const double outside = std::abs(a(0, 1)) + std::abs(a(0, 2)) + std::abs(a(1, 2));
    const double size = std::max({std::abs(a(0, 0)), std::abs(a(1, 1)), std::abs(a(2, 2))});
    if (outside <= std::numeric_limits<double>::epsilon() / 16 * size) {
      break;
    }
    rotate(a, vectors, 0, 1);
    rotate(a, vectors, 0, 2);
    rotate(a, vectors, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&a](int i, int j) { return a(i, i) < a(j, j); });
  SymmetricEigen result;
  for (int k = 0; k < 3; ++k) {
    const int from = order[std::size_t(k)];
    result.values[k] = a(from, from);
    result.vectors.col(k) = vectors.col(from);
  }
  return result;
}

}  // namespace chainmail
