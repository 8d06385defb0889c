#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "exact/block_rows.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

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
