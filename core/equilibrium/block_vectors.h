#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace chainmail {

/// One vector per element.
template <class Scalar, int Dimension>
using BlockVectors = std::vector<Eigen::Matrix<Scalar, Dimension, 1>>;

template <class Scalar, int Dimension>
double dot(const BlockVectors<Scalar, Dimension>& a, const BlockVectors<Scalar, Dimension>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i].dot(b[i]);
  }
  return sum;
}

/// Adds a multiple of `other` to `sum`.
template <class Scalar, int Dimension>
void add(BlockVectors<Scalar, Dimension>& sum, double factor, const BlockVectors<Scalar, Dimension>& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] += factor * other[i];
  }
}

}  // namespace chainmail
