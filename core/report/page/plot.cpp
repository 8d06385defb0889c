#include "report/page/plot.h"

#include <algorithm>
#include <set>

#include "report/page/format.h"
#include "report/page/plot_style.h"

namespace chainmail::report {
namespace {

template <double Distance::*Member>
std::optional<double> to_exact(const Errors& errors) {
  return errors.to_exact ? std::optional((*errors.to_exact).*Member) : std::nullopt;
}

constexpr std::array errors_to_plot{
    PlottedError{"largest violation", "rest lengths",
                 [](const Errors& errors) { return std::optional(errors.violation.max); }, 1e-4},
    PlottedError{"RMS violation", "rest lengths",
                 [](const Errors& errors) { return std::optional(errors.violation.rms); }},
    PlottedError{"largest distance to Exact", "mean rest lengths", to_exact<&Distance::max>},
    PlottedError{"RMS distance to Exact", "mean rest lengths", to_exact<&Distance::rms>}};

/// Returns the numbers of sweeps of all contestants.
std::set<int> sweeps_of(std::span<const DragResult> drags) {
  std::set<int> sweeps;
  for (const DragResult& drag : drags) {
    for (const Entry& entry : drag.entries) {
      if (!entry.contestant.equilibrium) {
        sweeps.insert(entry.contestant.sweeps);
      }
    }
  }
  return sweeps;
}

bool has_equilibrium(std::span<const DragResult> drags) {
  return std::ranges::any_of(drags, [](const DragResult& drag) {
    return std::ranges::any_of(drag.entries, [](const Entry& entry) { return entry.contestant.equilibrium; });
  });
}

std::string in_words(const Entry& entry, const PlottedError& error, double value) {
  const TimeSpread& ms = entry.measurement->ms_per_move;
  return label(entry.contestant) + ": " + figure(ms.median) + " ms per move (quartiles " + figure(ms.lower_quartile) +
         " and " + figure(ms.upper_quartile) + "), " + std::string(error.name) + " " + figure(value) + " " +
         std::string(error.unit);
}

void add_legend_notes(Plot& plot, const std::set<int>& sweeps, bool equilibrium) {
  if (sweeps.contains(0)) {
    plot.legend_notes.emplace_back("filled: without relaxation");
  }
  if (sweeps.size() > sweeps.count(0)) {
    const bool one = sweeps.size() - sweeps.count(0) == 1;
    plot.legend_notes.push_back(one ? "hollow: " + std::to_string(*sweeps.rbegin()) + " sweeps per move"
                                    : std::string("hollow: with that many sweeps per move"));
  }
  if (equilibrium) {
    plot.legend_notes.emplace_back(equilibrium_note);
  }
  plot.legend_notes.emplace_back("bars: quartiles of the time");
}

std::string note_of(Relaxing relaxing, bool with_sweeps) {
  if (relaxing.equilibrium) {
    return equilibrium_mark;
  }
  return with_sweeps && relaxing.sweeps > 0 ? std::to_string(relaxing.sweeps) : "";
}

/// Adds a panel with the marks of a drag's contestants. With `with_notes`, each mark shows its number of sweeps.
void add_panel(Plot& plot, const DragResult& drag, const PlottedError& error, bool with_notes) {
  PlotPanel& panel = plot.panels.emplace_back();
  panel.title = drag.name;
  for (const Entry& entry : drag.entries) {
    const auto value = entry.measurement ? error.of(entry.measurement->errors) : std::nullopt;
    if (!value) {
      continue;
    }
    const TimeSpread& ms = entry.measurement->ms_per_move;
    const Relaxing relaxing = entry.contestant.relaxing();
    panel.marks.push_back({ms.median, ms.lower_quartile, ms.upper_quartile, *value,
                           series_of(plot, entry.contestant.algorithm), !relaxing.is_none(),
                           note_of(relaxing, with_notes), in_words(entry, error, *value)});
  }
}

Plot plot_of(std::span<const DragResult> drags, const std::string& name, const PlottedError& error) {
  Plot plot;
  const std::string what(error.name), unit(error.unit);
  plot.title = "Time against " + what + " on " + name;
  plot.x.title = "ms per move";
  plot.x.unit = "ms per move";
  plot.y.title = what + " (" + unit + ")";
  plot.y.unit = unit;
  const std::set<int> sweeps = sweeps_of(drags);
  for (const DragResult& drag : drags) {
    add_panel(plot, drag, error, sweeps.size() - sweeps.count(0) > 1);
  }
  add_legend_notes(plot, sweeps, has_equilibrium(drags));
  plot.good_below = error.good_below;
  plot.good_label = "counts as valid";
  return plot;
}

std::vector<double> values_of_x(const Plot& plot) {
  std::vector<double> values;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotMark& mark : panel.marks) {
      values.insert(values.end(), {mark.x_low, mark.x_high});
    }
    for (const PlotCurve& curve : panel.curves) {
      std::ranges::transform(curve.points, std::back_inserter(values), [](const auto& point) { return point[0]; });
    }
  }
  return values;
}

std::vector<double> values_of_y(const Plot& plot) {
  std::vector<double> values;
  for (const PlotPanel& panel : plot.panels) {
    std::ranges::transform(panel.marks, std::back_inserter(values), &PlotMark::y);
    for (const PlotCurve& curve : panel.curves) {
      std::ranges::transform(curve.points, std::back_inserter(values), [](const auto& point) { return point[1]; });
    }
    if (panel.level) {
      values.push_back(panel.level->y);
    }
  }
  return values;
}

template <class Values>
Axis axis_of(const PlotAxis& axis, const Values& values) {
  if (!axis.linear) {
    return Axis::logarithmic(values(), axis.smallest);
  }
  if (axis.ends) {
    return Axis::linear(axis.ends->front(), axis.ends->back(), axis.ticks);
  }
  const std::vector<double> all = values();
  return Axis::from_zero_to(all.empty() ? 0 : *std::ranges::max_element(all));
}

}  // namespace

PlotAxes::PlotAxes(const Plot& plot)
    : x(axis_of(plot.x, [&] { return values_of_x(plot); })), y(axis_of(plot.y, [&] { return values_of_y(plot); })) {}

bool is_empty(const Plot& plot) {
  return std::ranges::all_of(plot.panels,
                             [](const PlotPanel& panel) { return panel.marks.empty() && panel.curves.empty(); });
}

std::size_t series_of(Plot& plot, Algorithm algorithm) {
  const std::size_t style = style_of(algorithm);
  const auto found = std::ranges::find(plot.series, style, &PlotSeries::style);
  if (found != plot.series.end()) {
    return static_cast<std::size_t>(found - plot.series.begin());
  }
  plot.series.push_back({std::string(info(algorithm).label), style});
  return plot.series.size() - 1;
}

std::span<const PlottedError> plotted_errors() { return errors_to_plot; }

Plot error_plot(const DragResult& drag, const PlottedError& error) { return plot_of({&drag, 1}, drag.name, error); }

Plot error_plot(const CaseResult& object, const PlottedError& error) {
  return plot_of(object.drags, object.name, error);
}

Plot violation_plot(const CaseResult& object) { return error_plot(object, errors_to_plot[0]); }

Plot distance_plot(const CaseResult& object) { return error_plot(object, errors_to_plot[3]); }

}  // namespace chainmail::report
