#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "equilibrium/coarse_matrix.h"
#include "equilibrium/link_matrix.h"
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

/// The transfer from one level to the next coarser one, and the smoother. Rows of `Rows` unknowns each, for
/// each of `Columns` right-hand sides.
template <int Rows, int Dimension, int Columns = 1>
class MultigridStage {
 public:
  static constexpr int modes = rigid_modes<Dimension>;
  using Square = FixedMatrix<float, Rows, Rows>;
  using Vector = FixedMatrix<float, Rows, Columns>;
  using Vectors = std::vector<Vector>;
  using Transfer = FixedMatrix<float, Rows, modes>;
  using Frames = std::vector<RigidFrame<Dimension>>;
  using Coarse = CoarseMatrix<modes, Columns>;

  /// Prepares the smoother.
  template <class Matrix>
  void build_smoother(const Matrix& matrix) {
    inverse_.resize(matrix.size());
    for (std::uint32_t row = 0; row < matrix.size(); ++row) {
      update_inverse(matrix, row);
    }
    radius_ = estimate_radius(matrix);
  }

  /// Forms the aggregates, and returns their number. `frames`: of the rows.
  template <class Matrix>
  std::uint32_t aggregate(const Matrix& matrix, Frames frames) {
    frames_ = std::move(frames);
    find_aggregates(matrix);
    return static_cast<std::uint32_t>(members_.size());
  }

  template <class Matrix>
  void build_coarse(const Matrix& matrix, Coarse& coarse, const Progress& progress) {
    coarse_frames_.resize(members_.size());
    for (std::uint32_t a = 0; a < members_.size(); ++a) {
      coarse_frames_[a] = frame_of(a);
    }
    transfer_.resize(matrix.size());
    for (std::uint32_t row = 0; row < matrix.size(); ++row) {
      progress.part(0, 0.5).report(row, matrix.size());
      update_transfer(matrix, row);
    }
    coarse.rows.resize(static_cast<std::uint32_t>(members_.size()));
    products_.resize(matrix.size());
    for (std::uint32_t row = 0; row < matrix.size(); ++row) {
      progress.part(0.5, 0.8).report(row, matrix.size());
      update_product(matrix, row);
    }
    std::vector<std::uint32_t> rows(matrix.size()), all(members_.size());
    std::iota(rows.begin(), rows.end(), 0U);
    std::iota(all.begin(), all.end(), 0U);
    progress.report(0.8);
    set_coarse_rows(rows, all, coarse);
    release_products();
  }

  template <class Matrix>
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
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        step_[i] = inverse_[i] * (from_zero ? right[i] : right[i] - product_[i]) / middle;
        x[i] = from_zero ? step_[i] : x[i] + step_[i];
      }
    });
    const float rho = 1 / sigma, next = 1 / (2 * sigma - rho);
    matrix.apply(x, product_, shared);
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Vector scaled = inverse_[i] * (right[i] - product_[i]);
        x[i] += next * rho * step_[i] + 2 * next / half * scaled;
      }
    });
  }

  /// Writes the residual's coarse right-hand side.
  template <class Matrix>
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
    shared.run(x.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t row = first; row < last; ++row) {
        const auto columns = transfer_.columns(static_cast<std::uint32_t>(row));
        const auto blocks = transfer_.blocks(static_cast<std::uint32_t>(row));
        for (std::size_t k = 0; k < columns.size(); ++k) {
          add_product(x[row], blocks[k], coarse[columns[k]]);
        }
      }
    });
  }

  /// Adds rows, each of which joins the aggregate of an older row.
  void append(const std::vector<std::uint32_t>& like, const Frames& all_frames) {
    frames_ = all_frames;
    for (const std::uint32_t row : like) {
      aggregate_.push_back(aggregate_[row]);
      if (aggregate_.back() != none) {
        members_[aggregate_.back()].push_back(static_cast<std::uint32_t>(aggregate_.size() - 1));
      }
    }
    inverse_.resize(aggregate_.size());
    transfer_.resize(static_cast<std::uint32_t>(aggregate_.size()));
    products_.resize(keeps_products ? transfer_.size() : 0);
  }

  /// Updates the smoother after a row of the matrix changed.
  template <class Matrix>
  void update_inverse(const Matrix& matrix, std::uint32_t row) {
    Square diagonal;
    matrix.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
      if (column == row) {
        diagonal = block;
      }
    });
    inverse_[row] = safe_inverse(diagonal);
  }

  const Frames& frames_of_aggregates() const { return coarse_frames_; }

  /// What an update changes on the next level.
  struct Changes {
    std::vector<std::uint32_t> rows;  // rows of the coarse matrix that changed
    std::vector<std::uint32_t> like;  // of each new row of the coarse matrix: the row that it was split from
  };

  /// Updates everything that depends on these rows of the matrix. If links were cut, aggregates that have come apart
  /// are split.
  template <class Matrix>
  Changes update(const Matrix& matrix, const std::vector<std::uint32_t>& rows, bool cut, Coarse& coarse) {
    Changes changes;
    std::vector<std::uint32_t> moved = rows;  // rows whose transfer to the coarse level changes
    for (const std::uint32_t row : rows) {
      update_inverse(matrix, row);
    }
    if (cut) {
      const std::vector<std::uint32_t> split = with_neighbours(matrix, split_aggregates(matrix, rows, changes.like));
      moved.insert(moved.end(), split.begin(), split.end());
      make_unique(moved);
      coarse.rows.resize(static_cast<std::uint32_t>(members_.size()));
    }
    const auto touch = [&](const std::vector<std::uint32_t>& some) {
      for (const std::uint32_t row : some) {
        const auto columns = transfer_.columns(row);
        changes.rows.insert(changes.rows.end(), columns.begin(), columns.end());
      }
    };
    const std::vector<std::uint32_t> around = with_neighbours(matrix, moved);  // rows whose product changes
    touch(around);
    for (const std::uint32_t row : moved) {
      update_transfer(matrix, row);
    }
    touch(moved);
    make_unique(changes.rows);
    update_coarse_rows(matrix, around, changes.rows, coarse);
    return changes;
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// Two rows whose coupling is below this share of their diagonal blocks do not join an aggregate.
  static constexpr float weak_coupling = 0.01F;
  static constexpr int power_iterations = 10;
  /// The products of numbers are kept, so that an update computes only those that changed; products of blocks are too
  /// large.
  static constexpr bool keeps_products = Rows == 1;

  /// Writes the coarse right-hand side of the residual in these rows.
  void restrict_rows(std::size_t first, std::size_t last, const Vectors& right,
                     typename Coarse::Vectors& coarse_right) const {
    coarse_right.assign(members_.size(), {});
    for (std::size_t row = first; row < last; ++row) {
      const Vector residual = right[row] - product_[row];
      const auto columns = transfer_.columns(static_cast<std::uint32_t>(row));
      const auto blocks = transfer_.blocks(static_cast<std::uint32_t>(row));
      for (std::size_t k = 0; k < columns.size(); ++k) {
        add_transposed_product(coarse_right[columns[k]], blocks[k], residual);
      }
    }
  }

  /// Returns the inverse of a symmetric block, with a little added to its diagonal: it may be singular.
  static Square safe_inverse(const Square& block) {
    const float mean = block.trace() / float(Rows);
    if (!(mean > std::numeric_limits<float>::min())) {
      return {};
    }
    return inverse_of_positive(block / mean + 1e-5F * Square::Identity()) / mean;
  }

  static void make_unique(std::vector<std::uint32_t>& ids) {
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  template <class Matrix>
  std::vector<std::uint32_t> with_neighbours(const Matrix& matrix, const std::vector<std::uint32_t>& rows) {
    std::vector<std::uint32_t> result;
    const auto add = [&](std::uint32_t row) {
      if (std::exchange(is_found_[row], 1) == 0) {
        result.push_back(row);
      }
    };
    is_found_.resize(matrix.size());
    for (const std::uint32_t row : rows) {
      add(row);
      matrix.for_each_in_row(row, [&](std::uint32_t column, const Square&) { add(column); });
    }
    for (const std::uint32_t row : result) {
      is_found_[row] = 0;
    }
    std::ranges::sort(result);
    return result;
  }

  /// Splits the aggregates of these rows where no couplings hold them together. Returns the rows that got another
  /// aggregate, and adds to `like` the aggregate that each new one was split from.
  template <class Matrix>
  std::vector<std::uint32_t> split_aggregates(const Matrix& matrix, const std::vector<std::uint32_t>& rows,
                                              std::vector<std::uint32_t>& like) {
    std::vector<std::uint32_t> suspects, moved;
    for (const std::uint32_t row : rows) {
      if (aggregate_[row] != none) {
        suspects.push_back(aggregate_[row]);
      }
    }
    make_unique(suspects);
    for (const std::uint32_t a : suspects) {
      std::vector<std::vector<std::uint32_t>> parts = parts_of(matrix, a);
      for (std::size_t i = 1; i < parts.size(); ++i) {
        const auto fresh = static_cast<std::uint32_t>(members_.size());
        for (const std::uint32_t row : parts[i]) {
          aggregate_[row] = fresh;
        }
        moved.insert(moved.end(), parts[i].begin(), parts[i].end());
        members_.push_back(std::move(parts[i]));
        coarse_frames_.push_back(frame_of(fresh));
        like.push_back(a);
      }
      members_[a] = std::move(parts[0]);
    }
    return moved;
  }

  /// Returns the members of an aggregate, in parts that couplings hold together. Fixed rows are in the first part.
  template <class Matrix>
  std::vector<std::vector<std::uint32_t>> parts_of(const Matrix& matrix, std::uint32_t aggregate) {
    std::vector<std::vector<std::uint32_t>> parts(1);
    std::vector<std::uint32_t> left;
    for (const std::uint32_t row : members_[aggregate]) {
      (inverse_[row].isZero() ? parts[0] : left).push_back(row);
    }
    while (!left.empty()) {
      std::vector<std::uint32_t> part{left.back()};
      left.pop_back();
      for (std::size_t i = 0; i < part.size(); ++i) {
        matrix.for_each_in_row(part[i], [&](std::uint32_t column, const Square& block) {
          const auto found = block.isZero() ? left.end() : std::ranges::find(left, column);
          if (found != left.end()) {
            part.push_back(column);
            left.erase(found);
          }
        });
      }
      parts.push_back(std::move(part));
    }
    if (parts[0].empty() && parts.size() > 1) {
      parts.erase(parts.begin());
    }
    return parts;
  }

  template <class Matrix>
  void update_coarse_rows(const Matrix& matrix, const std::vector<std::uint32_t>& changed,
                          const std::vector<std::uint32_t>& touched, Coarse& coarse) {
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t a : touched) {
      rows.insert(rows.end(), members_[a].begin(), members_[a].end());
    }
    rows = with_neighbours(matrix, rows);
    products_.resize(matrix.size());
    for (const std::uint32_t row : keeps_products ? changed : rows) {
      update_product(matrix, row);
    }
    set_coarse_rows(rows, touched, coarse);
    release_products();
  }

  /// Returns the largest eigenvalue of the matrix after division by its diagonal blocks.
  template <class Matrix>
  float estimate_radius(const Matrix& matrix) {
    if constexpr (requires { matrix.mesh(); }) {
      return 2;  // a bound for every energy of links, since |a − b|² ≤ 2|a|² + 2|b|²
    }
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
        x[row] = inverse_[row] * product[row];
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

  template <class Matrix>
  void find_aggregates(const Matrix& matrix) {
    const std::uint32_t size = matrix.size();
    aggregate_.assign(size, none);
    std::vector<float> scale(size);
    for (std::uint32_t row = 0; row < size; ++row) {
      matrix.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
        if (column == row) {
          scale[row] = block.norm();
        }
      });
    }
    const auto for_each_strong = [&](std::uint32_t row, auto visit) {
      matrix.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
        if (column != row && block.squaredNorm() > weak_coupling * weak_coupling * scale[row] * scale[column]) {
          visit(column, block);
        }
      });
    };
    members_.clear();
    for (std::uint32_t row = 0; row < size; ++row) {
      if (aggregate_[row] != none) {
        continue;
      }
      bool is_free = true, is_alone = true;
      for_each_strong(row, [&](std::uint32_t column, const Square&) {
        is_free = is_free && aggregate_[column] == none;
        is_alone = false;
      });
      if (is_free && !is_alone) {
        const auto a = static_cast<std::uint32_t>(members_.size());
        aggregate_[row] = a;
        members_.push_back({row});
        for_each_strong(row, [&](std::uint32_t column, const Square&) {
          aggregate_[column] = a;
          members_[a].push_back(column);
        });
      }
    }
    std::vector<std::uint32_t> joined(size, none);
    for (std::uint32_t row = 0; row < size; ++row) {
      float strongest = 0;
      if (aggregate_[row] == none) {
        for_each_strong(row, [&](std::uint32_t column, const Square& block) {
          const float strength = block.squaredNorm() / scale[column];
          if (aggregate_[column] != none && strength > strongest) {
            strongest = strength;
            joined[row] = aggregate_[column];
          }
        });
      }
    }
    for (std::uint32_t row = 0; row < size; ++row) {
      if (joined[row] != none) {
        aggregate_[row] = joined[row];
        members_[joined[row]].push_back(row);
      }
    }
  }

  RigidFrame<Dimension> frame_of(std::uint32_t aggregate) const {
    RigidFrame<Dimension> frame;
    for (const std::uint32_t row : members_[aggregate]) {
      frame.centre += frames_[row].centre;
    }
    frame.centre /= float(members_[aggregate].size());
    float square = 0;
    for (const std::uint32_t row : members_[aggregate]) {
      square += (frames_[row].centre - frame.centre).squaredNorm() + frames_[row].size * frames_[row].size;
    }
    frame.size = std::sqrt(square / float(members_[aggregate].size()));
    if (!(frame.size > 0)) {
      frame.size = 1;
    }
    return frame;
  }

  Transfer rigid(std::uint32_t row) const {
    return rigid_motion<Rows, Dimension>(frames_[row], coarse_frames_[aggregate_[row]]);
  }

  /// Rigid motions of the aggregates, smoothed by one step of damped Jacobi.
  template <class Matrix>
  void update_transfer(const Matrix& matrix, std::uint32_t row) {
    transfer_sum_.begin(members_.size());
    matrix.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
      if (aggregate_[column] != none) {
        const Transfer motion = rigid(column);
        const Square damped = (-4.0F / 3 / radius_) * (inverse_[row] * block);
        Transfer& sum = transfer_sum_.at(aggregate_[column]);
        add_product(sum, damped, motion);
        if (column == row) {
          sum += motion;
        }
      }
    });
    transfer_.set_row(row, transfer_sum_.columns, transfer_sum_.blocks);
  }

  /// Computes a row of A P.
  template <class Matrix>
  void update_product(const Matrix& matrix, std::uint32_t row) {
    product_sum_.begin(members_.size());
    matrix.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
      const auto columns = transfer_.columns(column);
      const auto blocks = transfer_.blocks(column);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        add_product(product_sum_.at(columns[k]), block, blocks[k]);
      }
    });
    products_.set_row(row, product_sum_.columns, product_sum_.blocks);
  }
  void release_products() {
    if (!keeps_products) {
      products_ = {};
    }
  }

  /// Sums up the wanted rows of Pᵀ A P (ascending) from the products in `rows`.
  void set_coarse_rows(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& wanted,
                       Coarse& coarse) {
    std::vector<std::uint32_t> number(members_.size());  // of each row that is wanted, from 1
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
      number[wanted[i]] = i + 1;
    }
    // Each (row, place in its transfer) of a wanted row follows those of the wanted row before.
    std::vector<std::uint32_t> first(wanted.size() + 1);
    for_each_transfer(rows, number, [&](std::uint32_t, std::uint32_t, std::uint32_t i) { ++first[i]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next = first;
    std::vector<std::array<std::uint32_t, 2>> terms(first.back());
    for_each_transfer(rows, number, [&](std::uint32_t row, std::uint32_t k, std::uint32_t i) {
      terms[next[i - 1]++] = {row, k};
    });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      coarse_sum_.begin(members_.size());
      for (std::uint32_t t = first[i]; t < first[i + 1]; ++t) {
        const auto [row, k] = terms[t];
        const auto columns = products_.columns(row);
        const auto blocks = products_.blocks(row);
        const Transfer& transfer = transfer_.blocks(row)[k];
        for (std::size_t c = 0; c < columns.size(); ++c) {
          add_transposed_product(coarse_sum_.at(columns[c]), transfer, blocks[c]);
        }
      }
      coarse.rows.set_row(wanted[i], coarse_sum_.columns, coarse_sum_.blocks);
    }
  }
  /// Calls visit(row, k, number) for each block k of the transfer in these rows to a coarse row with a number.
  template <class Visit>
  void for_each_transfer(const std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& number,
                         Visit visit) const {
    for (const std::uint32_t row : rows) {
      const auto columns = transfer_.columns(row);
      for (std::uint32_t k = 0; k < columns.size(); ++k) {
        if (number[columns[k]] != 0) {
          visit(row, k, number[columns[k]]);
        }
      }
    }
  }

  std::vector<Square> inverse_;  // of the diagonal blocks
  float radius_ = 1;             // largest eigenvalue of the matrix after division by the diagonal blocks
  Frames frames_, coarse_frames_;
  std::vector<std::uint32_t> aggregate_;             // of each row, or none
  std::vector<std::vector<std::uint32_t>> members_;  // of each aggregate
  BlockRows<Transfer> transfer_;
  Vectors product_, step_;
  std::vector<typename Coarse::Vectors> restricted_;  // of the second part of the rows, the third, ...
  std::vector<std::uint8_t> is_found_;                // of each row, while rows are searched; else all 0
  BlockRows<Transfer> products_;                      // A P; see keeps_products
  RowSum<Transfer> transfer_sum_, product_sum_;
  RowSum<typename Coarse::Square> coarse_sum_;
};

}  // namespace chainmail
