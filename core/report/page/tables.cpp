#include "report/page/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "report/table/format.h"
#include "report/table/summary.h"

namespace chainmail::report {
namespace {

using namespace figures;

// Relative errors below this come from Newton's method and from single precision: the method equals the reference.
constexpr double reference_found_again = 1e-5;
// Differences of turned objects below this come from rounding.
constexpr double rounding_of_turns = 1e-6;

/// A figure of the main table: one column, or one for each drag.
struct MainFigure {
  const Figure* figure;
  bool each_drag = false;
  bool on_terminal = true;
};
constexpr std::array compared{MainFigure{&ms_per_move, true},  MainFigure{&violation_max},
                              MainFigure{&violation_rms},      MainFigure{&violation_fraction},
                              MainFigure{&exact_distance_max}, MainFigure{&exact_distance_rms}};
constexpr std::array against_physics{MainFigure{&relative, true},
                                     MainFigure{&first_ms},
                                     MainFigure{&later_ms},
                                     MainFigure{&after_cut_ms},
                                     MainFigure{&factorize_ms},
                                     MainFigure{&grab_ms},
                                     MainFigure{&iterations, false, false},
                                     MainFigure{&error_rms, true, false},
                                     MainFigure{&error_max, true, false},
                                     MainFigure{&hausdorff, false, false},
                                     MainFigure{&volume_change, false, false},
                                     MainFigure{&inverted_cells, false, false},
                                     MainFigure{&stretch, false, false},
                                     MainFigure{&violation_max, false, false},
                                     MainFigure{&residual, false, false},
                                     MainFigure{&binds, false, false}};
constexpr std::array of_answers{MainFigure{&relative},      MainFigure{&first_ms},      MainFigure{&later_ms},
                                MainFigure{&factorize_ms},  MainFigure{&grab_ms},       MainFigure{&hausdorff},
                                MainFigure{&volume_change}, MainFigure{&inverted_cells}};
constexpr std::array calibrated{MainFigure{&relative, true}, MainFigure{&error_rms, true},
                                MainFigure{&error_max, true}};

std::span<const MainFigure> main_figures(ReportKind kind) {
  switch (kind) {
    case ReportKind::compare:
      return compared;
    case ReportKind::judge:
      return of_answers;
    case ReportKind::calibrate:
      return calibrated;
    default:
      return against_physics;
  }
}

/// Formats a time with its quartiles and its number of repetitions.
std::string with_spread(const TimeSpread& ms) {
  return figure(ms.median) + " (" + figure(ms.lower_quartile) + "–" + figure(ms.upper_quartile) + ", " +
         std::to_string(ms.count) + ")";
}

std::string cell_of(const Figure& figure, const Joined& found, Medium medium) {
  const Value* value = found.row.find(figure);
  if (value == nullptr) {
    return "-";
  }
  const std::string cell =
      value->spread && medium == Medium::page ? with_spread(*value->spread) : cell_of(figure, found.row);
  const bool lacks_some = &figure == &relative && found.drags < found.of;
  return lacks_some ? cell + " (" + std::to_string(found.drags) + " of " + std::to_string(found.of) + ")" : cell;
}

FigureTable::Column column_of(const Figure& figure) { return {group_with_unit(figure), std::string(figure.heading)}; }

/// Returns the heading of a figure that has a column for each drag: `time per move (ms)`.
std::string whole_heading(const Figure& figure) {
  return &figure == &relative ? group_with_unit(figure)
                              : std::string(figure.group) + ", " + std::string(figure.heading) + in_brackets(figure);
}

std::vector<std::string> names_of_drags(const ObjectInfo& object) {
  std::vector<std::string> names;
  for (const DragInfo& drag : object.drags) {
    if (std::ranges::find(names, drag.name) == names.end()) {
      names.push_back(drag.name);
    }
  }
  return names;
}

/// A column of a table of contestants.
struct Column {
  FigureTable::Column head;
  const Figure* figure;
  Drags which;
  std::string drag = {};  // with this name; empty: all of them
};

std::vector<Column> columns_of(const Results& results, std::size_t object, Medium medium) {
  const auto present = figures_in(results, object);
  const bool has_cuts = std::ranges::any_of(results.objects[object].drags, &DragInfo::has_cut);
  std::vector<Column> columns;
  for (const auto& [figure, each_drag, on_terminal] : main_figures(results.kind)) {
    if (std::ranges::count(present, figure) == 0 || (medium == Medium::terminal && !on_terminal)) {
      continue;
    }
    if (each_drag) {
      for (const std::string& name : names_of_drags(results.objects[object])) {
        columns.push_back({{whole_heading(*figure), name}, figure, Drags::all, name});
      }
      continue;
    }
    const Drags which = figure == &after_cut_ms                           ? Drags::cut
                        : has_cuts && results.kind == ReportKind::physics ? Drags::uncut
                                                                          : Drags::all;
    columns.push_back({column_of(*figure), figure, which});
  }
  return columns;
}

/// True if a row repeats the refusal of the row before: an algorithm that cannot take part has one row for all sweeps.
bool repeats(const FigureTable& table, const Contestant& one, const Contestant* before, const std::string& refusal) {
  return !refusal.empty() && before != nullptr && before->algorithm == one.algorithm && !table.rows.empty() &&
         table.rows.back().refusal == refusal;
}

std::string joined_with(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

/// Describes the drags of an object once for each name, and those that are left out.
std::string about_drags(const ObjectInfo& object) {
  std::string text;
  for (const std::string& name : names_of_drags(object)) {
    const DragInfo& drag = *std::ranges::find(object.drags, name, &DragInfo::name);
    text += drag.description.empty() ? "" : "; " + name + ": " + drag.description;
  }
  std::vector<Convergence> refined;
  for (const DragInfo& drag : object.drags) {
    if (!drag.no_reference.empty()) {
      text += "; no errors: " + drag.name + " of element " + std::to_string(drag.handle) + ", " + drag.no_reference;
    }
    if (drag.reference) {
      refined.push_back(*drag.reference);
    }
  }
  return text + (refined.empty() ? "" : "; " + convergence_in_words(refined));
}

/// Returns the shortest times of the curve of a row. `measured` has the standings for each speed.
FigureTable::Row time_row(const Row& row, const std::vector<std::vector<Standing>>& measured) {
  const Contestant curve = curve_of(row.contestant);
  FigureTable::Row cells{label(curve), {}, {}};
  const auto least = measured.empty() ? std::nullopt : least_error(measured.front(), curve);
  if (!least) {
    cells.refusal = row.refusal;
    return cells;
  }
  const Standing& first =
      *std::ranges::find(measured.front(), curve, [](const Standing& one) { return curve_of(one.contestant); });
  cells.cells.push_back(error_figure(*least, first.change));
  for (const auto& all : measured) {
    for (const double error : errors_reached) {
      const auto ms = shortest_ms(all, curve, error);
      cells.cells.push_back(ms ? figure(*ms) : "-");
    }
  }
  cells.cells.push_back(cell_of(factorize_ms, row));
  return cells;
}

/// Returns the figures of a contestant at its largest size, the growth of its time, and its first and last error.
std::vector<std::string> growth_cells(const Results& results, const std::vector<SeriesPoint>& points) {
  std::vector<std::string> errors;
  for (const SeriesPoint& point : points) {
    if (point.figures.row[relative]) {
      errors.push_back(cell_of(relative, point.figures.row));
    }
  }
  const auto& [object, last] = points.back();
  const auto growth = growth_of(points, results, later_ms);
  return {thousands(results.objects[object].elements),
          cell_of(later_ms, last.row),
          cell_of(prepare_ms, last.row),
          growth ? figure(growth->power) : "-",
          errors.empty() ? "-" : errors.front(),
          errors.empty() ? "-" : errors.back()};
}

}  // namespace

std::string about(const Results& results, std::size_t object) {
  const ObjectInfo& one = results.objects[object];
  std::string text = one.description + "; " + thousands(one.elements) + " elements, " + thousands(one.links) +
                     " links" + (one.pins > 0 ? ", " + thousands(one.pins) + " pinned" : "");
  text += one.reference.empty() ? "" : "; reference: " + one.reference;
  text += about_drags(one);
  return text + (one.notes.empty() ? "" : "; " + joined_with(one.notes, "; "));
}

std::vector<const Figure*> first_figures(ReportKind kind) {
  std::vector<const Figure*> first;
  for (const MainFigure& one : main_figures(kind)) {
    if (one.on_terminal) {
      first.push_back(one.figure);
    }
  }
  return first;
}

std::string cell_of(const Figure& of, const Row& row) {
  const auto value = row[of];
  if (!value) {
    return "-";
  }
  if (&of == &relative || &of == &relative_turned) {
    const auto change = row[reference_change];
    return !change && *value < reference_found_again ? "<1e-5" : error_figure(*value, change);
  }
  switch (of.format) {
    case FigureFormat::count:
      return count(value);
    case FigureFormat::percent:
      return percent(*value);
    case FigureFormat::signed_percent:
      return signed_percent(value) + "%";
    case FigureFormat::yes_no:
      return *value != 0 ? "yes" : "no";
    case FigureFormat::number:
      break;
  }
  return of.group == turned_45_max.group || of.group == turned_90_max.group
             ? *value < rounding_of_turns ? "0" : figure(*value)
             : figure(*value);
}

FigureTable summary_table(const Results& results) {
  FigureTable table{.caption = "Summary",
                    .about =
                        "mean relative error over the drags of an object without a cut. 1: as wrong as an object "
                        "that does not move. *: the closest, without neo-Hookean FEM, the material of most "
                        "references. Below: less than the reference itself changed in its last refinement",
                    .style = "detail",
                    .corner = "contestant"};
  std::vector<Contestant> all;
  std::vector<std::vector<Standing>> columns;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    auto column = standings(results, i, speeds_against_error().front());
    if (column.empty() || has_curves(results, i) || !results.objects[i].series.empty()) {
      continue;
    }
    for (const Standing& one : column) {
      if (std::ranges::find(all, one.contestant) == all.end()) {
        all.push_back(one.contestant);
      }
    }
    table.columns.push_back({group_with_unit(relative), results.objects[i].name});
    columns.push_back(std::move(column));
  }
  for (const Contestant& contestant : all) {
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{label(contestant), {}, {}});
    for (const auto& column : columns) {
      const auto found = std::ranges::find(column, contestant, &Standing::contestant);
      const auto best = closest(column);
      row.cells.push_back(found == column.end() ? "-"
                                                : error_figure(found->error, found->change) +
                                                      (std::ranges::count(best, &*found) > 0 ? "*" : "") +
                                                      (found->is_complete ? "" : " (not all drags)"));
    }
  }
  return table;
}

FigureTable object_table(const Results& results, std::size_t object, Medium medium) {
  FigureTable table{.caption = results.objects[object].name,
                    .about = about(results, object),
                    .style = "main",
                    .corner = results.kind == ReportKind::judge ? "solver" : "contestant"};
  const std::vector<Column> columns = columns_of(results, object, medium);
  std::ranges::transform(columns, std::back_inserter(table.columns), &Column::head);
  const std::vector<Contestant> all = contestants_in(results, object);
  for (const Contestant& contestant : all) {
    const Joined everything = joined(results, object, contestant, Drags::all);
    if (everything.of == 0) {
      continue;
    }
    FigureTable::Row row{label(contestant), {}, everything.drags == 0 ? everything.row.refusal : ""};
    if (repeats(table, contestant, &contestant == &all.front() ? nullptr : &contestant - 1, row.refusal)) {
      continue;
    }
    for (const auto& [head, figure, which, drag] : columns) {
      if (row.refusal.empty()) {
        row.cells.push_back(cell_of(*figure, joined(results, object, contestant, which, drag), medium));
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

FigureTable detail_table(const Results& results, std::size_t object) {
  FigureTable table{.caption = results.objects[object].name,
                    .about = "all figures, drag by drag",
                    .style = "detail",
                    .corner = "drag, contestant"};
  const auto shown = figures_in(results, object);
  std::ranges::transform(shown, std::back_inserter(table.columns), [](const Figure* one) { return column_of(*one); });
  for (const Row* row : rows_of(results, object)) {
    const DragInfo* drag = results.drag_of(*row);
    const std::string where = drag == nullptr ? "" : drag->name + ", element " + std::to_string(drag->handle) + ": ";
    FigureTable::Row& cells =
        table.rows.emplace_back(FigureTable::Row{where + label(row->contestant), {}, row->refusal});
    for (const Figure* figure : shown) {
      if (row->refusal.empty()) {
        cells.cells.push_back(cell_of(*figure, {.row = *row, .drags = 1, .of = 1}, Medium::page));
      }
    }
  }
  return table;
}

FigureTable time_table(const Results& results, std::size_t object) {
  FigureTable table{.caption = results.objects[object].name,
                    .about = about(results, object),
                    .style = "detail",
                    .corner = "contestant",
                    .columns = {{group_with_unit(relative), "least"}}};
  std::vector<std::vector<Standing>> measured;
  for (const SpeedAgainstError& speed : speeds_against_error()) {
    if (auto all = standings(results, object, speed); !all.empty()) {
      measured.push_back(std::move(all));
      for (const double error : errors_reached) {
        table.columns.push_back({"ms, " + std::string(speed.what) + ", error at most", figure(error)});
      }
    }
  }
  table.columns.push_back(column_of(factorize_ms));
  std::vector<Contestant> curves;
  for (const Row* row : rows_of(results, object)) {
    if (std::ranges::find(curves, curve_of(row->contestant)) == curves.end()) {
      curves.push_back(curve_of(row->contestant));
      table.rows.push_back(time_row(*row, measured));
    }
  }
  return table;
}

FigureTable order_table(const Results& results, const std::string& series) {
  FigureTable table{.caption = series, .style = "detail", .corner = "contestant"};
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    if (results.objects[i].series == series) {
      sizes.push_back(i);
      table.columns.push_back({group_with_unit(relative) + ", elements", thousands(results.objects[i].elements)});
    }
  }
  table.about = sizes.empty() ? "" : about(results, sizes.back());
  table.columns.push_back({"observed", "order"});
  for (const Contestant& contestant : contestants_in(results, series)) {
    const auto points = points_of(results, series, contestant);
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{label(contestant), {}, {}});
    if (std::ranges::none_of(points, [](const SeriesPoint& one) { return one.figures.row.has_figures(); })) {
      row.refusal = points.empty() ? "" : points.front().figures.row.refusal;
      continue;
    }
    for (const std::size_t size : sizes) {
      const auto found = std::ranges::find(points, size, &SeriesPoint::object);
      row.cells.push_back(found == points.end() ? "-" : cell_of(relative, found->figures.row));
    }
    const auto order = order_of(points);
    row.cells.push_back(order ? figure(*order) : "-");
  }
  return table;
}

FigureTable growth_table(const Results& results, const std::string& series) {
  FigureTable table{.caption = series,
                    .style = "detail",
                    .corner = "contestant",
                    .columns = {{"the largest object", "elements"},
                                {"the largest object", "ms per later move"},
                                {"the largest object", "prepare (ms)"},
                                {"growth of time, from " + figure(growth_from) + " elements on", "exponent"},
                                {group_with_unit(relative), "first size"},
                                {group_with_unit(relative), "last known"},
                                {"why not larger", ""}}};
  std::size_t last_of_all = 0;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    last_of_all = results.objects[i].series == series ? i : last_of_all;
  }
  table.about = results.objects[last_of_all].description;
  const std::vector<Contestant> all = contestants_in(results, series);
  for (const Contestant& contestant : all) {
    auto points = points_of(results, series, contestant);
    const std::string refusal = points.empty() ? "" : points.back().figures.row.refusal;
    std::erase_if(points, [](const SeriesPoint& one) { return !one.figures.row.has_figures(); });
    FigureTable::Row row{label(contestant), {}, refusal};
    if (!points.empty()) {
      row = {label(contestant), growth_cells(results, points), {}};
      row.cells.push_back(points.back().object == last_of_all ? "this is the largest object"
                          : refusal.empty()                   ? "its time is used up"
                                                              : refusal);
    }
    if (!repeats(table, contestant, &contestant == &all.front() ? nullptr : &contestant - 1, row.refusal)) {
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

FigureTable turned_table(const Results& results) {
  constexpr std::array shown{&turned_45_max, &turned_90_max, &turned_45_relative, &turned_90_relative};
  FigureTable table{.caption = "Turned objects",
                    .about = "difference of the answer after turning back, at the end of one move",
                    .style = "detail",
                    .corner = "object, contestant"};
  std::ranges::transform(shown, std::back_inserter(table.columns), [](const Figure* one) { return column_of(*one); });
  for (const Row& one : results.rows) {
    if (!one.drag) {
      FigureTable::Row& row = table.rows.emplace_back(
          FigureTable::Row{results.object_of(one).name + ": " + label(one.contestant), {}, one.refusal});
      for (const Figure* figure : shown) {
        if (one.refusal.empty()) {
          row.cells.push_back(cell_of(*figure, one));
        }
      }
    }
  }
  return table;
}

std::vector<RampVerdict> ramp_verdicts(const Results& results) {
  std::vector<RampVerdict> verdicts;
  for (const std::string& series : series_in(results)) {
    for (const Contestant& contestant : contestants_in(results, series)) {
      if (!contestant.algorithm) {
        continue;  // a file that somebody edited
      }
      RampVerdict& verdict = verdicts.emplace_back(RampVerdict{*contestant.algorithm});
      const auto points = points_of(results, series, contestant);
      for (const auto& [object, found] : points) {
        verdict.lost = found.row[real_time] == 0.0;
        verdict.largest = verdict.lost ? verdict.largest : object;
      }
      verdict.growth = growth_of(points, results, median_ms);
    }
  }
  return verdicts;
}

FigureTable ramp_table(const Results& results) {
  FigureTable table{.caption = "Real time",
                    .about = "99 % of the passes are within the budget",
                    .style = "main",
                    .corner = "algorithm",
                    .columns = {{"the largest grid in real time", "size"},
                                {"the largest grid in real time", "elements"},
                                {"the largest grid in real time", "median (ms)"},
                                {"the largest grid in real time", "99th percentile (ms)"},
                                {"growth of the median", "exponent"},
                                {"growth of the median", "elements"}}};
  for (const RampVerdict& verdict : ramp_verdicts(results)) {
    FigureTable::Row& row =
        table.rows.emplace_back(FigureTable::Row{std::string(info(verdict.algorithm).label), {}, {}});
    if (!verdict.largest) {
      row.refusal = "never in real time";
      continue;
    }
    const ObjectInfo& grid = results.objects[*verdict.largest];
    const Joined found = joined(results, *verdict.largest, {verdict.algorithm}, Drags::all);
    row.cells = {grid.name + (verdict.lost ? "" : " or more"),
                 thousands(grid.elements),
                 cell_of(median_ms, found.row),
                 cell_of(p99_ms, found.row),
                 verdict.growth ? figure(verdict.growth->power) : "-",
                 verdict.growth ? thousands(std::uint64_t(verdict.growth->from)) + " to " +
                                      thousands(std::uint64_t(verdict.growth->to))
                                : "-"};
  }
  return table;
}

FigureTable ramp_sizes(const Results& results) {
  FigureTable table{.caption = "All sizes",
                    .about = "median/99th percentile in ms; ! over the budget in two attempts",
                    .style = "detail",
                    .corner = "grid"};
  std::vector<Contestant> all;
  for (const std::string& series : series_in(results)) {
    all = contestants_in(results, series);
  }
  for (const Contestant& one : all) {
    table.columns.push_back({"", std::string(info(*one.algorithm).offered_name())});
  }
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    FigureTable::Row& row = table.rows.emplace_back(FigureTable::Row{results.objects[i].name, {}, {}});
    for (const Contestant& one : all) {
      const Row found = joined(results, i, one, Drags::all).row;
      const auto median = found[median_ms], slowest = found[p99_ms];
      row.cells.push_back(!median || !slowest
                              ? ""
                              : figure(*median, 2) + "/" + figure(*slowest, 2) + (found[real_time] == 0.0 ? "!" : ""));
    }
  }
  return table;
}

}  // namespace chainmail::report
