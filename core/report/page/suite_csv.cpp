#include "report/page/suite_csv.h"

#include <string>

#include "report/page/format.h"

namespace chainmail::report {
namespace {

/// The columns that a line fills in, besides the figures of a row.
struct Line {
  std::string drag = {}, handle = {}, has_cut = {}, elements = {}, below = {};
  std::string ms_per_move = {}, fresh_grab_ms = {};
};

void write_line(std::ostream& out, const SuiteResult& result, const Line& line, const SuiteRow& row) {
  out << result.name << ',' << csv_field(line.drag) << ',' << line.handle << ',' << line.has_cut << ','
      << csv_field(row.contestant) << ',' << row.algorithm << ',' << csv_field(row.refusal) << ',' << line.elements
      << ',' << line.below << ',' << line.ms_per_move << ',' << line.fresh_grab_ms;
  for (const SuiteFigure& figure : suite_figures) {
    out << ',' << all_digits(row.*figure.value);
  }
  out << '\n';
}

SuiteRow row_named(const std::string& contestant, const std::string& algorithm, const std::string& refusal) {
  SuiteRow row;
  row.contestant = contestant;
  row.algorithm = algorithm;
  row.refusal = refusal;
  return row;
}

void write_orders(std::ostream& out, const SuiteResult& result) {
  for (const SuiteOrder& order : result.orders) {
    SuiteRow row = row_named(order.contestant, order.algorithm, order.refusal);
    if (order.sizes.empty()) {
      write_line(out, result, {}, row);
    }
    for (const SuiteOrder::Size& size : order.sizes) {
      row.relative = size.relative;
      write_line(out, result, {.elements = std::to_string(size.elements)}, row);
    }
  }
}

void write_times(std::ostream& out, const SuiteResult& result) {
  for (const SuiteTime& time : result.times) {
    const SuiteRow row = row_named(time.contestant, time.algorithm, time.refusal);
    for (std::size_t i = 0; i < suite_errors.size(); ++i) {
      const Line line{.below = all_digits(suite_errors[i]),
                      .ms_per_move = all_digits(time.ms_per_move[i]),
                      .fresh_grab_ms = all_digits(time.fresh_ms[i])};
      write_line(out, result, line, row);
    }
  }
}

}  // namespace

void write_csv(std::ostream& out, const Suite& suite) {
  out << "experiment,drag,handle,has_cut,contestant,algorithm,refusal,elements,below,ms_per_move,fresh_grab_ms";
  for (const SuiteFigure& figure : suite_figures) {
    out << ',' << figure.key;
  }
  out << '\n';
  for (const SuiteResult& result : suite.results) {
    for (const SuiteRow& row : result.rows) {
      const Line line{.drag = row.drag, .handle = std::to_string(row.handle), .has_cut = row.has_cut ? "1" : "0"};
      write_line(out, result, line, row);
    }
    write_orders(out, result);
    write_times(out, result);
  }
}

}  // namespace chainmail::report
