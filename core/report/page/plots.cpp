#include "report/page/plots.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "measure/violation.h"
#include "report/page/report.h"
#include "report/table/format.h"

namespace chainmail::report {
namespace {

constexpr double smallest_error = 1e-5;  // smaller ones come from Newton's method and from single precision
constexpr double smallest_time = 1e-9;   // ms; for a clock that measured 0
constexpr const char* front_colour = "#9a9a9a";
constexpr std::array errors_to_plot{&figures::violation_max, &figures::violation_rms, &figures::exact_distance_max,
                                    &figures::exact_distance_rms};

template <class Item>
void add_new(std::vector<Item>& items, const Item& item) {
  if (std::ranges::find(items, item) == items.end()) {
    items.push_back(item);
  }
}

/// Adds the explanations of what the marks of contestants mean.
void add_legend_notes(Plot& plot, const std::vector<Contestant>& all) {
  const bool has_plain = std::ranges::any_of(all, [](const Contestant& one) { return !one.is_relaxed(); });
  std::vector<int> sweeps;
  std::vector<std::string> notes;
  for (const Contestant& one : all) {
    if (one.sweeps > 0 && !one.calibrated) {
      add_new(sweeps, one.sweeps);
    }
    if (const std::string word = note(Contestant{.equilibrium = one.equilibrium, .open_regions = one.open_regions});
        !word.empty()) {
      add_new(notes, word);
    }
    if (one.calibrated) {
      add_new(notes, note(Contestant{.calibrated = one.calibrated}));
    }
  }
  if (has_plain) {
    plot.legend_notes.emplace_back("filled: without relaxation");
  }
  std::string numbers;
  for (const int one : sweeps) {
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(one);
  }
  if (!sweeps.empty()) {
    plot.legend_notes.push_back("hollow: " + numbers + " sweeps per move");
  }
  for (const std::string& one : notes) {
    plot.legend_notes.push_back(note_in_words(one));
  }
}

/// Returns true if this contestant is one of several that differ only in their iterations or sweeps.
bool is_on_curve(const Contestant& one, const std::vector<Standing>& all) {
  return std::ranges::any_of(all, [&](const Standing& other) {
    return other.contestant != one && curve_of(other.contestant) == curve_of(one);
  });
}

void add_mark(Plot& plot, PlotPanel& panel, const Standing& one, const std::string& what) {
  const Contestant& contestant = one.contestant;
  if (!one.is_complete) {
    return;  // a mean without some drags may be small because it leaves out the hard ones
  }
  if (!contestant.algorithm) {
    panel.level = contestant.solver.empty() ? std::optional(PlotLevel{one.error, "nothing moves"}) : panel.level;
    return;
  }
  if (one.ms) {
    panel.marks.push_back({one.ms->median, one.ms->lower_quartile, one.ms->upper_quartile, one.counted_error(),
                           series_of(plot, *contestant.algorithm), contestant.is_relaxed(), note(contestant),
                           label(contestant) + ": " + time_in_words(one.ms->median) + " per " + what +
                               ", relative error " + error_figure(one.error, one.change)});
  }
}

/// Adds a line through the marks of each curve. Only its last mark keeps its note.
void add_curves(Plot& plot, PlotPanel& panel, const std::vector<Standing>& all, const std::string& what) {
  std::vector<Contestant> curves;
  for (const Standing& one : all) {
    if (is_on_curve(one.contestant, all)) {
      add_new(curves, curve_of(one.contestant));
    } else {
      add_mark(plot, panel, one, what);
    }
  }
  for (const Contestant& curve : curves) {
    const std::size_t first = panel.marks.size();
    for (const Standing& one : all) {
      if (curve_of(one.contestant) == curve) {
        add_mark(plot, panel, one, what);
      }
    }
    const auto added = std::span(panel.marks).subspan(first);
    if (added.size() < 2) {
      continue;
    }
    PlotCurve& line = panel.curves.emplace_back(PlotCurve{added.front().series, {}});
    for (PlotMark& mark : added) {
      line.points.push_back({mark.x, mark.y});
      mark.note = &mark == &added.back() ? mark.note : "";
    }
  }
}

/// Adds a line through the contestants that no other one beats, in steps.
void add_front(PlotPanel& panel, std::size_t series, const std::vector<Standing>& all) {
  PlotCurve steps{series, {}};
  for (const Standing* one : front(all)) {
    if (!steps.points.empty()) {
      steps.points.push_back({one->ms->median, steps.points.back()[1]});
    }
    steps.points.push_back({one->ms->median, one->counted_error()});
  }
  if (steps.points.size() > 1) {
    panel.curves.push_back(std::move(steps));
  }
}

/// What a panel of a plot of speed against error shows.
struct SpeedPanel {
  std::string title;
  std::vector<Standing> shown;
};

Plot speed_plot(const std::string& title, const std::string& what, const std::vector<SpeedPanel>& panels) {
  Plot plot;
  plot.title = title;
  plot.x.title = plot.x.unit = "ms per " + what;
  plot.y.title = "relative error";
  plot.y.smallest = smallest_error;
  std::vector<Contestant> all;
  std::vector<const SpeedPanel*> drawn;
  for (const SpeedPanel& one : panels) {
    PlotPanel panel{one.title, {}, {}};
    add_curves(plot, panel, one.shown, what);
    if (!panel.marks.empty()) {
      plot.panels.push_back(std::move(panel));
      drawn.push_back(&one);
      std::ranges::transform(one.shown, std::back_inserter(all), &Standing::contestant);
    }
  }
  add_legend_notes(plot, all);
  // After those of the algorithms, which are found by their styles.
  plot.series.push_back({"front: none is faster and closer", 0, front_colour});
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    add_front(plot.panels[i], plot.series.size() - 1, drawn[i]->shown);
  }
  return plot;
}

/// Returns the objects that are no part of a series.
std::vector<std::size_t> single_objects(const Results& results) {
  std::vector<std::size_t> objects;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    if (results.objects[i].series.empty()) {
      objects.push_back(i);
    }
  }
  return objects;
}

}  // namespace

std::span<const Figure* const> plotted_errors() { return errors_to_plot; }

Plot error_plot(const Results& results, std::size_t object, const std::vector<std::size_t>& drags,
                const Figure& error) {
  const ObjectInfo& shown = results.objects[object];
  const std::string what = std::string(error.heading) + " " + std::string(error.group), unit(error.unit);
  Plot plot;
  plot.title = "Time against the " + what + " on " + shown.name;
  plot.x.title = plot.x.unit = "ms per move";
  plot.y.title = what + " (" + unit + ")";
  plot.y.unit = unit;
  std::vector<Contestant> all;
  for (const std::size_t drag : drags) {
    PlotPanel& panel = plot.panels.emplace_back();
    panel.title = shown.drags[drag].name;
    for (const Row* row : rows_of(results, object, [&](const Row& one) { return one.drag == drag; })) {
      const Value* ms = row->find(figures::ms_per_move);
      const auto value = (*row)[error];
      if (ms == nullptr || !value || !row->contestant.algorithm) {
        continue;
      }
      const TimeSpread spread = ms->spread.value_or(TimeSpread{ms->number, ms->number, ms->number});
      all.push_back(row->contestant);
      panel.marks.push_back({spread.median, spread.lower_quartile, spread.upper_quartile, *value,
                             series_of(plot, *row->contestant.algorithm), row->contestant.is_relaxed(),
                             note(row->contestant),
                             label(row->contestant) + ": " + time_in_words(spread.median) + " per move (quartiles " +
                                 time_in_words(spread.lower_quartile) + " and " + time_in_words(spread.upper_quartile) +
                                 "), " + what + " " + figure(*value) + " " + unit});
    }
  }
  add_legend_notes(plot, all);
  plot.legend_notes.emplace_back("bars: quartiles of the time");
  if (&error == &figures::violation_max) {
    plot.good_below = counts_as_violated;
    plot.good_label = "counts as valid";
  }
  return plot;
}

Plot speed_plot(const Results& results, const std::vector<std::size_t>& objects, const SpeedAgainstError& speed) {
  std::vector<SpeedPanel> panels;
  panels.reserve(objects.size());
  for (const std::size_t object : objects) {
    panels.push_back({results.objects[object].name, standings(results, object, speed)});
  }
  const std::string what(speed.what);
  return speed_plot("Time per " + what + " against error, means of the drags", what, panels);
}

Plot drags_plot(const Results& results, std::size_t object) {
  std::vector<SpeedPanel> panels;
  for (const DragInfo& drag : results.objects[object].drags) {
    if (std::ranges::find(panels, drag.name, &SpeedPanel::title) == panels.end()) {
      const SpeedAgainstError& speed = drag.has_cut ? speeds_against_error().back() : speeds_against_error().front();
      panels.push_back({drag.name, standings(results, object, speed, drag.name)});
    }
  }
  return speed_plot("Time against error on " + results.objects[object].name, "move", panels);
}

Plot growth_plot(const Results& results, const Figure& shown) {
  const std::string what = std::string(shown.heading) + (shown.unit == "ms" ? ", ms" : "");
  Plot plot;
  plot.title = "Elements against " + what;
  plot.x.title = "elements";
  plot.y.title = &shown == &figures::relative ? "relative error" : what;
  plot.y.smallest = &shown == &figures::relative ? smallest_error : plot.y.smallest;
  std::vector<Contestant> all;
  for (const std::string& series : series_in(results)) {
    PlotPanel& panel = plot.panels.emplace_back();
    panel.title = series;
    for (const Contestant& contestant : contestants_in(results, series)) {
      PlotCurve curve{0, {}};
      for (const auto& [object, found] : points_of(results, series, contestant)) {
        const auto value = found.row[shown];
        if (!value || !contestant.algorithm) {
          continue;
        }
        const auto elements = double(results.objects[object].elements);
        const double y = std::max(*value, smallest_time);
        curve.series = series_of(plot, *contestant.algorithm);
        curve.points.push_back({elements, y});
        panel.marks.push_back(
            {elements, elements, elements, y, curve.series, contestant.is_relaxed(), note(contestant),
             label(contestant) + ", " + thousands(results.objects[object].elements) + " elements: " + figure(*value)});
      }
      if (!curve.points.empty()) {
        panel.curves.push_back(std::move(curve));
        all.push_back(contestant);
      }
    }
  }
  add_legend_notes(plot, all);
  return plot;
}

Plot ramp_plot(const Results& results) {
  Plot plot = growth_plot(results, figures::p99_ms);
  plot.title = "Elements against time";
  plot.y.title = "99th percentile of the pass times (ms)";
  plot.legend_notes.clear();
  for (const auto& [name, value] : results.settings) {
    if (name == "budget") {
      plot.good_below = 1e3 * std::get<double>(value);
      plot.good_label = "real time";
    }
  }
  for (PlotPanel& panel : plot.panels) {
    for (PlotMark& mark : panel.marks) {
      mark.hollow = plot.good_below && mark.y > *plot.good_below;
    }
  }
  return plot;
}

std::vector<PlotFile> plots_of(const Results& results) {
  std::vector<PlotFile> plots;
  const auto add = [&](const std::string& name, Plot plot) {
    std::erase_if(plot.panels, [](const PlotPanel& panel) { return panel.marks.empty(); });
    if (!plot.panels.empty()) {
      plots.push_back({name + ".svg", std::move(plot)});
    }
  };
  if (results.kind == ReportKind::ramp) {
    add("ramp", ramp_plot(results));
    return plots;
  }
  const auto objects = single_objects(results);
  for (const SpeedAgainstError& speed : speeds_against_error()) {
    add(std::string(speed.file), speed_plot(results, objects, speed));
  }
  for (const std::size_t object : objects) {
    const std::string number = std::to_string(object + 1);
    if (results.kind == ReportKind::physics) {
      add("object-" + number, drags_plot(results, object));
    }
    if (results.kind == ReportKind::compare) {
      std::vector<std::size_t> drags(results.objects[object].drags.size());
      std::iota(drags.begin(), drags.end(), std::size_t{0});
      add("violation-" + number, error_plot(results, object, drags, figures::violation_max));
      add("distance-" + number, error_plot(results, object, drags, figures::exact_distance_rms));
    }
  }
  if (results.kind == ReportKind::physics) {
    add("growth-time", growth_plot(results, figures::later_ms));
    add("growth-prepare", growth_plot(results, figures::prepare_ms));
    add("growth-error", growth_plot(results, figures::relative));
  }
  return plots;
}

}  // namespace chainmail::report
