#include "mesh/eigenvectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chainmail {
namespace {

/// A symmetric matrix that becomes tridiagonal by reflections (Householder), and then diagonal by rotations (implicit
/// QR with Wilkinson's shifts): algorithms 8.3.1 and 8.3.2 of Golub and Van Loan (2013). Its largest number is 1.
class Diagonalization {
 public:
  Diagonalization(std::span<double> matrix, std::span<double> diagonal)
      : rows_(int(diagonal.size())), matrix_(matrix.data()), diagonal_(diagonal.data()) {
    make_tridiagonal();
    multiply_reflections();
    make_diagonal();
  }

 private:
  double* column(int i) { return matrix_ + i * rows_; }

  /// Leaves the normal of each reflection in its column, from the row below the diagonal on.
  void make_tridiagonal() {
    for (int k = 0; k < rows_; ++k) {
      diagonal_[k] = column(k)[k];
      if (k + 2 < rows_) {
        reflect(k);
      } else if (k + 1 < rows_) {
        below_[std::size_t(k)] = column(k)[k + 1];
      }
    }
  }

  /// Makes all numbers of a column zero that are two or more rows below the diagonal.
  void reflect(int k) {
    double* const normal = column(k);
    double squared = 0;
    for (int i = k + 1; i < rows_; ++i) {
      squared += normal[i] * normal[i];
    }
    const double first = normal[k + 1], reflected = -std::copysign(std::sqrt(squared), first);
    const double half = squared - first * reflected;  // of the squared length of the normal
    if (!(half > std::numeric_limits<double>::min())) {
      below_[std::size_t(k)] = first;
      factors_[std::size_t(k)] = 0;
      return;
    }
    below_[std::size_t(k)] = reflected;
    factors_[std::size_t(k)] = 1 / half;
    normal[k + 1] = first - reflected;
    reflect_remainder(k, normal, 1 / half);
  }

  /// Reflects the rows and columns beyond k.
  void reflect_remainder(int k, const double* normal, double factor) {
    std::array<double, max_eigenvector_rows> product{};  // of the matrix and the normal
    for (int j = k + 1; j < rows_; ++j) {
      const double* const one = column(j);
      const double share = factor * normal[j];
      for (int i = k + 1; i < rows_; ++i) {
        product[std::size_t(i)] += share * one[i];
      }
    }
    double half = 0;
    for (int i = k + 1; i < rows_; ++i) {
      half += factor / 2 * normal[i] * product[std::size_t(i)];
    }
    for (int i = k + 1; i < rows_; ++i) {
      product[std::size_t(i)] -= half * normal[i];
    }
    for (int j = k + 1; j < rows_; ++j) {
      double* const one = column(j);
      const double of_normal = product[std::size_t(j)], of_product = normal[j];
      for (int i = k + 1; i < rows_; ++i) {
        one[i] -= of_normal * normal[i] + of_product * product[std::size_t(i)];
      }
    }
  }

  /// Replaces the normals by the product of the reflections.
  void multiply_reflections() {
    for (int k = rows_ - 1; k >= 0; --k) {
      if (k + 2 < rows_) {
        apply_reflection(k);
      }
      std::fill_n(column(k), rows_, 0.0);
      column(k)[k] = 1;
    }
  }
  void apply_reflection(int k) {
    const double* const normal = column(k);
    for (int j = k + 1; j < rows_; ++j) {
      double* const one = column(j);
      double product = 0;
      for (int i = k + 1; i < rows_; ++i) {
        product += normal[i] * one[i];
      }
      product *= factors_[std::size_t(k)];
      for (int i = k + 1; i < rows_; ++i) {
        one[i] -= product * normal[i];
      }
    }
  }

  void make_diagonal() {
    constexpr int max_turns = 30;  // for each row; two are usual
    int end = rows_ - 1;
    for (int turn = 0; turn < max_turns * rows_; ++turn) {
      while (end > 0 && is_done(end - 1)) {
        --end;
      }
      if (end <= 0) {
        return;
      }
      int begin = end - 1;
      while (begin > 0 && !is_done(begin - 1)) {
        --begin;
      }
      rotate(begin, end);
    }
  }
  /// Returns true if the number below the diagonal is only rounding.
  bool is_done(int k) const {
    return std::abs(below_[std::size_t(k)]) <=
           std::numeric_limits<double>::epsilon() / 2 * (1 + std::abs(diagonal_[k]) + std::abs(diagonal_[k + 1]));
  }

  /// One turn for the rows from `begin` to `end`.
  void rotate(int begin, int end) {
    const double half = (diagonal_[end - 1] - diagonal_[end]) / 2, last = below_[std::size_t(end) - 1];
    const double root = std::sqrt(half * half + last * last);
    const double shift = diagonal_[end] - last * last / (half + std::copysign(root, half));
    double x = diagonal_[begin] - shift, z = below_[std::size_t(begin)];
    for (int k = begin; k < end; ++k) {
      const double size = std::sqrt(x * x + z * z);
      const double c = size > 0 ? x / size : 1, s = size > 0 ? z / size : 0;
      if (k > begin) {
        below_[std::size_t(k) - 1] = size;
      }
      const double here = diagonal_[k], below = below_[std::size_t(k)], next = diagonal_[k + 1];
      const double upper = c * here + s * below, lower = c * below + s * next;
      diagonal_[k] = c * upper + s * lower;
      diagonal_[k + 1] = c * (c * next - s * below) - s * (c * below - s * here);
      below_[std::size_t(k)] = c * lower - s * upper;
      if (k + 1 < end) {
        x = below_[std::size_t(k)];
        z = s * below_[std::size_t(k) + 1];
        below_[std::size_t(k) + 1] *= c;
      }
      rotate_columns(column(k), column(k + 1), c, s);
    }
  }
  void rotate_columns(double* __restrict a, double* __restrict b, double c, double s) const {
    for (int i = 0; i < rows_; ++i) {
      const double before = a[i];
      a[i] = c * before + s * b[i];
      b[i] = c * b[i] - s * before;
    }
  }

  int rows_;
  double* matrix_;
  double* diagonal_;
  std::array<double, max_eigenvector_rows> below_{};  // the numbers below the diagonal
  std::array<double, max_eigenvector_rows>
      factors_{};  // of the reflections: 2 over the squared lengths of their normals
};

}  // namespace

void find_eigenvectors(std::span<double> matrix, std::span<double> values) {
  double largest = 0;
  for (const double one : matrix) {
    largest = std::max(largest, std::abs(one));
  }
  // Rounding and underflow are measured against a largest number of 1.
  const double scale = largest > 0 ? largest : 1;
  for (double& one : matrix) {
    one /= scale;
  }
  Diagonalization(matrix, values);
  for (double& one : values) {
    one *= scale;
  }
}

AscendingEigenvectors ascending_eigenvectors(const Eigen::Matrix3d& matrix) {
  const Eigenvectors<3> found(FixedMatrix<double, 3, 3>::from(matrix.data()));
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&found](int i) { return found.values[i]; });
  AscendingEigenvectors result;
  for (int k = 0; k < 3; ++k) {
    const int from = order[std::size_t(k)];
    result.values[k] = found.values[from];
    result.vectors.col(k) = Eigen::Vector3d(found.vectors.data() + std::ptrdiff_t{3} * from);
  }
  return result;
}

}  // namespace chainmail
