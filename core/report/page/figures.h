#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <iterator>
#include <optional>
#include <ostream>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "measure/pass_times.h"
#include "report/page/format.h"

namespace chainmail::report {

/// The value of a figure: yes or no, a number, a text or the times of repetitions. None if it was not measured.
struct FigureValue : std::variant<std::monostate, bool, std::int64_t, double, std::string, TimeSpread> {
  FigureValue() = default;
  FigureValue(bool is) : variant(is) {}
  FigureValue(double number) : variant(number) {}
  FigureValue(std::string_view text) : variant(std::string(text)) {}
  FigureValue(const std::string& text) : variant(text) {}
  FigureValue(const TimeSpread& ms) : variant(ms) {}
  template <std::integral Count>
  FigureValue(Count count) : variant(std::int64_t(count)) {}
};

/// A figure of a row of a report, with its names in files and tables. It is not in those for which it has no name.
template <class Row>
struct Figure {
  std::string_view column;  // in CSV
  FigureValue (*value)(const Row&);
  std::string_view path = {};                                  // in JSON, from the object of the row
  std::string_view group = {}, heading = {};                   // in tables; without a heading: one column per drag
  std::string (*cell)(const std::optional<double>&) = figure;  // in tables, of a number
  bool is_rare = false;  // true: JSON leaves it out if there is no value, instead of null
};

/// Follows members from a row to a value; none if a pointer or an optional on the way has none.
template <class Value, class... Members>
FigureValue follow(const Value& value, Members... members) {
  if constexpr (requires { *value; }) {
    return value ? follow(*value, members...) : FigureValue();
  } else if constexpr (sizeof...(members) == 0) {
    return value;
  } else {
    return [&](auto first, auto... rest) { return follow(value.*first, rest...); }(members...);
  }
}
/// The value of a figure that is a member of a member of a row: `at<Row, &Row::object, &CaseResult::name>`.
template <class Row, auto... ValueMembers>
FigureValue at(const Row& row) {
  return follow(row, ValueMembers...);
}

/// Returns a value as a field of CSV: a number with all digits, 1 or 0, or text in quotes if needed; empty for none.
std::string csv_text(const FigureValue& value);

/// Returns a value as text for tables: texts as they are, numbers as `of_number` formats them.
std::string cell_of(const FigureValue& value, std::string (*of_number)(const std::optional<double>&));
template <class Row>
std::string cell_of(const Figure<Row>& figure, const Row& row) {
  return cell_of(figure.value(row), figure.cell);
}

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
