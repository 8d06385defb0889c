#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace chainmail
