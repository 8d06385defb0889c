#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "equilibrium/aggregates.h"
#include "equilibrium/coarse_matrix.h"
#include "equilibrium/link_matrix.h"
#include "equilibrium/unique_ids.h"
#include "mesh/fixed_matrix.h"
#include "mesh/progress.h"

namespace chainmail {

/// A rigid body: the elements below a row of a coarse level.
template <int Dimension>
struct RigidFrame {
  FixedMatrix<float, Dimension> centre;
  float size = 0;  // by which rotations are divided, so that all unknowns are lengths; 0 for an element
};

/// Returns the motion of a row of `Rows` unknowns if the aggregate around it moves as a rigid body: a column for each
/// axis, then one for a rotation by 1 about each axis.
template <int Rows, int Dimension>
FixedMatrix<float, Rows, rigid_modes<Dimension>> rigid_motion(const RigidFrame<Dimension>& row,
                                                              const RigidFrame<Dimension>& aggregate) {
  FixedMatrix<float, Rows, rigid_modes<Dimension>> motion;
  for (int i = 0; i < Dimension; ++i) {
    motion(i, i) = 1;
  }
  const FixedMatrix<float, Dimension> arm = (row.centre - aggregate.centre) / aggregate.size;
  if constexpr (Dimension == 2) {
    motion(0, 2) = -arm[1];
    motion(1, 2) = arm[0];
  } else if constexpr (Dimension == 3) {
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      motion(next, 3 + i) = -arm[last];
      motion(last, 3 + i) = arm[next];
    }
  }
  for (int i = Dimension; i < Rows; ++i) {
    motion(i, i) = row.size / aggregate.size;
  }
  return motion;
}

/// What an update changes on the next level.
struct LevelChanges {
  std::vector<std::uint32_t> rows;  // rows of the coarse matrix that changed
  std::vector<std::uint32_t> like;  // of each new row of the coarse matrix: the row that it was split from
};

/// The blocks of a transfer that reach wanted columns.
struct TransferTerms {
  std::vector<std::uint32_t> first;                 // of each wanted column: its first term
  std::vector<std::array<std::uint32_t, 2>> terms;  // row, and number of the block in the row
};

/// Finds the blocks in these rows of a transfer with `width` columns that are in wanted columns (ascending).
TransferTerms terms_of(const BlockColumns& transfer, std::span<const std::uint32_t> rows,
                       std::span<const std::uint32_t> wanted, std::uint32_t width);

/// The aggregates of the rows of a level, and the transfer from it to the next coarser level. Rows of `Rows` unknowns
/// each. This prepares a level; MultigridStage uses what it has prepared.
template <int Rows, int Dimension>
class RigidTransfer {
 public:
  static constexpr int modes = rigid_modes<Dimension>;
  using Square = FixedMatrix<float, Rows, Rows>;
  using Transfer = FixedMatrix<float, Rows, modes>;
  using Frames = std::vector<RigidFrame<Dimension>>;
  using CoarseSquare = FixedMatrix<float, modes, modes>;
  using CoarseRows = BlockRows<CoarseSquare>;
  using Matrix = RowReader<Rows>;
  using Ids = Aggregates::Ids;

  const std::vector<Square>& inverses() const { return inverse_; }
  const BlockRows<Transfer>& transfer() const { return transfer_; }
  const Frames& frames_of_aggregates() const { return coarse_frames_; }
  std::uint32_t aggregate_count() const { return aggregates_.size(); }

  void find_inverses(Matrix& matrix);
  /// Updates the inverse of the diagonal block after a row of the matrix changed.
  void update_inverse(Matrix& matrix, std::uint32_t row);
  /// Forms the aggregates. `frames`: of the rows.
  void aggregate(Matrix& matrix, Frames frames);
  /// `radius`: largest eigenvalue of the matrix after division by its diagonal blocks.
  void build_coarse(Matrix& matrix, float radius, CoarseRows& coarse, const Progress& progress);
  /// Adds rows, each of which joins the aggregate of an older row.
  void append(const Ids& like, const Frames& all_frames);

  /// Updates everything that depends on these rows of the matrix. If links were cut, aggregates that have come apart
  /// are split.
  LevelChanges update(Matrix& matrix, float radius, const Ids& rows, bool cut, CoarseRows& coarse);

 private:
  /// The products of numbers are kept, so that an update computes only those that changed; products of blocks are too
  /// large.
  static constexpr bool keeps_products = Rows == 1;

  Aggregates::Couplings couplings_of(Matrix& matrix);
  Ids split(Matrix& matrix, const Ids& rows, Ids& like);
  void append_columns(const Ids& rows, Ids& columns) const;
  void update_coarse_rows(Matrix& matrix, const Ids& changed, const Ids& touched, CoarseRows& coarse);
  RigidFrame<Dimension> frame_of(std::uint32_t aggregate) const;
  void update_transfer(Matrix& matrix, float radius, std::uint32_t row);
  void update_product(Matrix& matrix, std::uint32_t row);
  void release_products() {
    if (!keeps_products) {
      products_ = {};
    }
  }
  void set_coarse_rows(const Ids& rows, const Ids& wanted, CoarseRows& coarse);

  std::vector<Square> inverse_;  // of the diagonal blocks
  Frames frames_, coarse_frames_;
  Aggregates aggregates_;
  std::vector<Aggregates::Coupling> couplings_;  // of one row
  BlockRows<Transfer> transfer_;
  BlockRows<Transfer> products_;  // A P; see keeps_products
  RowSum<Transfer> transfer_sum_, product_sum_;
  RowSum<CoarseSquare> coarse_sum_;
};

/// Returns the inverse of a symmetric block, with a little added to its diagonal: it may be singular.
template <int Rows>
FixedMatrix<float, Rows, Rows> safe_inverse(const FixedMatrix<float, Rows, Rows>& block) {
  const float mean = block.trace() / float(Rows);
  if (!(mean > std::numeric_limits<float>::min())) {
    return {};
  }
  return inverse_of_positive(block / mean + 1e-5F * FixedMatrix<float, Rows, Rows>::Identity()) / mean;
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::find_inverses(Matrix& matrix) {
  inverse_.resize(matrix.size());
  for (std::uint32_t row = 0; row < matrix.size(); ++row) {
    update_inverse(matrix, row);
  }
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::update_inverse(Matrix& matrix, std::uint32_t row) {
  const auto [columns, blocks] = matrix.row(row);
  const auto found = std::ranges::find(columns, row);
  inverse_[row] = found != columns.end() ? safe_inverse(blocks[std::size_t(found - columns.begin())]) : Square();
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] Aggregates::Couplings RigidTransfer<Rows, Dimension>::couplings_of(Matrix& matrix) {
  return [&](std::uint32_t row) -> std::span<const Aggregates::Coupling> {
    const auto [columns, blocks] = matrix.row(row);
    couplings_.resize(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      couplings_[k] = {columns[k], blocks[k].squaredNorm()};
    }
    return couplings_;
  };
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::aggregate(Matrix& matrix, Frames frames) {
  frames_ = std::move(frames);
  aggregates_.form(matrix.size(), couplings_of(matrix));
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::build_coarse(Matrix& matrix, float radius,
                                                                                  CoarseRows& coarse,
                                                                                  const Progress& progress) {
  coarse_frames_.resize(aggregates_.size());
  for (std::uint32_t a = 0; a < aggregates_.size(); ++a) {
    coarse_frames_[a] = frame_of(a);
  }
  transfer_.resize(matrix.size());
  for (std::uint32_t row = 0; row < matrix.size(); ++row) {
    progress.part(0, 0.5).report(row, matrix.size());
    update_transfer(matrix, radius, row);
  }
  coarse.resize(aggregates_.size());
  products_.resize(matrix.size());
  for (std::uint32_t row = 0; row < matrix.size(); ++row) {
    progress.part(0.5, 0.8).report(row, matrix.size());
    update_product(matrix, row);
  }
  Ids rows(matrix.size()), all(aggregates_.size());
  std::iota(rows.begin(), rows.end(), 0U);
  std::iota(all.begin(), all.end(), 0U);
  set_coarse_rows(rows, all, coarse);
  release_products();
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::append(const Ids& like, const Frames& all_frames) {
  frames_ = all_frames;
  for (const std::uint32_t row : like) {
    aggregates_.append_like(row);
  }
  inverse_.resize(aggregates_.row_count());
  transfer_.resize(aggregates_.row_count());
  products_.resize(keeps_products ? transfer_.size() : 0);
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] auto RigidTransfer<Rows, Dimension>::update(Matrix& matrix, float radius,
                                                                            const Ids& rows, bool cut,
                                                                            CoarseRows& coarse) -> LevelChanges {
  LevelChanges changes;
  Ids moved = rows;  // rows whose transfer to the coarse level changes
  for (const std::uint32_t row : rows) {
    update_inverse(matrix, row);
  }
  if (cut) {
    const Ids split_off = split(matrix, rows, changes.like);
    moved.insert(moved.end(), split_off.begin(), split_off.end());
    make_unique(moved);
    coarse.resize(aggregates_.size());
  }
  const Ids around = aggregates_.with_neighbours(moved, couplings_of(matrix));  // rows whose product changes
  append_columns(around, changes.rows);
  for (const std::uint32_t row : moved) {
    update_transfer(matrix, radius, row);
  }
  append_columns(moved, changes.rows);
  make_unique(changes.rows);
  update_coarse_rows(matrix, around, changes.rows, coarse);
  return changes;
}

/// Splits aggregates. Returns the rows that got another one, and their neighbours.
template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] auto RigidTransfer<Rows, Dimension>::split(Matrix& matrix, const Ids& rows, Ids& like)
    -> Ids {
  const Aggregates::Couplings couplings = couplings_of(matrix);
  const Ids moved = aggregates_.split(
      rows, couplings, [&](std::uint32_t row) { return inverse_[row].isZero(); }, like);
  while (coarse_frames_.size() < aggregates_.size()) {
    coarse_frames_.push_back(frame_of(static_cast<std::uint32_t>(coarse_frames_.size())));
  }
  return aggregates_.with_neighbours(moved, couplings);
}

/// Adds the rows of the coarse matrix to which these rows transfer.
template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::append_columns(const Ids& rows,
                                                                                    Ids& columns) const {
  for (const std::uint32_t row : rows) {
    const auto some = transfer_.columns(row);
    columns.insert(columns.end(), some.begin(), some.end());
  }
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::update_coarse_rows(Matrix& matrix,
                                                                                        const Ids& changed,
                                                                                        const Ids& touched,
                                                                                        CoarseRows& coarse) {
  const Ids rows = aggregates_.with_neighbours(aggregates_.members_of(touched), couplings_of(matrix));
  products_.resize(matrix.size());
  for (const std::uint32_t row : keeps_products ? changed : rows) {
    update_product(matrix, row);
  }
  set_coarse_rows(rows, touched, coarse);
  release_products();
}

template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] RigidFrame<Dimension> RigidTransfer<Rows, Dimension>::frame_of(
    std::uint32_t aggregate) const {
  const Ids& members = aggregates_.members(aggregate);
  RigidFrame<Dimension> frame;
  for (const std::uint32_t row : members) {
    frame.centre += frames_[row].centre;
  }
  frame.centre /= float(members.size());
  float square = 0;
  for (const std::uint32_t row : members) {
    square += (frames_[row].centre - frame.centre).squaredNorm() + frames_[row].size * frames_[row].size;
  }
  frame.size = std::sqrt(square / float(members.size()));
  if (!(frame.size > 0)) {
    frame.size = 1;
  }
  return frame;
}

/// Rigid motions of the aggregates, smoothed by one step of damped Jacobi.
template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::update_transfer(Matrix& matrix, float radius,
                                                                                     std::uint32_t row) {
  transfer_sum_.begin(aggregates_.size());
  const auto [columns, blocks] = matrix.row(row);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::uint32_t aggregate = aggregates_.of(columns[k]);
    if (aggregate != Aggregates::none) {
      const Transfer motion = rigid_motion<Rows, Dimension>(frames_[columns[k]], coarse_frames_[aggregate]);
      const Square damped = (-4.0F / 3 / radius) * (inverse_[row] * blocks[k]);
      Transfer& sum = transfer_sum_.at(aggregate);
      add_product(sum, damped, motion);
      if (columns[k] == row) {
        sum += motion;
      }
    }
  }
  transfer_.set_row(row, transfer_sum_.columns, transfer_sum_.blocks);
}

/// Computes a row of A P.
template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::update_product(Matrix& matrix, std::uint32_t row) {
  product_sum_.begin(aggregates_.size());
  const auto [columns, blocks] = matrix.row(row);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto coarse_columns = transfer_.columns(columns[k]);
    const auto coarse_blocks = transfer_.blocks(columns[k]);
    for (std::size_t c = 0; c < coarse_columns.size(); ++c) {
      add_product(product_sum_.at(coarse_columns[c]), blocks[k], coarse_blocks[c]);
    }
  }
  products_.set_row(row, product_sum_.columns, product_sum_.blocks);
}

/// Sums up the wanted rows of Pᵀ A P (ascending) from the products in `rows`.
template <int Rows, int Dimension>
[[gnu::noinline, gnu::noclone]] void RigidTransfer<Rows, Dimension>::set_coarse_rows(const Ids& rows, const Ids& wanted,
                                                                                     CoarseRows& coarse) {
  const auto [first, terms] = terms_of(transfer_, rows, wanted, aggregates_.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    coarse_sum_.begin(aggregates_.size());
    for (std::uint32_t t = first[i]; t < first[i + 1]; ++t) {
      const auto [row, k] = terms[t];
      const auto columns = products_.columns(row);
      const auto blocks = products_.blocks(row);
      const Transfer& transfer = transfer_.blocks(row)[k];
      for (std::size_t c = 0; c < columns.size(); ++c) {
        add_transposed_product(coarse_sum_.at(columns[c]), transfer, blocks[c]);
      }
    }
    coarse.set_row(wanted[i], coarse_sum_.columns, coarse_sum_.blocks);
  }
}

}  // namespace chainmail
