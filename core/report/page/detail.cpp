#include "report/page/detail.h"

#include <algorithm>
#include <string>
#include <vector>

#include "report/page/figure_table.h"
#include "report/page/format.h"

namespace chainmail::report {
namespace {

/// A column and what stands in it, over a group of columns.
struct Column {
  std::string group;
  std::string name;
  std::string (*cell)(const Measurement&, const DragResult&);
};

std::string per_move(std::uint64_t count, const DragResult& drag) { return figure(double(count) / drag.moves); }

std::string part(const std::optional<Distance>& distance, double Distance::*member) {
  return distance ? figure(*distance.*member) : "n/a";
}

std::string time_cell(const Measurement& m, const DragResult&) { return figure(m.ms_per_move.median); }
std::string quartiles_cell(const Measurement& m, const DragResult&) {
  return figure(m.ms_per_move.lower_quartile) + "–" + figure(m.ms_per_move.upper_quartile);
}
std::string worst_cell(const Measurement& m, const DragResult&) { return figure(m.worst_move_ms); }
std::string checked_cell(const Measurement& m, const DragResult& drag) { return per_move(m.checked, drag); }
std::string moved_cell(const Measurement& m, const DragResult& drag) { return per_move(m.moved, drag); }
std::string max_cell(const Measurement& m, const DragResult&) { return figure(m.errors.violation.max); }
std::string rms_cell(const Measurement& m, const DragResult&) { return figure(m.errors.violation.rms); }
std::string links_cell(const Measurement& m, const DragResult&) { return percent(m.errors.violation.fraction); }
std::string exact_max(const Measurement& m, const DragResult&) { return part(m.errors.to_exact, &Distance::max); }
std::string exact_rms(const Measurement& m, const DragResult&) { return part(m.errors.to_exact, &Distance::rms); }
std::string energy_cell(const Measurement& m, const DragResult&) { return figure(m.errors.energy_over_exact); }
std::string float_max(const Measurement& m, const DragResult&) { return figure(m.errors.float_to_double.max); }
std::string float_rms(const Measurement& m, const DragResult&) { return figure(m.errors.float_to_double.rms); }
std::string hand_cell(const Measurement& m, const DragResult&) { return figure(m.errors.largest_over_hand); }
std::string rest_max(const Measurement& m, const DragResult&) { return part(m.errors.to_equilibrium, &Distance::max); }
std::string rest_rms(const Measurement& m, const DragResult&) { return part(m.errors.to_equilibrium, &Distance::rms); }

std::vector<Column> columns_for(const DragResult& drag) {
  std::vector<Column> columns{
      {"ms a move", "median", time_cell},       {"ms a move", "quartiles", quartiles_cell},
      {"ms a move", "worst move", worst_cell},  {"elements a move", "checked", checked_cell},
      {"elements a move", "moved", moved_cell}, {"violation", "max", max_cell},
      {"violation", "RMS", rms_cell},           {"violation", "links", links_cell},
      {"distance to Exact", "max", exact_max},  {"distance to Exact", "RMS", exact_rms},
      {"energy", "/ Exact’s", energy_cell},     {"float to double", "max", float_max},
      {"float to double", "RMS", float_rms},    {"farthest", "/ hand", hand_cell},
  };
  const bool has_equilibrium = std::ranges::any_of(
      drag.entries, [](const Entry& entry) { return entry.measurement && entry.measurement->errors.to_equilibrium; });
  if (has_equilibrium) {
    columns.push_back({"to equilibrium", "max", rest_max});
    columns.push_back({"to equilibrium", "RMS", rest_rms});
  }
  return columns;
}

int repetitions_of(const DragResult& drag) {
  int most = 0;
  for (const Entry& entry : drag.entries) {
    most = std::max(most, entry.measurement ? entry.measurement->ms_per_move.count : 0);
  }
  return most;
}

std::string about(const DragResult& drag) {
  return drag.description + "; " + std::to_string(drag.moves) + " moves, " + std::to_string(repetitions_of(drag)) +
         " repetitions" + (drag.no_exact.empty() ? "" : "; no distance to Exact: " + drag.no_exact);
}

FigureTable table_of(const CaseResult& object, const DragResult& drag) {
  FigureTable table{object.name + ", " + drag.name, about(drag), "detail", "contestant", {}, {}};
  const std::vector<Column> columns = columns_for(drag);
  for (const Column& column : columns) {
    table.columns.push_back({column.group, column.name});
  }
  for (const Entry& entry : drag.entries) {
    auto& row = table.rows.emplace_back();
    row.label = label(entry.contestant);
    row.refusal = entry.measurement ? "" : entry.refusal;
    for (std::size_t i = 0; entry.measurement && i < columns.size(); ++i) {
      row.cells.push_back(columns[i].cell(*entry.measurement, drag));
    }
  }
  return table;
}

}  // namespace

void write_details(std::ostream& out, const CaseResult& object) {
  for (const DragResult& drag : object.drags) {
    write_html(out, table_of(object, drag));
  }
}

}  // namespace chainmail::report
