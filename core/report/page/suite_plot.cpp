#include "report/page/suite_plot.h"

#include <algorithm>
#include <span>

#include "report/page/format.h"
#include "report/page/suite_table.h"

namespace chainmail::report {
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

}  // namespace chainmail::report
