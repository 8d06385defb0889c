#include <algorithm>
#include <iterator>

#include "report/format.h"
#include "report/physics_report.h"

namespace chainmail::report {
namespace {

// Below this the truth is found again: what Newton's method and single precision leave.
constexpr double as_good_as_true = 1e-5;
constexpr double smallest_time = 1e-9;  // ms; a clock that saw nothing

std::string in_words(const PhysicsEntry& entry) {
  const PhysicsMeasurement& measured = *entry.measurement;
  return label(entry.contestant) + ": " + figure(measured.ms_per_move.median) + " ms a move, RMS error " +
         percent(measured.error.rms) + " of the hand's displacement, max " + percent(measured.error.max);
}

/// Marks, and for each algorithm with sweeps a line through them.
PlotPanel panel_of(Plot& plot, const PhysicsDrag& drag) {
  PlotPanel panel{drag.no_truth.empty() ? drag.name : drag.name + ": no truth", {}, {}};
  for (const PhysicsEntry& entry : drag.entries) {
    if (!entry.measurement) {
      continue;
    }
    const TimeSpread& ms = entry.measurement->ms_per_move;
    const std::size_t series = series_of(plot, entry.contestant.algorithm);
    const int sweeps = entry.contestant.sweeps;
    panel.marks.push_back({ms.median, ms.lower_quartile, ms.upper_quartile, entry.measurement->error.rms, series,
                           sweeps > 0, "", in_words(entry)});
    if (!elastic_method(entry.contestant.algorithm)) {
      if (panel.curves.empty() || panel.curves.back().series != series) {
        panel.curves.push_back({series, {}});
      }
      panel.curves.back().points.push_back({ms.median, entry.measurement->error.rms});
    }
  }
  return panel;
}

/// The mean of a contestant's drags; nothing where it is missing from one.
PhysicsEntry mean_of(const std::vector<PhysicsDrag>& drags, std::size_t entry) {
  PhysicsEntry mean = drags.front().entries[entry];
  for (std::size_t i = 1; i < drags.size(); ++i) {
    const auto& other = drags[i].entries[entry].measurement;
    if (!mean.measurement || !other) {
      mean.measurement.reset();
      return mean;
    }
    const double old = double(i) / double(i + 1);
    const auto mix = [old](double& to, double with) { to = old * to + (1 - old) * with; };
    auto& [ms, prepare, error] = *mean.measurement;
    mix(ms.median, other->ms_per_move.median);
    mix(ms.lower_quartile, other->ms_per_move.lower_quartile);
    mix(ms.upper_quartile, other->ms_per_move.upper_quartile);
    mix(error.rms, other->error.rms);
    error.max = std::max(error.max, other->error.max);
  }
  return mean;
}

std::string sweeps_in_words(const PhysicsObject& object) {
  std::string text;
  std::vector<int> seen;
  for (const PhysicsDrag& drag : object.drags) {
    for (const PhysicsEntry& entry : drag.entries) {
      const int sweeps = entry.contestant.sweeps;
      if (sweeps > 0 && std::ranges::find(seen, sweeps) == seen.end()) {
        seen.push_back(sweeps);
        text += (text.empty() ? "" : ", ") + std::to_string(sweeps);
      }
    }
  }
  return text;
}

/// A panel for each kind of object, a curve for each contestant; hollow marks are those with sweeps.
Plot growth_plot(const std::vector<PhysicsGrowth>& growths, const std::string& what,
                 std::optional<double> (*value_of)(const GrowthPoint&)) {
  Plot plot;
  plot.title = "Elements against " + what;
  plot.x_label = "elements";
  plot.y_label = what;
  plot.legend_notes = {"filled: without relaxation", "hollow: 10 sweeps a move"};
  for (const PhysicsGrowth& growth : growths) {
    PlotPanel& panel = plot.panels.emplace_back();
    panel.title = growth.name;
    for (const GrowthSeries& series : growth.series) {
      if (std::ranges::none_of(series.points, [&](const GrowthPoint& point) { return value_of(point).has_value(); })) {
        continue;
      }
      PlotCurve curve{series_of(plot, series.contestant.algorithm), {}};
      for (const GrowthPoint& point : series.points) {
        if (const auto value = value_of(point)) {
          const auto elements = double(point.elements);
          curve.points.push_back({elements, *value});
          panel.marks.push_back(
              {elements, elements, elements, *value, curve.series, series.contestant.sweeps > 0, "",
               label(series.contestant) + ", " + std::to_string(point.elements) + " elements: " + figure(*value)});
        }
      }
      panel.curves.push_back(std::move(curve));
    }
  }
  return plot;
}

Plot empty_plot(const std::string& title, const PhysicsObject& object) {
  Plot plot;
  plot.title = title;
  plot.x_label = "ms a move";
  plot.y_label = "RMS error / hand’s displacement";
  plot.smallest_y = as_good_as_true;
  plot.legend_notes = {"filled: without relaxation"};
  if (const std::string sweeps = sweeps_in_words(object); !sweeps.empty()) {
    plot.legend_notes.push_back("line: " + sweeps + " sweeps a move");
  }
  plot.legend_notes.emplace_back("0: neo-Hookean FEM, the truth");
  return plot;
}

}  // namespace

Plot physics_plot(const PhysicsObject& object) {
  Plot plot = empty_plot("Time against error on " + object.name, object);
  for (const PhysicsDrag& drag : object.drags) {
    plot.panels.push_back(panel_of(plot, drag));
  }
  return plot;
}

Plot physics_overview(const PhysicsReport& report) {
  Plot plot = empty_plot("Time against error, means of the drags", report.objects.front());
  for (const PhysicsObject& object : report.objects) {
    std::vector<PhysicsDrag> drags;
    std::ranges::copy_if(object.drags, std::back_inserter(drags),
                         [](const PhysicsDrag& drag) { return drag.no_truth.empty(); });
    PhysicsDrag mean{object.name, "", 0, 0, {}, drags.empty() ? "no drag has one" : ""};
    for (std::size_t i = 0; !drags.empty() && i < drags.front().entries.size(); ++i) {
      mean.entries.push_back(mean_of(drags, i));
    }
    plot.panels.push_back(panel_of(plot, mean));
  }
  return plot;
}

Plot growth_time_plot(const std::vector<PhysicsGrowth>& growths) {
  return growth_plot(growths, "ms a move", [](const GrowthPoint& point) {
    return std::optional(std::max(point.ms_per_move, smallest_time));
  });
}

Plot growth_prepare_plot(const std::vector<PhysicsGrowth>& growths) {
  return growth_plot(growths, "ms to prepare", [](const GrowthPoint& point) {
    return point.prepare_ms > 0 ? std::optional(point.prepare_ms) : std::nullopt;
  });
}

Plot growth_error_plot(const std::vector<PhysicsGrowth>& growths) {
  Plot plot = growth_plot(growths, "RMS error / hand’s displacement", [](const GrowthPoint& point) {
    return point.error ? std::optional(point.error->rms) : std::nullopt;
  });
  plot.smallest_y = as_good_as_true;
  return plot;
}

}  // namespace chainmail::report
