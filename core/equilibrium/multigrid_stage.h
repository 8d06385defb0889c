#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "equilibrium/coarse_matrix.h"
#include "equilibrium/rigid_transfer.h"

namespace chainmail {

/// The transfer from one level to the next coarser one, and the smoother. Rows of `Rows` unknowns each, for
/// each of `Columns` right-hand sides.
template <int Rows, int Dimension, int Columns>
class MultigridStage {
 public:
  using Square = FixedMatrix<float, Rows, Rows>;
  using Vector = FixedMatrix<float, Rows, Columns>;
  using Vectors = std::vector<Vector>;
  using Matrix = LevelMatrix<Rows, Columns>;
  using Transfer = RigidTransfer<Rows, Dimension>;
  using Ids = typename Transfer::Ids;
  using Frames = typename Transfer::Frames;
  using Coarse = CoarseMatrix<Transfer::modes, Columns>;

  /// Prepares the smoother. `radius`: largest eigenvalue of the matrix after division by its diagonal blocks, 0 if it
  /// is not known.
  void build_smoother(Matrix& matrix, float radius = 0) {
    transfer_.find_inverses(matrix);
    radius_ = radius > 0 ? radius : estimate_radius(matrix);
  }
  /// Updates the smoother after a row of the matrix changed.
  void update_inverse(Matrix& matrix, std::uint32_t row) { transfer_.update_inverse(matrix, row); }

  /// Forms the aggregates, and returns their number. `frames`: of the rows.
  std::uint32_t aggregate(Matrix& matrix, Frames frames) {
    transfer_.aggregate(matrix, std::move(frames));
    return transfer_.aggregate_count();
  }
  void build_coarse(Matrix& matrix, Coarse& coarse, const Progress& progress) {
    transfer_.build_coarse(matrix, radius_, coarse.rows, progress);
  }
  const Frames& frames_of_aggregates() const { return transfer_.frames_of_aggregates(); }
  /// Adds rows, each of which joins the aggregate of an older row.
  void append(const Ids& like, const Frames& all_frames) { transfer_.append(like, all_frames); }
  /// Updates everything that depends on these rows of the matrix. If links were cut, aggregates that have come apart
  /// are split.
  LevelChanges update(Matrix& matrix, const Ids& rows, bool cut, Coarse& coarse) {
    return transfer_.update(matrix, radius_, rows, cut, coarse.rows);
  }

  void smooth(const Matrix& matrix, const Vectors& right, Vectors& x, bool from_zero, const SharedLoop& shared) {
    // Chebyshev polynomial of degree 2 (Adams et al. 2003).
    const float high = 1.02F * radius_, low = radius_ / 8;
    const float middle = (high + low) / 2, half = (high - low) / 2;
    const float sigma = middle / half;
    x.resize(right.size());
    if (!from_zero) {
      matrix.apply(x, product_, shared);
    }
    step_.resize(right.size());
    const std::vector<Square>& inverses = transfer_.inverses();
    // A copy of a number stays in a register.
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      const float divisor = middle;
      for (std::size_t i = first; i < last; ++i) {
        step_[i] = inverses[i] * (from_zero ? right[i] : right[i] - product_[i]) / divisor;
        x[i] = from_zero ? step_[i] : x[i] + step_[i];
      }
    });
    const float rho = 1 / sigma, next = 1 / (2 * sigma - rho), of_step = next * rho, of_scaled = 2 * next / half;
    matrix.apply(x, product_, shared);
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      const float a = of_step, b = of_scaled;
      for (std::size_t i = first; i < last; ++i) {
        const Vector scaled = inverses[i] * (right[i] - product_[i]);
        x[i] += a * step_[i] + b * scaled;
      }
    });
  }

  /// Writes the residual's coarse right-hand side.
  void restrict_residual(const Matrix& matrix, const Vectors& right, const Vectors& x,
                         typename Coarse::Vectors& coarse_right, const SharedLoop& shared) {
    matrix.apply(x, product_, shared);
    // The number of parts depends on the number of rows alone, and so do the bits of the sum.
    constexpr std::size_t worth = 8192, most = 8;
    const std::size_t rows = right.size(), parts = std::clamp<std::size_t>(rows / worth, 1, most);
    restricted_.resize(parts - 1);
    shared.each(parts, [&](std::size_t part) {
      restrict_rows(rows * part / parts, rows * (part + 1) / parts, right,
                    part == 0 ? coarse_right : restricted_[part - 1]);
    });
    for (const typename Coarse::Vectors& one : restricted_) {
      shared.run(one.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
          coarse_right[a] += one[a];
        }
      });
    }
  }

  void prolong(const typename Coarse::Vectors& coarse, Vectors& x, const SharedLoop& shared) const {
    const auto& transfers = transfer_.transfer();
    shared.run(x.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) {
        const auto columns = transfers.columns(static_cast<std::uint32_t>(row));
        const auto blocks = transfers.blocks(static_cast<std::uint32_t>(row));
        for (std::size_t k = 0; k < columns.size(); ++k) {
          add_product(x[row], blocks[k], coarse[columns[k]]);
        }
      }
    });
  }

 private:
  static constexpr int power_iterations = 10;

  /// Writes the coarse right-hand side of the residual in these rows.
  void restrict_rows(std::size_t first, std::size_t last, const Vectors& right,
                     typename Coarse::Vectors& coarse_right) const {
    const auto& transfers = transfer_.transfer();
    coarse_right.assign(transfer_.aggregate_count(), {});
    for (std::size_t row = first; row < last; ++row) {
      const Vector residual = right[row] - product_[row];
      const auto columns = transfers.columns(static_cast<std::uint32_t>(row));
      const auto blocks = transfers.blocks(static_cast<std::uint32_t>(row));
      for (std::size_t k = 0; k < columns.size(); ++k) {
        add_transposed_product(coarse_right[columns[k]], blocks[k], residual);
      }
    }
  }

  /// Returns the largest eigenvalue of the matrix after division by its diagonal blocks.
  float estimate_radius(const Matrix& matrix) const {
    Vectors x(matrix.size()), product;
    std::uint32_t state = 1;
    for (Vector& one : x) {
      for (int k = 0; k < Rows * Columns; ++k) {
        state = state * 1664525U + 1013904223U;
        one(k / Columns, k % Columns) = float(state >> 8) / float(1 << 24) - 0.5F;
      }
    }
    float radius = 1;
    for (int i = 0; i < power_iterations; ++i) {
      matrix.apply(x, product, {});
      double square = 0;
      for (std::size_t row = 0; row < x.size(); ++row) {
        x[row] = transfer_.inverses()[row] * product[row];
        square += double(x[row].squaredNorm());
      }
      radius = float(std::sqrt(square));
      if (!(radius > 0)) {
        return 1;
      }
      for (Vector& one : x) {
        one /= radius;
      }
    }
    return 1.1F * radius;
  }

  Transfer transfer_;
  float radius_ = 1;  // largest eigenvalue of the matrix after division by the diagonal blocks
  Vectors product_, step_;
  std::vector<typename Coarse::Vectors> restricted_;  // of the second part of the rows, the third, ...
};

}  // namespace chainmail
