#pragma once

#include <algorithm>
#include <iterator>
#include <ostream>
#include <ranges>
#include <utility>
#include <vector>

#include "report/page/figures.h"

namespace chainmail::report {

/// A figure that only CSV shows.
template <class Row>
using CsvColumn = Figure<Row>;

/// Writes the names of the columns, then the rows.
template <std::ranges::range Figures, std::ranges::range Rows>
void write_csv(std::ostream& out, const Figures& figures, const Rows& rows) {
  std::vector<std::ranges::range_value_t<Figures>> columns;
  std::ranges::copy_if(figures, std::back_inserter(columns), [](const auto& one) { return !one.column.empty(); });
  std::string_view comma;
  for (const auto& figure : columns) {
    out << std::exchange(comma, ",") << figure.column;
  }
  out << '\n';
  for (const auto& row : rows) {
    comma = {};
    for (const auto& figure : columns) {
      out << std::exchange(comma, ",") << csv_text(figure.value(row));
    }
    out << '\n';
  }
}

}  // namespace chainmail::report
