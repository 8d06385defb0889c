#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "exact/block_rows.h"

namespace chainmail {

/// The matrix of a coarse level, which multiplies several columns at once.
template <int Rows, int Columns = 1>
struct CoarseMatrix {
  using Square = Eigen::Matrix<float, Rows, Rows>;
  using Vector = Eigen::Matrix<float, Rows, Columns>;
  using Vectors = std::vector<Vector>;

  std::uint32_t size() const { return rows.size(); }
  void apply(const Vectors& x, Vectors& product, const SharedLoop& shared) const {
    product.resize(x.size());
    shared.run(x.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto columns = rows.columns(static_cast<std::uint32_t>(i));
        const auto blocks = rows.blocks(static_cast<std::uint32_t>(i));
        Vector sum = Vector::Zero();
        for (std::size_t k = 0; k < columns.size(); ++k) {
          sum.noalias() += blocks[k] * x[columns[k]];
        }
        product[i] = sum;
      }
    });
  }
  template <class Visit>
  void for_each_in_row(std::uint32_t row, Visit visit) const {
    const auto columns = rows.columns(row);
    const auto blocks = rows.blocks(row);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      visit(columns[k], blocks[k]);
    }
  }

  BlockRows<Square> rows;
};

/// A row of a sparse matrix while it is being summed up. A block is found by its column at once.
template <class Block>
class RowSum {
 public:
  void clear() {
    columns.clear();
    blocks.clear();
    std::ranges::fill(places_, 0);
  }
  Block& at(std::uint32_t column) {
    if (2 * columns.size() >= places_.size()) {
      grow();
    }
    std::uint32_t& place = place_of(column);
    if (place == 0) {
      columns.push_back(column);
      blocks.push_back(Block::Zero());
      place = static_cast<std::uint32_t>(columns.size());
    }
    return blocks[place - 1];
  }

  std::vector<std::uint32_t> columns;
  std::vector<Block> blocks;

 private:
  static constexpr std::size_t least_places = 16;

  /// Returns where the number of a column stands, or where it would stand.
  std::uint32_t& place_of(std::uint32_t column) {
    constexpr std::uint32_t spread = 2654435769U;  // 2³² over the golden ratio (Knuth 1973)
    const std::size_t mask = places_.size() - 1;
    std::size_t at = column * spread >> 16U & mask;
    while (places_[at] != 0 && columns[places_[at] - 1] != column) {
      at = (at + 1) & mask;
    }
    return places_[at];
  }
  void grow() {
    places_.assign(std::max(least_places, 2 * places_.size()), 0);
    for (std::uint32_t i = 0; i < columns.size(); ++i) {
      place_of(columns[i]) = i + 1;
    }
  }

  std::vector<std::uint32_t> places_;  // a power of two; number of the block from 1, or 0
};

}  // namespace chainmail
