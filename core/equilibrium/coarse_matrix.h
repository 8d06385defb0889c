#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// A sparse matrix of small dense blocks, by rows, in which single rows can be replaced. A row that grows moves to the
/// end; the place it leaves stays empty.
template <class Block>
class BlockRows {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(rows_.size()); }
  void resize(std::uint32_t rows) { rows_.resize(rows); }

  std::span<const std::uint32_t> columns(std::uint32_t row) const {
    return {columns_.data() + rows_[row].first, rows_[row].count};
  }
  std::span<const Block> blocks(std::uint32_t row) const {
    return {blocks_.data() + rows_[row].first, rows_[row].count};
  }

  void set_row(std::uint32_t row, std::span<const std::uint32_t> columns, std::span<const Block> blocks) {
    Row& place = rows_[row];
    if (columns.size() > place.capacity) {
      place.first = columns_.size();
      place.capacity = static_cast<std::uint32_t>(columns.size());
      columns_.resize(columns_.size() + columns.size());
      blocks_.resize(columns_.size());
    }
    place.count = static_cast<std::uint32_t>(columns.size());
    std::ranges::copy(columns, columns_.begin() + static_cast<std::ptrdiff_t>(place.first));
    std::ranges::copy(blocks, blocks_.begin() + static_cast<std::ptrdiff_t>(place.first));
  }

 private:
  struct Row {
    std::size_t first = 0;
    std::uint32_t count = 0, capacity = 0;
  };

  std::vector<Row> rows_;
  std::vector<std::uint32_t> columns_;
  std::vector<Block> blocks_;
};

/// The matrix of a coarse level, which multiplies several columns at once.
template <int Rows, int Columns = 1>
struct CoarseMatrix {
  using Square = FixedMatrix<float, Rows, Rows>;
  using Vector = FixedMatrix<float, Rows, Columns>;
  using Vectors = std::vector<Vector>;

  std::uint32_t size() const { return rows.size(); }
  void apply(const Vectors& x, Vectors& product, const SharedLoop& shared) const {
    product.resize(x.size());
    shared.run(x.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto columns = rows.columns(static_cast<std::uint32_t>(i));
        const auto blocks = rows.blocks(static_cast<std::uint32_t>(i));
        Vector sum;
        for (std::size_t k = 0; k < columns.size(); ++k) {
          add_product(sum, blocks[k], x[columns[k]]);
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
  /// Begins an empty row of a matrix with this many columns.
  void begin(std::size_t width) {
    for (const std::uint32_t column : columns) {
      places_[column] = 0;
    }
    columns.clear();
    blocks.clear();
    places_.resize(width);
  }
  Block& at(std::uint32_t column) {
    std::uint32_t& place = places_[column];
    if (place == 0) {
      columns.push_back(column);
      blocks.emplace_back();
      place = static_cast<std::uint32_t>(columns.size());
    }
    return blocks[place - 1];
  }

  std::vector<std::uint32_t> columns;
  std::vector<Block> blocks;

 private:
  std::vector<std::uint32_t> places_;  // of each column: number of its block from 1, or 0
};

}  // namespace chainmail
