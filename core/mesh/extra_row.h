#pragma once

#include <utility>
#include <vector>

namespace chainmail {

/// Returns the table of a kind of rows; specialized beside the table, and declared by the tests that add to it.
template <class Row>
std::vector<Row>& table_of();

/// Adds a row to a table while this object exists. For tests: nothing may read the table meanwhile in another thread,
/// references to its rows become invalid, and what was made from the row must end before it.
template <class Row>
class ExtraRow {
 public:
  explicit ExtraRow(Row row) { table_of<Row>().push_back(std::move(row)); }
  ExtraRow(const ExtraRow&) = delete;
  ExtraRow& operator=(const ExtraRow&) = delete;
  ~ExtraRow() { table_of<Row>().pop_back(); }
};

}  // namespace chainmail
