#include "report/page/suite_page.h"

#include <algorithm>
#include <span>
#include <vector>

#include "report/page/figures.h"
#include "report/page/format.h"
#include "report/page/page.h"

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

namespace {

constexpr double smallest_error = 1e-5;
constexpr const char* front_colour = "#9a9a9a";

void add_mark(Plot& plot, PlotPanel& panel, const SuiteMean& mean, const SpeedAgainstError& measure) {
  const auto& error = mean.*measure.error;
  if (!error || mean.drags < mean.of) {
    return;
  }
  const auto algorithm = find_algorithm(mean.algorithm);
  if (!algorithm) {
    panel.level = mean.algorithm == "nothing" ? std::optional(PlotLevel{*error, "nothing moves"}) : panel.level;
    return;
  }
  const auto& ms = mean.*measure.ms;
  if (!ms) {
    return;
  }
  const auto says = [&](const char* word) { return mean.contestant.find(word) != std::string::npos; };
  const bool calibrated = says("calibrated"), equilibrium = says("equilibrium"), material = says("Material");
  const std::string note = equilibrium  ? (calibrated ? "eq. cal." : equilibrium_mark)
                           : calibrated ? "cal."
                           : material   ? material_mark
                                        : "";
  panel.marks.push_back({*ms, *ms, *ms, counted_error(mean, measure), series_of(plot, *algorithm),
                         calibrated || equilibrium || material, note,
                         mean.contestant + ": " + figure(*ms) + " ms per " + std::string(measure.what) +
                             ", relative error " + error_figure(*error, mean.*measure.change)});
}

/// Adds a mark for each point of a contestant's curve, and a line through them. The last mark has the note.
void add_curve(Plot& plot, PlotPanel& panel, const std::vector<SuiteMean>& points, const SpeedAgainstError& measure) {
  const std::size_t first = panel.marks.size();
  for (const SuiteMean& point : points) {
    add_mark(plot, panel, point, measure);
  }
  const auto added = std::span(panel.marks).subspan(first);
  if (added.size() < 2) {
    return;
  }
  PlotCurve& curve = panel.curves.emplace_back(PlotCurve{added.front().series, {}});
  for (PlotMark& mark : added) {
    curve.points.push_back({mark.x, mark.y});
    mark.note = &mark == &added.back() ? mark.note : "";
  }
}

/// Adds a line through the contestants that no other one beats, in steps.
void add_front(PlotPanel& panel, std::size_t series, const std::vector<SuiteMean>& means,
               const SpeedAgainstError& measure) {
  PlotCurve steps{series, {}};
  for (const SuiteMean* one : front(means, measure)) {
    const double ms = *(one->*measure.ms), error = counted_error(*one, measure);
    if (!steps.points.empty()) {
      steps.points.push_back({ms, steps.points.back()[1]});
    }
    steps.points.push_back({ms, error});
  }
  if (steps.points.size() > 1) {
    panel.curves.push_back(std::move(steps));
  }
}

}  // namespace

Plot suite_plot(const Suite& suite, const SpeedAgainstError& measure) {
  const std::string what(measure.what);
  Plot plot;
  plot.title = "Time per " + what + " against error, means of the drags";
  plot.x.title = "ms per " + what;
  plot.y.title = "relative error";
  plot.y.smallest = smallest_error;
  plot.legend_notes = {"hollow: with relaxation", material_note, equilibrium_note};
  bool has_curves = false;
  std::vector<std::vector<SuiteMean>> shown;  // of each panel
  for (const SuiteResult& result : suite.results) {
    PlotPanel panel{result.name, {}, {}};
    for (const SuiteMean& mean : means_of(result)) {
      add_mark(plot, panel, mean, measure);
    }
    for (const SuiteTime& time : result.times) {
      add_curve(plot, panel, points_of(result, time), measure);
    }
    has_curves = has_curves || !panel.curves.empty();
    if (!panel.marks.empty()) {
      plot.panels.push_back(std::move(panel));
      shown.push_back(compared_in(result));
    }
  }
  if (has_curves) {
    plot.legend_notes.emplace_back("lines: more and more iterations per move");
  }
  // After those of the algorithms, which are found by their styles.
  plot.series.push_back({"front: none is faster and closer", 0, front_colour});
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    add_front(plot.panels[i], plot.series.size() - 1, shown[i], measure);
  }
  return plot;
}

std::vector<PlotFile> plots_of(const Suite& suite) {
  std::vector<PlotFile> plots;
  for (const SpeedAgainstError& measure : speeds_against_error) {
    if (Plot plot = suite_plot(suite, measure); !plot.panels.empty()) {
      plots.push_back({std::string(measure.file) + ".svg", std::move(plot)});
    }
  }
  return plots;
}

namespace {

constexpr const char* how_to_read_suite = R"(<h2>How to read it</h2>
<p>Every contestant carries out the same moves of the same handle on the same object, from rest, in turns within one
process and one thread. The <b>relative error</b> is the RMS distance from the reference at the end of a drag, over the
RMS displacement of the reference, over the elements that are neither pinned nor in the handle: an object that does not
move has 1. <b>Turned by 45°</b> is the error of the same drag on the object turned about the origin; it equals the other
one for a method that does not depend on the axes. The reference is the closed form where there is one, else finite
elements on refined cells.</p>
<p><b>Factorize</b> happens once for an object, its pins and cuts, <b>grab</b> once for each handle. <b>First</b> and
<b>later</b> are moves after all preparation; <b>after cut</b> is the move after a cut in the middle of a drag, with all
preparation that it repeats. Times are medians. <b>Bytes</b> is the memory of a solver after its first drag, without the
mesh. A contestant that does not converge has no figures. The <b>time to an error</b> is the shortest with which a
contestant has at most this error, over all numbers of iterations or sweeps per move. These numbers, one after the other,
are the points of its curve in the plots: × 10 means ten per move.</p>
<p>One rule ends all <b>iterations</b>: a contestant makes the least number per move with which its answer at the end of the
drag is within 1 % of its own limit, the answer after as many as it wants. A contestant is on the <b>front</b> if no other
one is at least as fast and as close, and better in one of both. Where <b>regions bind</b> is 0, ChainMail's valid regions
had no part in the answer: it is that of the energy. <b>Calibrated</b> contestants, with <code>--calibrated on</code>, have
the softness that is closest to the reference on drags of other elements.</p>
)";

void write_runs(std::ostream& out, const Suite& suite) {
  out << "<h2>Origin of the figures</h2>\n<dl>\n";
  for (const SuiteRun& run : suite.runs) {
    const Machine& machine = run.origin.machine;
    std::string names;
    for (const std::string& name : run.experiments) {
      names += (names.empty() ? "" : ", ") + name;
    }
    out << "<dt>part " << escaped(run.shard) << "</dt><dd><code>" << escaped(run.origin.command_line) << "</code><br/>"
        << escaped(run.origin.date + " · " + run.origin.version + " · " + machine.processor + ", " +
                   std::to_string(machine.cores) + " cores, one of them used · " + machine.compiler + " · " +
                   machine.build + " · " + names)
        << "</dd>\n";
  }
  out << "</dl>\n</body>\n</html>\n";
}

}  // namespace

void write_html(std::ostream& out, const Suite& suite) {
  begin_page(out, "ChainMail and the methods of today", suite.runs.front().origin);
  out << "<h2>Who is closest</h2>\n<ul>\n";
  for (const std::string& sentence : suite_findings(suite)) {
    out << "<li>" << escaped(sentence) << "</li>\n";
  }
  out << "</ul>\n";
  std::string missing;
  for (const std::string& name : missing_from(suite)) {
    missing += (missing.empty() ? "" : ", ") + name;
  }
  if (!missing.empty()) {
    out << "<p class=\"faint\">Not part of this report: " << escaped(missing) << "</p>\n";
  }
  if (const FigureTable summary = suite_summary(suite); !summary.rows.empty()) {
    write_html(out, summary);
  }
  for (const SpeedAgainstError& measure : speeds_against_error) {
    if (const Plot plot = suite_plot(suite, measure); !plot.panels.empty()) {
      write_figure(out, plot);
    }
  }
  out << how_to_read_suite;
  for (const SuiteResult& result : suite.results) {
    out << "<h2>" << escaped(result.name) << "</h2>\n";
    if (!result.times.empty()) {
      write_html(out, time_table(result));
    }
    if (!result.orders.empty()) {
      write_html(out, order_table(result));
    }
    if (!result.rows.empty()) {
      write_html(out, suite_table(result));
    }
  }
  write_runs(out, suite);
}

}  // namespace chainmail::report
