#include "report/page/suite_csv.h"

#include <vector>

#include "report/page/csv_table.h"

namespace chainmail::report {
namespace suite_csv {

/// One contestant in one drag, on one mesh of the refinement, or below one error.
struct Row {
  const SuiteResult* result;
  std::optional<std::uint64_t> handle = {};
  std::optional<bool> has_cut = {};
  SuiteRow figures = {};
  std::optional<std::uint64_t> elements = {};
  std::optional<double> below = {}, ms_per_move = {}, fresh_grab_ms = {};
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
    {"ms_per_move", at<Row, &Row::ms_per_move>},
    {"fresh_grab_ms", at<Row, &Row::fresh_grab_ms>},
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

void add_times(std::vector<Row>& rows, const SuiteResult& result, const SuiteTime& time) {
  for (std::size_t i = 0; i < suite_errors.size(); ++i) {
    rows.push_back({.result = &result,
                    .figures = named(time),
                    .below = suite_errors[i],
                    .ms_per_move = time.ms_per_move[i],
                    .fresh_grab_ms = time.fresh_ms[i]});
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
