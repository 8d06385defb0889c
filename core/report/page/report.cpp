#include "report/page/report.h"

#include <algorithm>
#include <utility>

#include "report/page/svg.h"
#include "report/page/tables.h"
#include "report/run/ramp.h"
#include "report/run/suite.h"
#include "report/table/format.h"
#include "report/table/summary.h"

namespace chainmail::report {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --ink: #1b1b1b; --paper: #fff; --faint: #666; --rule: #d5d5d5; --band: #f3f4f6; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e6e6; --paper: #17191c; --faint: #a3a3a3; --rule: #3a3d42; --band: #22262b; }
}
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: var(--ink); background: var(--paper);
  max-width: 72rem; margin: 2.5rem auto; padding: 0 1.5rem; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.25rem; margin: 2.6rem 0 .5rem; border-bottom: 1px solid var(--rule); padding-bottom: .2rem; }
h3 { font-size: 1.02rem; margin: 1.6rem 0 .3rem; }
p { max-width: 46rem; margin: .5rem 0; }
.faint, caption .faint { color: var(--faint); font-weight: normal; }
table { border-collapse: collapse; width: 100%; font-size: .8rem; margin: 1.1rem 0 1.6rem;
  font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; font-size: .95rem; padding: .2rem 0 .4rem; }
caption div { max-width: min(60rem, 90vw); }
th, td { padding: .17rem .5rem; text-align: right; white-space: nowrap; }
th { font-weight: 600; vertical-align: bottom; }
thead tr:last-child th { border-bottom: 1.5px solid var(--ink); }
th.group { text-align: center; white-space: normal; border-bottom: 1px solid var(--rule); font-weight: normal;
  color: var(--faint); }
tbody th, th:first-child { text-align: left; font-weight: normal; vertical-align: top; }
.detail { font-size: .72rem; } .detail th, .detail td { padding: .12rem .33rem; }
.main { table-layout: fixed; min-width: 50rem; } .main th:first-child { width: 17rem; }
tbody tr { border-bottom: 1px solid var(--rule); }
tbody tr:nth-child(even) { background: var(--band); }
td.refusal { text-align: left; white-space: normal; color: var(--faint); font-style: italic; }
figure { margin: .8rem 0 1.4rem; }
svg { max-width: 100%; height: auto; color: var(--ink); display: block; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .15rem 1.2rem; margin: .5rem 0; }
dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .85em; }
.wide { overflow-x: auto; }
@page { size: A4 landscape; margin: 14mm; }
@media print {
  :root { --ink: #000; --paper: #fff; --faint: #444; --rule: #bbb; --band: #f3f3f3; }
  body { margin: 0; max-width: none; padding: 0; font-size: 10.5pt; }
  .main { font-size: 8pt; } .detail { font-size: 6.8pt; }
  table, figure, tr { break-inside: avoid; } h2, h3, caption { break-after: avoid; } .wide { overflow: visible; }
}
)";

// CSV

/// A column that says which row it is.
struct RowColumn {
  std::string_view name;
  std::string (*value)(const Results& results, const Row& row);
};

std::string text_of(bool is) { return is ? "1" : "0"; }

template <class Value>
std::string of_drag(const Results& results, const Row& row, Value DragInfo::*member) {
  const DragInfo* drag = results.drag_of(row);
  if (drag == nullptr) {
    return {};
  }
  if constexpr (std::is_same_v<Value, std::string>) {
    return csv_field(drag->*member);
  } else {
    return all_digits(double(drag->*member));
  }
}

constexpr RowColumn row_columns[]{
    {"object", [](const Results& all, const Row& row) { return csv_field(all.object_of(row).name); }},
    {"series", [](const Results& all, const Row& row) { return csv_field(all.object_of(row).series); }},
    {"elements", [](const Results& all, const Row& row) { return std::to_string(all.object_of(row).elements); }},
    {"links", [](const Results& all, const Row& row) { return std::to_string(all.object_of(row).links); }},
    {"pins", [](const Results& all, const Row& row) { return std::to_string(all.object_of(row).pins); }},
    {"drag", [](const Results& all, const Row& row) { return of_drag(all, row, &DragInfo::name); }},
    {"handle", [](const Results& all, const Row& row) { return of_drag(all, row, &DragInfo::handle); }},
    {"moves", [](const Results& all, const Row& row) { return of_drag(all, row, &DragInfo::moves); }},
    {"has_cut", [](const Results& all, const Row& row) { return of_drag(all, row, &DragInfo::has_cut); }},
    {"handle_displacement",
     [](const Results& all, const Row& row) { return of_drag(all, row, &DragInfo::handle_displacement); }},
    {"contestant", [](const Results&, const Row& row) { return csv_field(label(row.contestant)); }},
    {"algorithm", [](const Results&, const Row& row) { return csv_field(name(row.contestant)); }},
    {"sweeps", [](const Results&, const Row& row) { return std::to_string(row.contestant.sweeps); }},
    {"equilibrium", [](const Results&, const Row& row) { return text_of(row.contestant.equilibrium); }},
    {"open_regions", [](const Results&, const Row& row) { return text_of(row.contestant.open_regions); }},
    {"calibrated", [](const Results&, const Row& row) { return text_of(row.contestant.calibrated.has_value()); }},
    {"limit", [](const Results&, const Row& row) { return std::to_string(row.contestant.limit); }},
    {"refusal", [](const Results&, const Row& row) { return csv_field(row.refusal); }},
};
constexpr RowColumn ramp_columns[]{
    {"width", [](const Results& all, const Row& row) { return std::to_string(width_of(all.object_of(row))); }},
    row_columns[2],
    row_columns[3],
    row_columns[11],
};

std::span<const RowColumn> columns_of(const Results& results) {
  return results.kind == ReportKind::ramp ? std::span<const RowColumn>(ramp_columns)
                                          : std::span<const RowColumn>(row_columns);
}

bool has_spread(const Results& results, const Figure& figure) {
  return std::ranges::any_of(results.rows, [&](const Row& row) {
    const Value* value = row.find(figure);
    return value != nullptr && value->spread;
  });
}

void write_value(std::ostream& out, const Value* value, bool with_spread) {
  out << ',' << (value == nullptr ? "" : all_digits(value->number));
  if (!with_spread) {
    return;
  }
  const bool has = value != nullptr && value->spread;
  out << ',' << (has ? all_digits(value->spread->lower_quartile) : "") << ','
      << (has ? all_digits(value->spread->upper_quartile) : "") << ','
      << (has ? std::to_string(value->spread->count) : "");
}

}  // namespace

void write_csv(std::ostream& out, const Results& results) {
  std::vector<std::pair<const Figure*, bool>> shown;  // and whether it has a spread
  for (const Figure* figure : figures_in(results)) {
    shown.emplace_back(figure, has_spread(results, *figure));
  }
  const auto columns = columns_of(results);
  for (const RowColumn& column : columns) {
    out << (&column == &columns.front() ? "" : ",") << column.name;
  }
  for (const auto& [figure, with_spread] : shown) {
    out << ',' << figure->key;
    if (with_spread) {
      out << ',' << figure->key << "_lower_quartile," << figure->key << "_upper_quartile," << figure->key
          << "_repetitions";
    }
  }
  out << '\n';
  for (const Row& row : results.rows) {
    for (const RowColumn& column : columns) {
      out << (&column == &columns.front() ? "" : ",") << column.value(results, row);
    }
    for (const auto& [figure, with_spread] : shown) {
      write_value(out, row.find(*figure), with_spread);
    }
    out << '\n';
  }
}

namespace {

// Tables

/// A part of a report: its heading, and its tables.
struct Part {
  std::string heading;
  std::vector<FigureTable> tables;
};

void add(std::vector<FigureTable>& tables, FigureTable table) {
  if (!table.rows.empty()) {
    tables.push_back(std::move(table));
  }
}

std::vector<Part> parts_of(const Results& results, Medium medium) {
  Part main{"Main figures", {}}, more{"More", {}}, details{"All figures", {}};
  if (results.kind == ReportKind::ramp) {
    add(main.tables, ramp_table(results));
    add(details.tables, ramp_sizes(results));
    return {std::move(main), std::move(details)};
  }
  add(main.tables, summary_table(results));
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    if (!results.objects[i].series.empty()) {
      continue;
    }
    add(main.tables, has_curves(results, i) ? time_table(results, i) : object_table(results, i, medium));
    if (medium == Medium::page) {
      add(details.tables, detail_table(results, i));
    }
  }
  add(more.tables, turned_table(results));
  for (const std::string& series : series_in(results)) {
    add(more.tables,
        results.kind == ReportKind::physics ? growth_table(results, series) : order_table(results, series));
  }
  return {std::move(main), std::move(more), std::move(details)};
}

/// Returns what a reader must know of a kind of report, without what figures mean.
std::vector<std::string> how_to_read(const Results& results) {
  const std::string rule =
      "One rule ends all iterations: a contestant makes the least number per move with which its answer at the end of "
      "the drag is within " +
      percent(own_limit_of_comparisons) + " of its own limit, the answer after as many as it wants.";
  const std::string contest =
      "Every contestant carries out the same moves of the same handle on the same object, from rest, in turns within "
      "one process and one thread. Times are medians over the repetitions, with their quartiles and number in "
      "brackets; "
      "the time of other programs does not count.";
  const std::string physics =
      "The reference is the closed form where there is one, else finite elements in double precision, converged on the "
      "same cells as the object or, where an object says so, on refined cells. One displaced node has no continuum "
      "limit, so errors on the same cells depend on the mesh, and methods on these cells have an advantage over those "
      "with other cells. Nothing moves is an object in which only the handle and the pins have their places: a method "
      "with a larger error is no better than no method. A contestant that does not converge has no figures.";
  const std::string plots =
      "In the plots, lower is better and further left is faster. A contestant is on the front if no other one is at "
      "least as fast and as close, and better in one of both.";
  switch (results.kind) {
    case ReportKind::compare:
      return {
          contest,
          "Errors are measured in double at the end of a drag, while the handle is still held; figures near 10⁻⁶ are "
          "the rounding of single precision. + equilibrium relaxes after each move to the valid state of least "
          "energy, until the residual is at most " +
              figure(compared_residual) + ", in at most " + std::to_string(equilibrium_iterations) + " iterations.",
          plots};
    case ReportKind::ramp:
      return {
          "At each size all algorithms run the same drags from rest, one after another. An algorithm stops when the "
          "99th percentile of its passes exceeds the budget in two attempts."};
    case ReportKind::physics:
    case ReportKind::suite:
      return {contest, physics, rule, plots};
    default:
      return {};
  }
}

// HTML

void begin_page(std::ostream& out, const Results& results) {
  const std::string title(report_info(results.kind).title);
  out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>"
      << escaped(title) << "</title>\n<style>" << style << "</style>\n</head>\n<body>\n<h1>" << escaped(title)
      << "</h1>\n";
  if (!results.runs.empty()) {
    const Origin& origin = results.runs.front().origin;
    out << "<p class=\"faint\">" << escaped(origin.date) << " · " << escaped(origin.machine.processor) << "</p>\n";
  }
}

void write_item(std::ostream& out, const std::string& term, const std::string& what) {
  out << "<dt>" << escaped(term) << "</dt><dd>" << escaped(what) << "</dd>\n";
}

void write_glossary(std::ostream& out, const Results& results) {
  out << "<h2>How to read it</h2>\n";
  for (const std::string& paragraph : how_to_read(results)) {
    out << "<p>" << escaped(paragraph) << "</p>\n";
  }
  out << "<dl>\n";
  for (const Figure* figure : figures_in(results)) {
    if (!figure->definition.empty()) {
      write_item(out, std::string(figure->group) + ", " + std::string(figure->heading), definition_of(*figure));
    }
  }
  out << "</dl>\n";
}

std::string in_words(const Setting& setting) {
  const auto* number = std::get_if<double>(&setting.second);
  return number != nullptr ? figure(*number, 6) : std::get<std::string>(setting.second);
}

void write_origin(std::ostream& out, const Results& results) {
  out << "<h2>Origin of the figures</h2>\n<dl>\n";
  for (const auto& [origin, shard, experiments] : results.runs) {
    const Machine& machine = origin.machine;
    std::string names;
    for (const std::string& name : experiments) {
      names += (names.empty() ? " · " : ", ") + name;
    }
    write_item(out, shard.empty() ? "command" : "part " + shard, origin.command_line);
    write_item(out, "run",
               origin.date + " · " + origin.version + " · " + machine.processor + ", " + std::to_string(machine.cores) +
                   " cores, one of them used · " + machine.compiler + " · " + machine.build + names);
  }
  for (const Setting& setting : results.settings) {
    write_item(out, setting.first, in_words(setting));
  }
  out << "</dl>\n</body>\n</html>\n";
}

}  // namespace

void write_text(std::ostream& out, const Results& results) {
  for (const std::string& sentence : findings(results)) {
    out << sentence << '\n';
  }
  for (const Part& part : parts_of(results, Medium::terminal)) {
    for (const FigureTable& table : part.tables) {
      write_text(out, table);
    }
  }
  if (results.stopped) {
    out << "It was stopped before its end.\n";
  }
}

void write_html(std::ostream& out, const Results& results) {
  begin_page(out, results);
  if (const auto sentences = findings(results); !sentences.empty()) {
    out << "<h2>Who is closest</h2>\n<ul>\n";
    for (const std::string& sentence : sentences) {
      out << "<li>" << escaped(sentence) << "</li>\n";
    }
    out << "</ul>\n";
  }
  if (results.kind == ReportKind::suite) {
    std::string missing;
    for (const std::string& name : missing_from(results)) {
      missing += (missing.empty() ? "Not part of this report: " : ", ") + name;
    }
    out << (missing.empty() ? "" : "<p class=\"faint\">" + escaped(missing) + "</p>\n");
  }
  if (const auto plots = plots_of(results); !plots.empty()) {
    out << "<h2>Time against error</h2>\n";
    for (const PlotFile& one : plots) {
      out << "<figure>\n";
      write_svg(out, one.plot);
      out << "</figure>\n";
    }
  }
  write_glossary(out, results);
  for (const Part& part : parts_of(results, Medium::page)) {
    out << (part.tables.empty() ? "" : "<h2>" + part.heading + "</h2>\n");
    for (const FigureTable& table : part.tables) {
      write_html(out, table);
    }
  }
  write_origin(out, results);
}

}  // namespace chainmail::report
