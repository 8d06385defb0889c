#include "report/page/suite_csv.h"

#include <vector>

#include "report/page/csv_table.h"

namespace chainmail::report {
namespace suite_csv {

/// One contestant in one drag, on one mesh of the refinement, below one error, or at one
/// point of a curve.
struct Row {
  const SuiteResult* result;
  std::optional<std::uint64_t> handle = {};
  std::optional<bool> has_cut = {};
  SuiteRow figures = {};
  std::optional<std::uint64_t> elements = {};
  std::optional<double> below = {};
  SuitePoint times = {};
};

constexpr CsvColumn<Row> columns[]{
    {"experiment", at<Row, &Row::result, &SuiteResult::name>},
    {"drag", at<Row, &Row::figures, &SuiteRow::drag>},
    {"handle", at<Row, &Row::handle>},
    {"has_cut", at<Row, &Row::has_cut>},
    {"contestant", at<Row, &Row::figures, &SuiteRow::contestant>},
    {"algorithm", at<Row, &Row::figures, &SuiteRow::algorithm>},
    {"refusal", at<Row, &Row::figures, &SuiteRow::refusal>},
    {"elements", at<Row, &Row::elements>},
    {"below", at<Row, &Row::below>},
    {"ms_per_move", at<Row, &Row::times, &SuitePoint::later_ms>},
    {"fresh_grab_ms", at<Row, &Row::times, &SuitePoint::fresh_ms>},
};

/// Returns the columns, then one for each of `suite_figures`.
std::vector<CsvColumn<Row>> all_columns() {
  std::vector<CsvColumn<Row>> all(std::begin(columns), std::end(columns));
  [&]<std::size_t... Index>(std::index_sequence<Index...>) {
    (all.push_back({suite_figures[Index].key, at<Row, &Row::figures, suite_figures[Index].value>}), ...);
  }
  (std::make_index_sequence<suite_figures.size()>());
  return all;
}

/// Returns a row without figures.
template <class Result>
SuiteRow named(const Result& of) {
  SuiteRow row;
  row.contestant = of.contestant;
  row.algorithm = of.algorithm;
  row.refusal = of.refusal;
  return row;
}

void add_order(std::vector<Row>& rows, const SuiteResult& result, const SuiteOrder& order) {
  Row row{.result = &result, .figures = named(order)};
  if (order.sizes.empty()) {
    rows.push_back(row);
  }
  for (const SuiteOrder::Size& size : order.sizes) {
    row.elements = size.elements;
    row.figures.relative = size.relative;
    rows.push_back(row);
  }
}

/// Adds a row with the time of one of the drags of a curve.
Row& add_time(std::vector<Row>& rows, const SuiteResult& result, const SuiteTime& time, const SuitePointFigures& of,
              const std::optional<double>& ms) {
  Row& row = rows.emplace_back(Row{.result = &result, .figures = named(time)});
  row.figures.drag = of.drag;
  row.times.*of.ms = ms;
  row.figures.after_cut_ms = row.times.after_cut_ms;
  return row;
}

void add_times(std::vector<Row>& rows, const SuiteResult& result, const SuiteTime& time) {
  for (const SuitePointFigures& of : suite_point_figures) {
    for (const double error : suite_errors) {
      if (const auto ms = shortest_ms(time, of, error)) {
        add_time(rows, result, time, of, ms).below = error;
      }
    }
    for (const SuitePoint& point : time.curve) {
      if (point.*of.error) {
        Row& row = add_time(rows, result, time, of, point.*of.ms);
        row.figures.iterations = point.iterations > 0 ? std::optional(double(point.iterations)) : std::nullopt;
        row.figures.relative = point.*of.error;
      }
    }
  }
  if (!time.refusal.empty()) {
    rows.push_back({.result = &result, .figures = named(time)});
  }
}

}  // namespace suite_csv

void write_csv(std::ostream& out, const Suite& suite) {
  std::vector<suite_csv::Row> rows;
  for (const SuiteResult& result : suite.results) {
    for (const SuiteRow& row : result.rows) {
      rows.push_back({.result = &result, .handle = row.handle, .has_cut = row.has_cut, .figures = row});
    }
    for (const SuiteOrder& order : result.orders) {
      suite_csv::add_order(rows, result, order);
    }
    for (const SuiteTime& time : result.times) {
      suite_csv::add_times(rows, result, time);
    }
  }
  write_csv(out, suite_csv::all_columns(), rows);
}

}  // namespace chainmail::report
