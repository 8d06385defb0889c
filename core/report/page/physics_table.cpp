#include "report/page/physics_table.h"

#include <algorithm>

#include "report/page/convergence.h"
#include "report/page/format.h"
#include "report/page/physics_means.h"

namespace chainmail::report {
namespace {

using CellOf = std::string (*)(const PhysicsMeasurement&);

// Relative errors below this come from Newton's method and from single precision: the method equals the reference.
constexpr double reference_found_again = 1e-5;
// Differences below this come from rounding.
constexpr double rounding_of_turns = 1e-6;

std::string relative_cell(const PhysicsMeasurement& m) {
  return m.error.relative < reference_found_again ? "<1e-5" : figure(m.error.relative);
}
std::string rms_cell(const PhysicsMeasurement& m) { return percent(m.error.rms); }
std::string max_cell(const PhysicsMeasurement& m) { return percent(m.error.max); }
std::string moving_rms_cell(const PhysicsMeasurement& m) { return percent(m.error.moving_rms); }
std::string moving_max_cell(const PhysicsMeasurement& m) { return percent(m.error.moving_max); }

/// Columns of errors, one per drag.
struct ErrorColumns {
  const char* name;
  CellOf cell;
  bool in_text = false;  // true: also shown in a terminal, which has no room for all
};
constexpr ErrorColumns groups[]{{"relative error (ratio)", relative_cell, true},
                                {"RMS error (%)", rms_cell},
                                {"largest error (%)", max_cell},
                                {"RMS, what moves (%)", moving_rms_cell},
                                {"largest, what moves (%)", moving_max_cell}};

std::string hausdorff_cell(const PhysicsMeasurement& m) { return figure(m.shape.hausdorff); }
std::string volume_cell(const PhysicsMeasurement& m) { return signed_percent(m.shape.volume_change); }
std::string inverted_cell(const PhysicsMeasurement& m) { return count(m.shape.inverted_cells); }
std::string stretch_cell(const PhysicsMeasurement& m) { return figure(m.shape.stretch); }
std::string violation_cell(const PhysicsMeasurement& m) { return figure(m.shape.violation); }

std::string residual_cell(const PhysicsMeasurement& m) { return figure(m.residual); }
std::string binds_cell(const PhysicsMeasurement& m) { return !m.binds ? "" : *m.binds ? "yes" : "no"; }

/// Columns of a page with the worst of all drags without a cut.
struct WorstColumn {
  const char *group, *name;
  CellOf cell;
};
constexpr const char* shape = "shape: worst of the drags";
constexpr const char* equilibrium = "equilibrium: worst of the drags";
constexpr WorstColumn worst_columns[]{{shape, "Hausdorff (rest lengths)", hausdorff_cell},
                                      {shape, "volume change (%)", volume_cell},
                                      {shape, "inverted cells", inverted_cell},
                                      {shape, "stretch (ratio)", stretch_cell},
                                      {shape, "violation (rest lengths)", violation_cell},
                                      {equilibrium, "residual (ratio)", residual_cell},
                                      {equilibrium, "regions bind", binds_cell}};

/// Formats a time (ms); empty if it was not measured because nothing is prepared or cut.
std::string time_cell(const TimeSpread& ms, bool for_text) {
  if (ms.count == 0) {
    return for_text ? "-" : "";
  }
  return for_text ? figure(ms.median)
                  : figure(ms.median) + " (" + figure(ms.lower_quartile) + "–" + figure(ms.upper_quartile) + ", " +
                        std::to_string(ms.count) + ")";
}

/// True if a row repeats the refusal of the row before: an algorithm that cannot take part has one row for all sweeps.
template <class One>
bool repeats(const One& one, const One& before, const std::string& refusal, const std::string& refusal_before) {
  return !refusal.empty() && refusal == refusal_before && one.contestant.algorithm == before.contestant.algorithm;
}

/// The means of the drags of an object, which its table shows.
struct Means {
  std::vector<PhysicsDrag> by_name;  // drags that have a reference solution
  PhysicsDrag all;                   // without the cut
  const PhysicsDrag* cut = nullptr;  // one of by_name; none if nothing is cut

  explicit Means(const PhysicsObject& object) : by_name(means_by_name(object)), all(mean_of_drags(object)) {
    std::erase_if(by_name, [](const PhysicsDrag& drag) { return !drag.no_reference.empty(); });
    const auto found = std::ranges::find(by_name, true, &PhysicsDrag::has_cut);
    cut = found == by_name.end() ? nullptr : &*found;
  }
};

void add_times(FigureTable::Row& row, const Means& means, std::size_t entry, bool for_text) {
  const auto measured = means.all.entries[entry].measurement.value_or(PhysicsMeasurement{});
  const auto at_cut = means.cut == nullptr ? PhysicsMeasurement{}
                                           : means.cut->entries[entry].measurement.value_or(PhysicsMeasurement{});
  for (const TimeSpread& ms : {measured.first_move, measured.ms_per_move, at_cut.move_after_cut,
                               measured.prepare.factorize, measured.prepare.grab}) {
    row.cells.push_back(time_cell(ms, for_text));
  }
}

void add_errors(FigureTable::Row& row, const Means& means, std::size_t entry, const ErrorColumns& group) {
  for (const PhysicsDrag& drag : means.by_name) {
    if (!drag.has_cut || group.in_text) {
      const PhysicsEntry& mean = drag.entries[entry];
      const std::string left_out = mean.left_out > 0 ? " (without " + std::to_string(mean.left_out) + ")" : "";
      row.cells.push_back(mean.measurement ? group.cell(*mean.measurement) + left_out : "n/a");
    }
  }
}

FigureTable::Row row_of(const Means& means, std::size_t entry, bool for_text) {
  FigureTable::Row row;
  row.label = label(means.all.entries[entry].contestant);
  if (std::ranges::none_of(means.by_name,
                           [&](const PhysicsDrag& drag) { return drag.entries[entry].measurement.has_value(); })) {
    row.refusal = means.all.entries[entry].refusal;
    return row;
  }
  add_errors(row, means, entry, groups[0]);
  add_times(row, means, entry, for_text);
  for (const ErrorColumns& group : groups) {
    if (!group.in_text && !for_text) {
      add_errors(row, means, entry, group);
    }
  }
  for (const WorstColumn& column : worst_columns) {
    if (!for_text) {
      const auto& measured = means.all.entries[entry].measurement;
      row.cells.push_back(measured ? column.cell(*measured) : "n/a");
    }
  }
  return row;
}

std::vector<FigureTable::Column> columns_of(const Means& means, bool for_text) {
  std::vector<FigureTable::Column> columns;
  const auto add_group = [&](const ErrorColumns& group) {
    for (const PhysicsDrag& drag : means.by_name) {
      if (!drag.has_cut || group.in_text) {
        columns.push_back({group.name, drag.has_cut ? "cut" : drag.name});
      }
    }
  };
  add_group(groups[0]);
  const char* time = for_text ? "time (ms)" : "time: median (quartiles, repetitions), ms";
  const char* prepare = for_text ? "prepare (ms)" : "prepare: median (quartiles, repetitions), ms";
  columns.insert(columns.end(),
                 {{time, "first"}, {time, "later"}, {time, "after cut"}, {prepare, "factorize"}, {prepare, "grab"}});
  for (const ErrorColumns& group : groups) {
    if (!group.in_text && !for_text) {
      add_group(group);
    }
  }
  for (const WorstColumn& column : worst_columns) {
    if (!for_text) {
      columns.push_back({column.group, column.name});
    }
  }
  return columns;
}

/// Returns `cells`, which are in the order of `own`, in the order of `columns`; '-' for a column that `own` lacks.
std::vector<std::string> cells_under(const std::vector<FigureTable::Column>& columns,
                                     const std::vector<FigureTable::Column>& own,
                                     const std::vector<std::string>& cells) {
  std::vector<std::string> placed;
  for (const FigureTable::Column& column : columns) {
    const auto found = std::ranges::find_if(
        own, [&](const FigureTable::Column& one) { return one.group == column.group && one.name == column.name; });
    placed.push_back(found == own.end() ? "-" : cells[std::size_t(found - own.begin())]);
  }
  return placed;
}

std::string about(const Calibration& calibration) {
  const std::string who = label(Contestant{calibration.algorithm, 0, calibration.equilibrium}) + " calibrated";
  return !calibration.refusal.empty()
             ? who + ": left out, " + calibration.refusal
             : who + " in " + figure(calibration.seconds) + " s on " + std::to_string(calibration.drags) +
                   " drags of other elements: " + region_in_words(calibration.softness) + ", " +
                   (calibration.equilibrium ? energy_in_words(calibration.softness)
                                            : std::to_string(calibration.sweeps) + " sweeps");
}

/// Returns the description of a drag without its handle.
std::string what_happens(const PhysicsDrag& drag) {
  const std::string handle = "element " + std::to_string(drag.handle) + ", ";
  return drag.description.starts_with(handle) ? drag.description.substr(handle.size()) : drag.description;
}

/// Returns the levels of the references on refined cells; empty if there are none.
std::string about_refined(const PhysicsObject& object) {
  std::vector<Convergence> all;
  for (const PhysicsDrag& drag : object.drags) {
    if (drag.refined) {
      all.push_back(*drag.refined);
    }
  }
  return all.empty() ? "" : "; " + convergence_in_words(all);
}

std::string about(const PhysicsObject& object) {
  std::vector<ElementId> handles;
  std::vector<std::string> names;
  std::string drags, left_out;
  for (const PhysicsDrag& drag : object.drags) {
    if (std::ranges::find(handles, drag.handle) == handles.end()) {
      handles.push_back(drag.handle);
    }
    if (std::ranges::find(names, drag.name) == names.end()) {
      names.push_back(drag.name);
      drags += "; " + drag.name + ": " + (drag.has_cut ? drag.description : what_happens(drag));
    }
    if (!drag.no_reference.empty()) {
      left_out += "; left out: " + drag.name + " of element " + std::to_string(drag.handle) + ", " + drag.no_reference;
    }
  }
  std::string text = object.description + "; " + thousands(object.elements) + " elements, " + thousands(object.links) +
                     " links, " + std::to_string(object.pins) + " pinned; handles: ";
  for (const ElementId handle : handles) {
    text += (handle == handles.front() ? "" : ", ") + std::to_string(handle);
  }
  text += drags + left_out + about_refined(object);
  if (object.law.kind != StrainLaw::Kind::neo_hookean) {
    text += "; reference: " + label(object.law);
  }
  for (const Calibration& calibration : object.calibrations) {
    text += "; " + about(calibration);
  }
  return text;
}

constexpr const char* how_to_read_text =
    "Relative error: RMS of the error over RMS of the reference's displacements, over all elements; means over the\n"
    "handles of an object. An object that does not move has about 1: a larger error is no better than no method.\n"
    "The reference is neo-Hookean FEM, converged on the same cells as linear FEM, not under "
    "refinement of the mesh;\n"
    "BEM works on its own surface mesh. Times are medians in ms, means over the drags: the first move of a drag, a\n"
    "later move, and the move after a cut with all repeated preparation. Preparation: factorizing is done once for an\n"
    "object, its pins and its cuts; grabbing is done once for each handle. A contestant that iterates makes the least\n"
    "iterations per move with which its answer is within 1 % of its own limit.\n";

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
      errors.push_back(point.error->relative);
    }
  }
  row.cells = {std::to_string(last.elements),
               figure(last.ms_per_move),
               figure(last.prepare_ms),
               series.growth ? figure(series.growth->power) : "n/a",
               errors.empty() ? "n/a" : figure(errors.front()),
               errors.empty() ? "n/a" : figure(errors.back()),
               series.end};
  return row;
}

}  // namespace

FigureTable physics_table(const PhysicsObject& object, bool for_text) {
  const Means means(object);
  FigureTable table{object.name, about(object), "detail", "contestant", columns_of(means, for_text), {}};
  const auto& entries = means.all.entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || !repeats(entries[i], entries[i - 1], entries[i].refusal, entries[i - 1].refusal)) {
      table.rows.push_back(row_of(means, i, for_text));
    }
  }
  return table;
}

FigureTable symmetry_table(const PhysicsReport& report) {
  FigureTable table{"Turned object",
                    "difference of the answer after turning back, at the end of one move",
                    "detail",
                    "object, contestant",
                    {},
                    {}};
  for (const char* group : {"largest (mean rest lengths)", "relative (ratio)"}) {
    for (const double degrees : symmetry_angles) {
      table.columns.push_back({group, "turned by " + figure(degrees) + "°"});
    }
  }
  for (const PhysicsObject& object : report.objects) {
    for (const Symmetry& one : object.symmetry) {
      FigureTable::Row& row = table.rows.emplace_back();
      row.label = object.name + ": " + label(one.contestant);
      row.refusal = one.refusal;
      for (const auto member : {&TurnDifference::max, &TurnDifference::relative}) {
        for (const TurnDifference& turn : one.turns) {
          row.cells.push_back(turn.*member < rounding_of_turns ? "0" : figure(turn.*member));
        }
      }
    }
  }
  return table;
}

FigureTable physics_summary(const PhysicsReport& report) {
  FigureTable table{"Summary", "contestants without sweeps, at equilibrium, and calibrated ones",
                    "detail",  "object, contestant",
                    {},        {}};
  for (const PhysicsObject& object : report.objects) {
    if (auto columns = columns_of(Means(object), true); columns.size() > table.columns.size()) {
      table.columns = std::move(columns);
    }
  }
  for (const PhysicsObject& object : report.objects) {
    const Means means(object);
    const auto columns = columns_of(means, true);
    for (std::size_t i = 0; i < means.all.entries.size(); ++i) {
      const PhysicsContestant& contestant = means.all.entries[i].contestant;
      FigureTable::Row row = row_of(means, i, true);
      if ((contestant.sweeps == 0 || contestant.calibrated) && row.refusal.empty()) {
        table.rows.push_back({object.name + ": " + row.label, cells_under(table.columns, columns, row.cells), {}});
      }
    }
  }
  return table;
}

FigureTable growth_table(const PhysicsGrowth& growth) {
  FigureTable table{growth.name,
                    growth.description,
                    "detail",
                    "contestant",
                    {{"the largest object", "elements"},
                     {"the largest object", "ms per move"},
                     {"the largest object", "prepare (ms)"},
                     {"growth of time", "exponent"},
                     {"relative error (ratio)", "first size"},
                     {"relative error (ratio)", "last known"},
                     {"why not larger", ""}},
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

bool has_refined(const PhysicsReport& report) {
  return std::ranges::any_of(report.objects, [](const PhysicsObject& object) {
    return std::ranges::any_of(object.drags, [](const PhysicsDrag& drag) { return drag.refined.has_value(); });
  });
}

void write_text(std::ostream& out, const PhysicsReport& report) {
  out << how_to_read_text;
  if (has_refined(report)) {
    out << how_to_read_refined << '\n';
  }
  if (report.objects.size() > 1) {
    write_text(out, physics_summary(report));
  }
  for (const PhysicsObject& object : report.objects) {
    write_text(out, physics_table(object, true));
  }
  if (const FigureTable turned = symmetry_table(report); !turned.rows.empty()) {
    write_text(out, turned);
  }
  for (const PhysicsGrowth& growth : report.growths) {
    out << (&growth == &report.growths.front() ? "\nGrowing objects\n" : "");
    write_text(out, growth_table(growth));
  }
}

}  // namespace chainmail::report
