#pragma once

#include <concepts>
#include <optional>
#include <ostream>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>

#include "report/page/format.h"

namespace chainmail::report {

/// A field of CSV: a number with all digits, 1 or 0, or text in quotes if needed. Empty for what was not measured.
struct CsvField {
  CsvField() = default;
  CsvField(const std::string& words) : text(csv_field(words)) {}
  CsvField(std::string_view words) : text(csv_field(std::string(words))) {}
  CsvField(double number) : text(all_digits(number)) {}
  CsvField(bool is) : text(is ? "1" : "0") {}
  template <std::integral Count>
  CsvField(Count count) : text(std::to_string(count)) {}
  template <class Value>
  CsvField(const std::optional<Value>& value) : text(value ? CsvField(*value).text : "") {}

  std::string text;
};

/// A column of a CSV file: its name, and the field of a row under it.
template <class Row>
struct CsvColumn {
  std::string_view name;
  CsvField (*field)(const Row&);
};

/// Follows members from a row to a value; empty if a pointer or an optional on the way has none.
template <class Value, class... Members>
CsvField follow(const Value& value, Members... members) {
  if constexpr (requires { *value; }) {
    return value ? follow(*value, members...) : CsvField();
  } else if constexpr (sizeof...(members) == 0) {
    return value;
  } else {
    return [&](auto first, auto... rest) { return follow(value.*first, rest...); }(members...);
  }
}
/// The field of a column that shows a member of a member of a row: `at<Row, &Row::object, &CaseResult::name>`.
template <class Row, auto... ValueMembers>
CsvField at(const Row& row) {
  return follow(row, ValueMembers...);
}

/// Writes the names of the columns, then the rows.
template <std::ranges::range Columns, std::ranges::range Rows>
void write_csv(std::ostream& out, const Columns& columns, const Rows& rows) {
  std::string_view comma;
  for (const auto& column : columns) {
    out << std::exchange(comma, ",") << column.name;
  }
  out << '\n';
  for (const auto& row : rows) {
    comma = {};
    for (const auto& column : columns) {
      out << std::exchange(comma, ",") << column.field(row).text;
    }
    out << '\n';
  }
}

}  // namespace chainmail::report
