#include "report/page/table.h"

#include <algorithm>

#include "report/page/figure_table.h"
#include "report/page/format.h"

namespace chainmail::report {
namespace {

void take_worst(std::optional<Distance>& worst, const std::optional<Distance>& other) {
  if (other) {
    worst = worst ? Distance{std::max(worst->max, other->max), std::max(worst->rms, other->rms)} : *other;
  }
}

void take_worst(Violation& worst, const Violation& other) {
  worst.max = std::max(worst.max, other.max);
  worst.rms = std::max(worst.rms, other.rms);
  worst.fraction = std::max(worst.fraction, other.fraction);
}

MainRow main_row(const CaseResult& object, std::size_t entry) {
  MainRow row;
  row.contestant = label(object.drags.front().entries[entry].contestant);
  for (const DragResult& drag : object.drags) {
    const auto& [contestant, measurement, refusal] = drag.entries[entry];
    row.refusal = refusal.empty() ? row.refusal : refusal;
    row.ms_per_move.push_back(measurement ? std::optional(measurement->ms_per_move.median) : std::nullopt);
    if (measurement) {
      take_worst(row.violation, measurement->errors.violation);
      take_worst(row.to_exact, measurement->errors.to_exact);
    }
  }
  return row;
}

}  // namespace

std::vector<std::string> cells_of(const MainRow& row) {
  std::vector<std::string> cells;
  for (const auto& ms : row.ms_per_move) {
    cells.push_back(figure(ms));
  }
  cells.insert(cells.end(), {figure(row.violation.max), figure(row.violation.rms), percent(row.violation.fraction)});
  cells.push_back(row.to_exact ? figure(row.to_exact->max) : "n/a");
  cells.push_back(row.to_exact ? figure(row.to_exact->rms) : "n/a");
  return cells;
}

std::vector<MainTable> main_tables(const Comparison& comparison) {
  std::vector<MainTable> tables;
  for (const CaseResult& object : comparison.cases) {
    if (object.drags.empty()) {
      continue;
    }
    MainTable& table = tables.emplace_back();
    table.object = object.name;
    table.about =
        object.description + "; " + thousands(object.elements) + " elements, " + thousands(object.links) + " links";
    for (const DragResult& drag : object.drags) {
      table.drags.push_back(drag.name);
    }
    for (std::size_t i = 0; i < object.drags.front().entries.size(); ++i) {
      table.rows.push_back(main_row(object, i));
    }
  }
  return tables;
}

void write_text(std::ostream& out, const Comparison& comparison) {
  out << "ms per move, drag by drag; then the worst of the drags: violation of links (max and RMS in rest lengths,\n"
         "share of links) and distance to Exact ChainMail in double (max and RMS in mean rest lengths)\n";
  for (const MainTable& table : main_tables(comparison)) {
    std::vector<std::vector<std::string>> rows{{""}};
    rows.front().insert(rows.front().end(), table.drags.begin(), table.drags.end());
    rows.front().insert(rows.front().end(), {"violation", "RMS", "links", "distance", "RMS"});
    for (const MainRow& row : table.rows) {
      rows.push_back({row.contestant});
      const auto cells = row.refusal.empty() ? cells_of(row) : std::vector{row.refusal};
      rows.back().insert(rows.back().end(), cells.begin(), cells.end());
    }
    out << '\n' << table.object << ": " << table.about << '\n';
    write_columns(out, rows);
  }
}

}  // namespace chainmail::report
