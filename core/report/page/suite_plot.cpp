#include "report/page/suite_plot.h"

#include <algorithm>

#include "report/page/format.h"
#include "report/page/suite_table.h"

namespace chainmail::report {
namespace {

constexpr double smallest_error = 1e-5;

void add_mark(Plot& plot, PlotPanel& panel, const SuiteMean& mean) {
  if (!mean.relative || mean.drags < mean.of) {
    return;
  }
  const auto algorithm = find_algorithm(mean.algorithm);
  if (!algorithm) {
    panel.level = mean.algorithm == "nothing" ? std::optional(PlotLevel{*mean.relative, "nothing moves"}) : panel.level;
    return;
  }
  if (!mean.later_ms && !mean.after_cut_ms) {
    return;
  }
  const double ms = mean.later_ms.value_or(0);
  const bool calibrated = mean.contestant.find("calibrated") != std::string::npos;
  const bool equilibrium = mean.contestant.find("equilibrium") != std::string::npos;
  const std::string note = equilibrium ? (calibrated ? "eq. cal." : equilibrium_mark) : calibrated ? "cal." : "";
  panel.marks.push_back(
      {ms, ms, ms, *mean.relative, series_of(plot, *algorithm), calibrated || equilibrium, note,
       mean.contestant + ": " + figure(ms) + " ms per later move, relative error " + figure(*mean.relative)});
}

}  // namespace

Plot suite_plot(const Suite& suite) {
  Plot plot;
  plot.title = "Time against error, means of the drags";
  plot.x.title = "ms per later move";
  plot.y.title = "relative error";
  plot.y.smallest = smallest_error;
  plot.legend_notes = {"hollow: with relaxation", "cal.: calibrated on other drags", equilibrium_note};
  for (const SuiteResult& result : suite.results) {
    PlotPanel panel{result.name, {}, {}};
    for (const SuiteMean& mean : means_of(result)) {
      add_mark(plot, panel, mean);
    }
    if (!panel.marks.empty()) {
      plot.panels.push_back(std::move(panel));
    }
  }
  return plot;
}

}  // namespace chainmail::report
