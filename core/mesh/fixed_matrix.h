#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace chainmail {

/// A matrix or, with one column, a vector of a few numbers, stored column by column. Its operators compute at once:
/// expressions of Eigen, which are types of their own, take most of the time to compile code that is made for many
/// sizes. Members have the names of Eigen's.
template <class Scalar, int Rows, int Columns = 1>
class FixedMatrix {
 public:
  static constexpr int size = Rows * Columns;

  FixedMatrix() = default;
  /// Takes the numbers of a vector.
  template <class... Numbers>
  requires(sizeof...(Numbers) == size && size > 1 && (Rows == 1 || Columns == 1)) FixedMatrix(Numbers... numbers)
      : numbers_{Scalar(numbers)...} {}

  /// Returns the matrix of numbers that are stored column by column.
  static FixedMatrix from(const Scalar* numbers) {
    FixedMatrix result;
    std::copy_n(numbers, size, result.numbers_.data());
    return result;
  }
  static FixedMatrix Identity() {
    FixedMatrix result;
    for (int i = 0; i < Rows; ++i) {
      result(i, i) = 1;
    }
    return result;
  }

  Scalar& operator()(int row, int column) { return numbers_[std::size_t(column * Rows + row)]; }
  Scalar operator()(int row, int column) const { return numbers_[std::size_t(column * Rows + row)]; }
  Scalar& operator[](int i) { return numbers_[std::size_t(i)]; }
  Scalar operator[](int i) const { return numbers_[std::size_t(i)]; }
  Scalar* data() { return numbers_.data(); }
  const Scalar* data() const { return numbers_.data(); }

  [[gnu::always_inline]] FixedMatrix& operator+=(const FixedMatrix& other) {
    for (int i = 0; i < size; ++i) {
      numbers_[std::size_t(i)] += other[i];
    }
    return *this;
  }
  [[gnu::always_inline]] FixedMatrix& operator-=(const FixedMatrix& other) {
    for (int i = 0; i < size; ++i) {
      numbers_[std::size_t(i)] -= other[i];
    }
    return *this;
  }
  [[gnu::always_inline]] FixedMatrix& operator*=(Scalar factor) {
    for (Scalar& number : numbers_) {
      number *= factor;
    }
    return *this;
  }
  [[gnu::always_inline]] FixedMatrix& operator/=(Scalar divisor) {
    for (Scalar& number : numbers_) {
      number /= divisor;
    }
    return *this;
  }
  [[gnu::always_inline]] friend FixedMatrix operator+(FixedMatrix a, const FixedMatrix& b) { return a += b; }
  [[gnu::always_inline]] friend FixedMatrix operator-(FixedMatrix a, const FixedMatrix& b) { return a -= b; }
  [[gnu::always_inline]] friend FixedMatrix operator-(FixedMatrix a) { return a *= -1; }
  [[gnu::always_inline]] friend FixedMatrix operator*(Scalar factor, FixedMatrix a) { return a *= factor; }
  [[gnu::always_inline]] friend FixedMatrix operator*(FixedMatrix a, Scalar factor) { return a *= factor; }
  [[gnu::always_inline]] friend FixedMatrix operator/(FixedMatrix a, Scalar divisor) { return a /= divisor; }

  [[gnu::always_inline]] Scalar dot(const FixedMatrix& other) const {
    Scalar sum = 0;
    for (int i = 0; i < size; ++i) {
      sum += numbers_[std::size_t(i)] * other[i];
    }
    return sum;
  }
  Scalar squaredNorm() const { return dot(*this); }
  Scalar norm() const { return std::sqrt(squaredNorm()); }
  Scalar trace() const {
    Scalar sum = 0;
    for (int i = 0; i < Rows; ++i) {
      sum += (*this)(i, i);
    }
    return sum;
  }
  bool operator==(const FixedMatrix& other) const = default;
  bool isZero() const {
    for (const Scalar number : numbers_) {
      if (number != 0) {
        return false;
      }
    }
    return true;
  }
  /// Returns the largest magnitude of a number.
  Scalar largest() const {
    Scalar result = 0;
    for (const Scalar number : numbers_) {
      result = std::max(result, std::abs(number));
    }
    return result;
  }

 private:
  // Four floats or two doubles are one register.
  static constexpr std::size_t alignment = std::size_t(size) * sizeof(Scalar) % 16 == 0 ? 16 : alignof(Scalar);
  alignas(alignment) std::array<Scalar, std::size_t(size)> numbers_{};
};

/// Returns a matrix in numbers of another type.
template <class To, class Scalar, int Rows, int Columns>
FixedMatrix<To, Rows, Columns> rounded(const FixedMatrix<Scalar, Rows, Columns>& matrix) {
  FixedMatrix<To, Rows, Columns> result;
  for (int i = 0; i < Rows * Columns; ++i) {
    result[i] = To(matrix[i]);
  }
  return result;
}

/// Adds the product a b to a sum.
template <class Scalar, int Rows, int Inner, int Columns>
void add_product(FixedMatrix<Scalar, Rows, Columns>& sum, const FixedMatrix<Scalar, Rows, Inner>& a,
                 const FixedMatrix<Scalar, Inner, Columns>& b) {
  for (int column = 0; column < Columns; ++column) {
    for (int k = 0; k < Inner; ++k) {
      for (int row = 0; row < Rows; ++row) {
        sum(row, column) += a(row, k) * b(k, column);
      }
    }
  }
}

/// Adds the product aᵀ b to a sum.
template <class Scalar, int Rows, int Inner, int Columns>
void add_transposed_product(FixedMatrix<Scalar, Rows, Columns>& sum, const FixedMatrix<Scalar, Inner, Rows>& a,
                            const FixedMatrix<Scalar, Inner, Columns>& b) {
  for (int column = 0; column < Columns; ++column) {
    for (int row = 0; row < Rows; ++row) {
      Scalar one = 0;
      for (int k = 0; k < Inner; ++k) {
        one += a(k, row) * b(k, column);
      }
      sum(row, column) += one;
    }
  }
}

template <class Scalar, int Rows, int Inner, int Columns>
[[gnu::always_inline]] inline FixedMatrix<Scalar, Rows, Columns> operator*(
    const FixedMatrix<Scalar, Rows, Inner>& a, const FixedMatrix<Scalar, Inner, Columns>& b) {
  FixedMatrix<Scalar, Rows, Columns> product;
  for (int column = 0; column < Columns; ++column) {
    for (int row = 0; row < Rows; ++row) {
      product(row, column) = a(row, 0) * b(0, column);
    }
    for (int k = 1; k < Inner; ++k) {
      for (int row = 0; row < Rows; ++row) {
        product(row, column) += a(row, k) * b(k, column);
      }
    }
  }
  return product;
}

template <class Scalar, int Rows, int Columns>
[[gnu::always_inline]] inline FixedMatrix<Scalar, Columns, Rows> transposed(
    const FixedMatrix<Scalar, Rows, Columns>& matrix) {
  FixedMatrix<Scalar, Columns, Rows> result;
  for (int row = 0; row < Rows; ++row) {
    for (int column = 0; column < Columns; ++column) {
      result(column, row) = matrix(row, column);
    }
  }
  return result;
}

/// Returns the matrix a bᵀ.
template <class Scalar, int Rows, int Columns>
[[gnu::always_inline]] inline FixedMatrix<Scalar, Rows, Columns> outer_product(const FixedMatrix<Scalar, Rows>& a,
                                                                               const FixedMatrix<Scalar, Columns>& b) {
  FixedMatrix<Scalar, Rows, Columns> product;
  for (int column = 0; column < Columns; ++column) {
    for (int row = 0; row < Rows; ++row) {
      product(row, column) = a[row] * b[column];
    }
  }
  return product;
}

/// Returns the adjugate of a matrix of up to three rows: its inverse times its determinant.
template <class Scalar, int Rows>
[[gnu::always_inline]] inline FixedMatrix<Scalar, Rows, Rows> adjugate(const FixedMatrix<Scalar, Rows, Rows>& matrix) {
  FixedMatrix<Scalar, Rows, Rows> result;
  if constexpr (Rows == 1) {
    result[0] = 1;
  } else if constexpr (Rows == 2) {
    result(0, 0) = matrix(1, 1);
    result(1, 1) = matrix(0, 0);
    result(0, 1) = -matrix(0, 1);
    result(1, 0) = -matrix(1, 0);
  } else {
    static_assert(Rows == 3);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
        result(i, j) = matrix(r, c) * matrix(s, d) - matrix(r, d) * matrix(s, c);
      }
    }
  }
  return result;
}

/// Returns the determinant of a matrix, given its adjugate.
template <class Scalar, int Rows>
[[gnu::always_inline]] inline Scalar determinant(const FixedMatrix<Scalar, Rows, Rows>& matrix,
                                                 const FixedMatrix<Scalar, Rows, Rows>& adjugate) {
  Scalar sum = 0;
  for (int i = 0; i < Rows; ++i) {
    sum += matrix(0, i) * adjugate(i, 0);
  }
  return sum;
}

/// Returns the inverse of a symmetric positive definite matrix, by Gauss-Jordan elimination in double.
template <class Scalar, int Rows>
[[gnu::noinline]] FixedMatrix<Scalar, Rows, Rows> inverse_of_positive(const FixedMatrix<Scalar, Rows, Rows>& matrix) {
  std::array<double, std::size_t(Rows * Rows)> a{};
  const auto at = [&a](int row, int column) -> double& { return a[std::size_t(column * Rows + row)]; };
  for (int i = 0; i < Rows * Rows; ++i) {
    a[std::size_t(i)] = matrix[i];
  }
  for (int pivot = 0; pivot < Rows; ++pivot) {
    const double inverse = 1 / at(pivot, pivot);
    at(pivot, pivot) = 1;
    for (int column = 0; column < Rows; ++column) {
      at(pivot, column) *= inverse;
    }
    for (int row = 0; row < Rows; ++row) {
      if (row != pivot) {
        const double factor = at(row, pivot);
        at(row, pivot) = 0;
        for (int column = 0; column < Rows; ++column) {
          at(row, column) -= factor * at(pivot, column);
        }
      }
    }
  }
  FixedMatrix<Scalar, Rows, Rows> result;
  for (int i = 0; i < Rows * Rows; ++i) {
    result[i] = Scalar(a[std::size_t(i)]);
  }
  return result;
}

template <class Scalar, int Rows, int Columns>
[[gnu::always_inline]] inline FixedMatrix<Scalar, Rows> column(const FixedMatrix<Scalar, Rows, Columns>& matrix,
                                                               int i) {
  return FixedMatrix<Scalar, Rows>::from(matrix.data() + i * Rows);
}

template <class Scalar, int Rows, int Columns>
[[gnu::always_inline]] inline void set_column(FixedMatrix<Scalar, Rows, Columns>& matrix, int i,
                                              const FixedMatrix<Scalar, Rows>& column) {
  for (int row = 0; row < Rows; ++row) {
    matrix(row, i) = column[row];
  }
}

/// Adds the matrix factor · a aᵀ to a sum.
template <class Scalar, int Size>
[[gnu::always_inline]] inline void add_square(FixedMatrix<Scalar, Size, Size>& sum, Scalar factor,
                                              const FixedMatrix<Scalar, Size>& a) {
  for (int column = 0; column < Size; ++column) {
    const Scalar scaled = factor * a[column];
    for (int row = 0; row < Size; ++row) {
      sum(row, column) += scaled * a[row];
    }
  }
}

}  // namespace chainmail
