#include <algorithm>

#include "report/format.h"
#include "report/physics_report.h"

namespace chainmail::report {
namespace {

using Measured = std::optional<PhysicsMeasurement>;
using CellOf = std::string (*)(const PhysicsMeasurement&);

std::string time_cell(const PhysicsMeasurement& m) { return figure(m.ms_per_move.median); }
std::string rms_cell(const PhysicsMeasurement& m) { return percent(m.error.rms); }
std::string max_cell(const PhysicsMeasurement& m) { return percent(m.error.max); }
std::string moving_rms_cell(const PhysicsMeasurement& m) { return percent(m.error.moving_rms); }
std::string moving_max_cell(const PhysicsMeasurement& m) { return percent(m.error.moving_max); }

struct Group {
  const char* name;
  CellOf cell;
  bool in_text = true;  // on a terminal there is no room for all
};
constexpr Group groups[]{{"ms a move", time_cell},
                         {"RMS error", rms_cell},
                         {"largest error", max_cell},
                         {"RMS, what moves", moving_rms_cell, false},
                         {"largest, what moves", moving_max_cell, false}};

/// Whether it says what the one before has said: an algorithm that cannot take part has one row for all its sweeps.
template <class One>
bool repeats(const One& one, const One& before, const std::string& refusal, const std::string& refusal_before) {
  return !refusal.empty() && refusal == refusal_before && one.contestant.algorithm == before.contestant.algorithm;
}

/// Those of the drags that have a truth.
std::vector<const PhysicsDrag*> measured_drags(const PhysicsObject& object) {
  std::vector<const PhysicsDrag*> drags;
  for (const PhysicsDrag& drag : object.drags) {
    if (drag.no_truth.empty()) {
      drags.push_back(&drag);
    }
  }
  return drags;
}

FigureTable::Row row_of(const std::vector<const PhysicsDrag*>& drags, std::size_t entry, bool for_text) {
  FigureTable::Row row;
  row.label = label(drags.front()->entries[entry].contestant);
  double prepare = 0;
  bool any = false;
  for (const PhysicsDrag* drag : drags) {
    if (const Measured& measured = drag->entries[entry].measurement) {
      any = true;
      prepare = std::max(prepare, measured->prepare_ms);
    } else {
      row.refusal = drag->entries[entry].refusal;
    }
  }
  if (!any) {
    return row;
  }
  row.refusal.clear();
  row.cells.push_back(figure(prepare));
  for (const Group& group : groups) {
    for (std::size_t i = 0; i < drags.size() && (group.in_text || !for_text); ++i) {
      const PhysicsDrag* drag = drags[i];
      const Measured& measured = drag->entries[entry].measurement;
      row.cells.push_back(measured ? group.cell(*measured) : "n/a");
    }
  }
  return row;
}

std::string about(const PhysicsObject& object) {
  std::string text = object.description + "; " + std::to_string(object.elements) + " elements, " +
                     std::to_string(object.links) + " links, " + std::to_string(object.pins) + " pinned";
  for (const PhysicsDrag& drag : object.drags) {
    text += "; " + drag.name + ": " + drag.description + (drag.no_truth.empty() ? "" : ", left out: " + drag.no_truth);
  }
  return text;
}

void write_table(std::ostream& out, const FigureTable& table) {
  std::vector<std::vector<std::string>> rows{{""}, {table.corner}};
  std::string group;
  for (const FigureTable::Column& column : table.columns) {
    rows[0].push_back(column.group == group ? "" : column.group);
    rows[1].push_back(column.name);
    group = column.group;
  }
  for (const FigureTable::Row& row : table.rows) {
    rows.push_back({row.label});
    rows.back().insert(rows.back().end(), row.cells.begin(), row.cells.end());
    if (!row.refusal.empty()) {
      rows.back().push_back(row.refusal);
    }
  }
  out << '\n' << table.caption << ": " << table.about << '\n';
  write_columns(out, rows);
}

FigureTable::Row row_of(const GrowthSeries& series) {
  FigureTable::Row row;
  row.label = label(series.contestant);
  if (series.points.empty()) {
    row.refusal = series.end;
    return row;
  }
  const GrowthPoint& last = series.points.back();
  std::vector<double> errors;
  for (const GrowthPoint& point : series.points) {
    if (point.error) {
      errors.push_back(point.error->rms);
    }
  }
  row.cells = {std::to_string(last.elements),
               figure(last.ms_per_move),
               figure(last.prepare_ms),
               series.growth ? figure(series.growth->exponent) : "n/a",
               errors.empty() ? "n/a" : percent(errors.front()),
               errors.empty() ? "n/a" : percent(errors.back()),
               series.end};
  return row;
}

}  // namespace

FigureTable physics_table(const PhysicsObject& object, bool for_text) {
  const auto drags = measured_drags(object);
  FigureTable table{object.name, about(object), "detail", "contestant", {{"prepare", "ms"}}, {}};
  for (const Group& group : groups) {
    for (std::size_t i = 0; i < drags.size() && (group.in_text || !for_text); ++i) {
      const PhysicsDrag* drag = drags[i];
      table.columns.push_back({group.name, drag->name});
    }
  }
  for (std::size_t i = 0; !drags.empty() && i < drags.front()->entries.size(); ++i) {
    const auto& entries = drags.front()->entries;
    if (i == 0 || !repeats(entries[i], entries[i - 1], entries[i].refusal, entries[i - 1].refusal)) {
      table.rows.push_back(row_of(drags, i, for_text));
    }
  }
  return table;
}

FigureTable growth_table(const PhysicsGrowth& growth) {
  FigureTable table{growth.name,
                    growth.description,
                    "detail",
                    "contestant",
                    {{"the largest that it reached", "elements"},
                     {"the largest that it reached", "ms a move"},
                     {"the largest that it reached", "prepare ms"},
                     {"growth of time", "exponent"},
                     {"RMS error", "first size"},
                     {"RMS error", "last known"},
                     {"why no further", ""}},
                    {}};
  for (std::size_t i = 0; i < growth.series.size(); ++i) {
    const GrowthSeries& series = growth.series[i];
    if (!series.points.empty() || i == 0 ||
        !repeats(series, growth.series[i - 1], series.end, growth.series[i - 1].end)) {
      table.rows.push_back(row_of(series));
    }
  }
  return table;
}

void write_text(std::ostream& out, const PhysicsReport& report) {
  out << "Errors at the end of each drag against neo-Hookean FEM, over the hand's displacement; what moves: elements\n"
         "that the truth displaces by more than 1% of the hand's. Prepare: what a method does before its first move.\n";
  for (const PhysicsObject& object : report.objects) {
    write_table(out, physics_table(object, true));
  }
  for (const PhysicsGrowth& growth : report.growths) {
    out << (&growth == &report.growths.front() ? "\nGrowing objects\n" : "");
    write_table(out, growth_table(growth));
  }
}

}  // namespace chainmail::report
