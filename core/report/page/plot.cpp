#include "report/page/plot.h"

#include <algorithm>
#include <set>

#include "report/page/format.h"
#include "report/page/looks.h"

namespace chainmail::report {
namespace {

/// The error that a plot shows; none where it is not defined.
using ErrorOf = std::optional<double> (*)(const Errors&);

std::optional<double> largest_violation(const Errors& errors) { return errors.violation.max; }

std::optional<double> distance_to_exact(const Errors& errors) {
  return errors.to_exact ? std::optional(errors.to_exact->rms) : std::nullopt;
}

std::set<int> sweeps_of(const CaseResult& result) {
  std::set<int> sweeps;
  for (const DragResult& drag : result.drags) {
    for (const Entry& entry : drag.entries) {
      sweeps.insert(entry.contestant.sweeps);
    }
  }
  return sweeps;
}

std::string in_words(const Entry& entry, double error, const std::string& what) {
  const TimeSpread& ms = entry.measurement->ms_per_move;
  return label(entry.contestant) + ": " + figure(ms.median) + " ms a move (quartiles " + figure(ms.lower_quartile) +
         " and " + figure(ms.upper_quartile) + "), " + what + " " + figure(error);
}

void add_legend_notes(Plot& plot, const std::set<int>& sweeps) {
  if (sweeps.contains(0)) {
    plot.legend_notes.emplace_back("filled: without relaxation");
  }
  if (sweeps.size() > sweeps.count(0)) {
    const bool one = sweeps.size() - sweeps.count(0) == 1;
    plot.legend_notes.push_back(one ? "hollow: " + std::to_string(*sweeps.rbegin()) + " sweeps a move"
                                    : std::string("hollow: so many sweeps a move"));
  }
  plot.legend_notes.emplace_back("bars: quartiles of the time");
}

Plot plot_of(const CaseResult& result, ErrorOf error_of, const std::string& what, const std::string& unit) {
  Plot plot;
  plot.title = "Time against " + what + " on " + result.name;
  plot.x_label = "ms a move";
  plot.y_label = what + " (" + unit + ")";
  const std::set<int> sweeps = sweeps_of(result);
  const bool many = sweeps.size() - sweeps.count(0) > 1;
  for (const DragResult& drag : result.drags) {
    PlotPanel& panel = plot.panels.emplace_back();
    panel.title = drag.name;
    for (const Entry& entry : drag.entries) {
      const auto error = entry.measurement ? error_of(entry.measurement->errors) : std::nullopt;
      if (!error) {
        continue;
      }
      const TimeSpread& ms = entry.measurement->ms_per_move;
      const int count = entry.contestant.sweeps;
      panel.marks.push_back({ms.median, ms.lower_quartile, ms.upper_quartile, *error,
                             series_of(plot, entry.contestant.algorithm), count > 0,
                             many && count > 0 ? std::to_string(count) : "", in_words(entry, *error, what)});
    }
  }
  add_legend_notes(plot, sweeps);
  return plot;
}

}  // namespace

std::size_t series_of(Plot& plot, Algorithm algorithm) {
  const std::size_t look = look_of(algorithm);
  const auto found = std::ranges::find(plot.series, look, &PlotSeries::look);
  if (found != plot.series.end()) {
    return static_cast<std::size_t>(found - plot.series.begin());
  }
  plot.series.push_back({std::string(info(algorithm).label), look});
  return plot.series.size() - 1;
}

Plot violation_plot(const CaseResult& result) {
  Plot plot = plot_of(result, largest_violation, "largest violation", "rest lengths");
  plot.good_below = 1e-4;
  plot.good_label = "counts as valid";
  return plot;
}

Plot distance_plot(const CaseResult& result) {
  return plot_of(result, distance_to_exact, "RMS distance to Exact", "mean rest lengths");
}

}  // namespace chainmail::report
