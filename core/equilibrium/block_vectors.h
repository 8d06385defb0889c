#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// One vector per element.
template <class Scalar, int Dimension>
using BlockVectors = std::vector<FixedMatrix<Scalar, Dimension>>;

template <class A, class B, int Dimension>
double dot(const BlockVectors<A, Dimension>& a, const BlockVectors<B, Dimension>& b, const SharedLoop& blocks = {}) {
  return blocks.sum(a.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) {
      sum += rounded<double>(a[i]).dot(rounded<double>(b[i]));
    }
    return sum;
  });
}

/// Makes `copy` equal to `original`.
template <class Scalar, int Dimension>
void assign(BlockVectors<Scalar, Dimension>& copy, const BlockVectors<Scalar, Dimension>& original,
            const SharedLoop& blocks = {}) {
  copy.resize(original.size());
  blocks.run(original.size(), [&](std::size_t first, std::size_t last) {
    std::copy(original.begin() + std::ptrdiff_t(first), original.begin() + std::ptrdiff_t(last),
              copy.begin() + std::ptrdiff_t(first));
  });
}

/// Adds a multiple of `other` to `sum`.
template <class Scalar, int Dimension>
void add(BlockVectors<Scalar, Dimension>& sum, double factor, const BlockVectors<Scalar, Dimension>& other,
         const SharedLoop& blocks = {}) {
  blocks.run(sum.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      sum[i] += Scalar(factor) * other[i];
    }
  });
}

/// Does the same, and returns the dot product of the result with `next`: vectors are read once.
template <class Other, class Next, int Dimension>
double add_and_dot(BlockVectors<double, Dimension>& sum, double factor, const BlockVectors<Other, Dimension>& other,
                   const BlockVectors<Next, Dimension>& next, const SharedLoop& blocks) {
  return blocks.sum(sum.size(), [&](std::size_t first, std::size_t last) {
    double product = 0;
    for (std::size_t i = first; i < last; ++i) {
      sum[i] += factor * rounded<double>(other[i]);
      product += sum[i].dot(rounded<double>(next[i]));
    }
    return product;
  });
}

}  // namespace chainmail
