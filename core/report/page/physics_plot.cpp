#include "report/page/physics_plot.h"

#include <algorithm>

#include "report/page/format.h"
#include "report/page/physics_table.h"

namespace chainmail::report {
namespace {

// Smaller errors come from Newton's method and from single precision.
constexpr double smallest_relative_error = 1e-5;
constexpr double smallest_time = 1e-9;  // ms; for a clock that measured 0

/// Returns the time to plot: the time of a later move, or of the move after the cut if the drag has one.
const TimeSpread& time_of(const PhysicsDrag& drag, const PhysicsMeasurement& measured) {
  return drag.has_cut ? measured.move_after_cut : measured.ms_per_move;
}

std::string in_words(const PhysicsDrag& drag, const PhysicsEntry& entry) {
  const PhysicsMeasurement& measured = *entry.measurement;
  return label(entry.contestant) + ": " + figure(time_of(drag, measured).median) + " ms per move, relative error " +
         figure(measured.error.relative) + ", RMS error " + percent(measured.error.rms) +
         " of the handle's displacement, max " + percent(measured.error.max);
}

/// Returns the index of a contestant's series. Its label names the cells that the method works on.
std::size_t series_of(Plot& plot, const PhysicsContestant& contestant) {
  const std::size_t series = series_of(plot, *contestant.algorithm);
  plot.series[series].label = label(PhysicsContestant{contestant.algorithm, 0});
  return series;
}

/// Returns a panel with a mark for each contestant, and a line through the marks of each algorithm with sweeps.
/// Contestants that are calibrated or at equilibrium are not on a line.
PlotPanel panel_of(Plot& plot, const PhysicsDrag& drag, const std::string& title) {
  PlotPanel panel{drag.no_reference.empty() ? title : title + ": no reference", {}, {}};
  for (const PhysicsEntry& entry : drag.entries) {
    if (!entry.measurement || entry.left_out > 0) {
      continue;  // a mean without some drags may be small because it leaves out the hard ones
    }
    const double error = entry.measurement->error.relative;
    if (!entry.contestant.algorithm) {
      panel.level = PlotLevel{error, "nothing moves"};
      continue;
    }
    const TimeSpread& ms = time_of(drag, *entry.measurement);
    const std::size_t series = series_of(plot, entry.contestant);
    const bool calibrated = entry.contestant.calibrated.has_value(), equilibrium = entry.contestant.equilibrium;
    panel.marks.push_back({ms.median, ms.lower_quartile, ms.upper_quartile, error, series,
                           entry.contestant.sweeps > 0 || equilibrium,
                           calibrated                      ? "cal."
                           : entry.contestant.open_regions ? material_mark
                           : equilibrium                   ? equilibrium_mark
                                                           : "",
                           in_words(drag, entry)});
    if (!prepares(entry.contestant) && !calibrated && !equilibrium) {
      if (panel.curves.empty() || panel.curves.back().series != series) {
        panel.curves.push_back({series, {}});
      }
      panel.curves.back().points.push_back({ms.median, error});
    }
  }
  return panel;
}

std::string sweeps_in_words(const PhysicsObject& object) {
  std::string text;
  std::vector<int> seen;
  for (const PhysicsDrag& drag : object.drags) {
    for (const PhysicsEntry& entry : drag.entries) {
      const int sweeps = entry.contestant.sweeps;
      if (sweeps > 0 && !entry.contestant.calibrated && std::ranges::find(seen, sweeps) == seen.end()) {
        seen.push_back(sweeps);
        text += (text.empty() ? "" : ", ") + std::to_string(sweeps);
      }
    }
  }
  return text;
}

bool has_equilibrium(const PhysicsObject& object) {
  return std::ranges::any_of(object.drags, [](const PhysicsDrag& drag) {
    return std::ranges::any_of(drag.entries, [](const PhysicsEntry& entry) { return entry.contestant.equilibrium; });
  });
}

/// Returns a plot with one panel per kind of object and one curve per contestant. Contestants with relaxation have
/// hollow marks.
Plot growth_plot(const std::vector<PhysicsGrowth>& growths, const std::string& what,
                 std::optional<double> (*value_of)(const GrowthPoint&)) {
  Plot plot;
  plot.title = "Elements against " + what;
  plot.x.title = "elements";
  plot.y.title = what;
  plot.legend_notes = {"filled: without relaxation", "hollow: 10 sweeps per move"};
  const auto is_at_equilibrium = [](const GrowthSeries& series) { return series.contestant.equilibrium; };
  if (!growths.empty() && std::ranges::any_of(growths.front().series, is_at_equilibrium)) {
    plot.legend_notes.emplace_back(equilibrium_note);
  }
  for (const PhysicsGrowth& growth : growths) {
    PlotPanel& panel = plot.panels.emplace_back();
    panel.title = growth.name;
    for (const GrowthSeries& series : growth.series) {
      if (std::ranges::none_of(series.points, [&](const GrowthPoint& point) { return value_of(point).has_value(); })) {
        continue;
      }
      PlotCurve curve{series_of(plot, series.contestant), {}};
      for (const GrowthPoint& point : series.points) {
        if (const auto value = value_of(point)) {
          const auto elements = double(point.elements);
          curve.points.push_back({elements, *value});
          panel.marks.push_back(
              {elements, elements, elements, *value, curve.series,
               series.contestant.sweeps > 0 || series.contestant.equilibrium,
               series.contestant.equilibrium ? equilibrium_mark : "",
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
  plot.x.title = "ms per move";
  plot.y.title = "relative error";
  plot.y.smallest = smallest_relative_error;
  plot.legend_notes = {"filled: without relaxation"};
  if (const std::string sweeps = sweeps_in_words(object); !sweeps.empty()) {
    plot.legend_notes.push_back("line: " + sweeps + " sweeps per move");
  }
  if (has_equilibrium(object)) {
    plot.legend_notes.emplace_back(equilibrium_note);
    plot.legend_notes.emplace_back(material_note);
  }
  plot.legend_notes.emplace_back("cal.: calibrated on other drags");
  plot.legend_notes.emplace_back("0: the reference, neo-Hookean FEM");
  return plot;
}

}  // namespace

Plot physics_plot(const PhysicsObject& object) {
  Plot plot = empty_plot("Time against error on " + object.name, object);
  for (const PhysicsDrag& drag : means_by_name(object)) {
    plot.panels.push_back(panel_of(plot, drag, drag.name));
  }
  return plot;
}

Plot physics_overview(const PhysicsReport& report) {
  Plot plot = empty_plot("Time against error, means of the drags", report.objects.front());
  for (const PhysicsObject& object : report.objects) {
    plot.panels.push_back(panel_of(plot, mean_of_drags(object), object.name));
  }
  return plot;
}

Plot growth_time_plot(const std::vector<PhysicsGrowth>& growths) {
  return growth_plot(growths, "ms per move", [](const GrowthPoint& point) {
    return std::optional(std::max(point.ms_per_move, smallest_time));
  });
}

Plot growth_prepare_plot(const std::vector<PhysicsGrowth>& growths) {
  return growth_plot(growths, "ms to prepare", [](const GrowthPoint& point) {
    return point.prepare_ms > 0 ? std::optional(point.prepare_ms) : std::nullopt;
  });
}

Plot growth_error_plot(const std::vector<PhysicsGrowth>& growths) {
  Plot plot = growth_plot(growths, "relative error", [](const GrowthPoint& point) {
    return point.error ? std::optional(point.error->relative) : std::nullopt;
  });
  plot.y.smallest = smallest_relative_error;
  return plot;
}

std::string object_plot(std::size_t number) { return "object-" + std::to_string(number) + ".svg"; }

std::vector<PlotFile> plots_of(const PhysicsReport& report) {
  std::vector<PlotFile> plots;
  if (report.objects.size() > 1) {
    plots.push_back({physics_plots[0], physics_overview(report)});
  }
  for (std::size_t i = 0; i < report.objects.size(); ++i) {
    plots.push_back({object_plot(i + 1), physics_plot(report.objects[i])});
  }
  if (!report.growths.empty()) {
    plots.push_back({physics_plots[1], growth_time_plot(report.growths)});
    plots.push_back({physics_plots[2], growth_prepare_plot(report.growths)});
    plots.push_back({physics_plots[3], growth_error_plot(report.growths)});
  }
  return plots;
}

}  // namespace chainmail::report
