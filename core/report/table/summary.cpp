#include "report/table/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "report/table/format.h"

namespace chainmail::report {
namespace {

void mix(double& mean, double other, double weight) { mean += weight * (other - mean); }

void mix(TimeSpread& mean, const TimeSpread& other, double weight) {
  for (const auto member : {&TimeSpread::median, &TimeSpread::lower_quartile, &TimeSpread::upper_quartile,
                            &TimeSpread::min, &TimeSpread::max}) {
    mix(mean.*member, other.*member, weight);
  }
  mean.count = std::min(mean.count, other.count);
}

/// Joins the values of one figure.
Value joined(const Figure& figure, const std::vector<const Value*>& values) {
  Value all = *values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Value& other = *values[i];
    if (figure.over_drags == OverDrags::worst) {
      all = std::abs(other.number) > std::abs(all.number) ? other : all;
      continue;
    }
    const double weight = 1 / double(i + 1);
    mix(all.number, other.number, weight);
    if (all.spread && other.spread) {
      mix(*all.spread, *other.spread, weight);
    }
  }
  return all;
}

template <class Item>
void add_new(std::vector<Item>& items, const Item& item) {
  if (std::ranges::find(items, item) == items.end()) {
    items.push_back(item);
  }
}

bool has_single_moves(const ObjectInfo& object) {
  return std::ranges::any_of(object.drags, [](const DragInfo& drag) { return drag.moves == 1; });
}

constexpr std::array speeds{
    SpeedAgainstError{"later move", "overview", &figures::later_ms,
                      [](const DragInfo& drag, bool) { return !drag.has_cut && drag.moves != 1; }},
    SpeedAgainstError{"fresh grab", "fresh-grab", &figures::fresh_ms,
                      [](const DragInfo& drag, bool single) { return !drag.has_cut && (drag.moves == 1) == single; }},
    SpeedAgainstError{"move after a cut", "after-cut", &figures::after_cut_ms,
                      [](const DragInfo& drag, bool) { return drag.has_cut; }},
};

/// Returns contestants with their errors, and their times if there is a speed: `Linear FEM (0.02 ms, 0.085)`.
std::string listed(const std::vector<const Standing*>& all, bool with_times) {
  std::string text;
  for (const Standing* one : all) {
    text += (text.empty() ? "" : ", ") + label(one->contestant) + " (" +
            (with_times ? figure(one->ms->median) + " ms, " : "") + error_figure(one->error, one->change) + ")";
  }
  return text;
}

}  // namespace

Joined joined(std::span<const Row* const> rows) {
  Joined all;
  all.of = int(rows.size());
  for (const Row* row : rows) {
    all.row.contestant = row->contestant;
    all.row.object = row->object;
    all.drags += row->has_figures() ? 1 : 0;
    all.row.refusal = all.row.refusal.empty() ? row->refusal : all.row.refusal;
  }
  for (const Figure* figure : every_figure()) {
    std::vector<const Value*> values;
    for (const Row* row : rows) {
      if (const Value* value = row->find(*figure)) {
        values.push_back(value);
      }
    }
    if (!values.empty()) {
      all.row.figures.emplace_back(figure, joined(*figure, values));
    }
  }
  return all;
}

std::vector<const Row*> rows_of(const Results& results, std::size_t object,
                                const std::function<bool(const Row&)>& wanted) {
  std::vector<const Row*> rows;
  for (const Row& row : results.rows) {
    if (row.object == object && (!wanted || wanted(row))) {
      rows.push_back(&row);
    }
  }
  return rows;
}

std::vector<Contestant> contestants_in(const Results& results, std::size_t object) {
  std::vector<Contestant> all;
  for (const bool of_drags : {true, false}) {  // those of the whole object may be few
    for (const Row* row : rows_of(results, object, [&](const Row& one) { return one.drag.has_value() == of_drags; })) {
      add_new(all, row->contestant);
    }
  }
  return all;
}

Joined joined(const Results& results, std::size_t object, const Contestant& contestant, Drags which,
              const std::string& name) {
  return joined(rows_of(results, object, [&](const Row& row) {
    const DragInfo* drag = results.drag_of(row);
    return row.contestant == contestant && drag != nullptr && (name.empty() || drag->name == name) &&
           (which == Drags::all || drag->has_cut == (which == Drags::cut));
  }));
}

std::vector<const Figure*> figures_in(const Results& results, std::optional<std::size_t> object) {
  std::vector<const Figure*> present;
  for (const Row& row : results.rows) {
    if (!object || row.object == *object) {
      for (const auto& [figure, value] : row.figures) {
        add_new(present, figure);
      }
    }
  }
  std::vector<const Figure*> ordered;
  std::ranges::copy_if(every_figure(), std::back_inserter(ordered),
                       [&](const Figure* one) { return std::ranges::count(present, one) > 0; });
  return ordered;
}

std::span<const SpeedAgainstError> speeds_against_error() { return speeds; }

bool Standing::may_win() const {
  return is_complete && contestant.algorithm && *contestant.algorithm != Algorithm::neo_hookean;
}

std::vector<Standing> standings(const Results& results, std::size_t object, const SpeedAgainstError& speed,
                                const std::string& name) {
  const bool single = has_single_moves(results.objects[object]);
  std::vector<Standing> all;
  for (const Contestant& contestant : contestants_in(results, object)) {
    const Joined found = joined(rows_of(results, object, [&](const Row& row) {
      const DragInfo* drag = results.drag_of(row);
      return row.contestant == contestant && drag != nullptr && speed.counts(*drag, single) &&
             (name.empty() || drag->name == name);
    }));
    if (const auto error = found.row[figures::relative]) {
      Standing& one = all.emplace_back();
      one.contestant = contestant;
      one.error = *error;
      one.change = found.row[figures::reference_change];
      if (const Value* ms = found.row.find(*speed.ms)) {
        one.ms = ms->spread ? *ms->spread : TimeSpread{ms->number, ms->number, ms->number, ms->number, ms->number, 1};
      }
      one.is_complete = found.is_complete();
    }
  }
  return all;
}

std::vector<const Standing*> front(const std::vector<Standing>& all) {
  std::vector<const Standing*> candidates, winners;
  for (const Standing& one : all) {
    if (one.may_win() && one.ms) {
      candidates.push_back(&one);
    }
  }
  std::ranges::stable_sort(candidates, {},
                           [](const Standing* one) { return std::tuple(one->ms->median, one->counted_error()); });
  double least = std::numeric_limits<double>::infinity();
  for (const Standing* one : candidates) {
    const double error = one->counted_error();
    const bool ties = !winners.empty() && winners.back()->ms->median == one->ms->median && error == least;
    if (error < least || ties) {
      winners.push_back(one);
      least = error;
    }
  }
  return winners;
}

std::vector<const Standing*> closest(const std::vector<Standing>& all) {
  std::vector<const Standing*> best;
  for (const Standing& one : all) {
    if (one.may_win() && (best.empty() || one.counted_error() <= best.front()->counted_error())) {
      if (!best.empty() && one.counted_error() < best.front()->counted_error()) {
        best.clear();
      }
      best.push_back(&one);
    }
  }
  return best;
}

bool has_curves(const Results& results, std::size_t object) {
  return std::ranges::any_of(results.rows,
                             [&](const Row& row) { return row.object == object && row.contestant.limit > 0; });
}

std::optional<double> shortest_ms(const std::vector<Standing>& all, const Contestant& curve, double error) {
  std::optional<double> shortest;
  for (const Standing& one : all) {
    if (curve_of(one.contestant) == curve && one.ms && one.error <= error) {
      shortest = std::min(shortest.value_or(one.ms->median), one.ms->median);
    }
  }
  return shortest;
}

std::optional<double> least_error(const std::vector<Standing>& all, const Contestant& curve) {
  std::optional<double> least;
  for (const Standing& one : all) {
    if (curve_of(one.contestant) == curve) {
      least = std::min(least.value_or(one.error), one.error);
    }
  }
  return least;
}

std::vector<std::string> series_in(const Results& results) {
  std::vector<std::string> all;
  for (const ObjectInfo& object : results.objects) {
    if (!object.series.empty()) {
      add_new(all, object.series);
    }
  }
  return all;
}

std::vector<SeriesPoint> points_of(const Results& results, const std::string& series, const Contestant& contestant) {
  std::vector<SeriesPoint> points;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    if (results.objects[i].series == series) {
      if (Joined found = joined(rows_of(results, i, [&](const Row& row) { return row.contestant == contestant; }));
          found.of > 0) {
        points.push_back({i, std::move(found)});
      }
    }
  }
  return points;
}

std::vector<Contestant> contestants_in(const Results& results, const std::string& series) {
  std::vector<Contestant> all;
  for (const Row& row : results.rows) {
    if (results.object_of(row).series == series) {
      add_new(all, row.contestant);
    }
  }
  return all;
}

std::optional<Growth> growth_of(const std::vector<SeriesPoint>& points, const Results& results, const Figure& ms) {
  std::vector<SizedTime> times;
  for (const auto& [object, found] : points) {
    if (const auto time = found.row[ms]) {
      times.push_back({double(results.objects[object].elements), *time});
    }
  }
  return growth_of(times, growth_from);
}

std::optional<double> order_of(const std::vector<SeriesPoint>& points) {
  if (points.size() < 2) {
    return std::nullopt;
  }
  const auto coarse = points[points.size() - 2].figures.row[figures::relative];
  const auto fine = points.back().figures.row[figures::relative];
  return coarse && fine && *fine > 0 ? std::optional(std::log2(*coarse / *fine)) : std::nullopt;
}

std::vector<std::string> findings(const Results& results) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    const ObjectInfo& object = results.objects[i];
    if (!object.series.empty()) {
      continue;
    }
    for (const SpeedAgainstError& speed : speeds) {
      const auto all = standings(results, i, speed);
      if (&speed == &speeds.front() && !has_curves(results, i)) {
        if (const auto best = closest(all); !best.empty()) {
          sentences.push_back(object.name + ": " + listed(best, false) +
                              (best.size() == 1 ? " is closest" : " are closest"));
        }
      }
      if (const auto winners = front(all); !winners.empty()) {
        sentences.push_back(object.name + ", " + std::string(speed.what) + ": on the front are " +
                            listed(winners, true));
      }
    }
  }
  return sentences;
}

}  // namespace chainmail::report
