#include "report/page/physics_table.h"

#include <algorithm>

#include "report/page/format.h"
#include "report/page/physics_figures.h"

namespace chainmail::report {
namespace {

using Drags = std::vector<const PhysicsDrag*>;

void mix(double& mean, double other, double weight) { mean += weight * (other - mean); }

void mix(TimeSpread& mean, const TimeSpread& other, double weight) {
  for (const auto member : {&TimeSpread::median, &TimeSpread::lower_quartile, &TimeSpread::upper_quartile,
                            &TimeSpread::min, &TimeSpread::max}) {
    mix(mean.*member, other.*member, weight);
  }
  mean.count = std::min(mean.count, other.count);
}

void mix(PhysicalError& mean, const PhysicalError& other, double weight) {
  for (const auto member : {&PhysicalError::relative, &PhysicalError::rms, &PhysicalError::moving_rms}) {
    mix(mean.*member, other.*member, weight);
  }
  mean.max = std::max(mean.max, other.max);
  mean.moving_max = std::max(mean.moving_max, other.moving_max);
}

PhysicsEntry mean_of(const Drags& drags, std::size_t entry) {
  PhysicsEntry mean{drags.front()->entries[entry].contestant, std::nullopt, {}};
  int count = 0;
  for (const PhysicsDrag* drag : drags) {
    const PhysicsEntry& other = drag->entries[entry];
    if (!other.measurement) {
      mean.refusal = mean.refusal.empty() ? other.refusal : mean.refusal;
      ++mean.left_out;
      continue;
    }
    if (count++ == 0) {
      mean.measurement = other.measurement;
      continue;
    }
    const double weight = 1 / double(count);
    PhysicsMeasurement& to = *mean.measurement;
    const PhysicsMeasurement& from = *other.measurement;
    mix(to.ms_per_move, from.ms_per_move, weight);
    mix(to.first_move, from.first_move, weight);
    mix(to.move_after_cut, from.move_after_cut, weight);
    mix(to.prepare.factorize, from.prepare.factorize, weight);
    mix(to.prepare.grab, from.prepare.grab, weight);
    mix(to.error, from.error, weight);
    take_worst(to.shape, from.shape);
    to.residual = std::max(to.residual, from.residual);
    to.binds = std::max(to.binds, from.binds);
  }
  return mean;
}

PhysicsDrag mean_of(const std::string& name, const Drags& drags) {
  PhysicsDrag mean;
  mean.name = name;
  if (drags.empty()) {
    mean.no_reference = "no drag has a reference solution";
    return mean;
  }
  mean.has_cut = drags.front()->has_cut;
  for (std::size_t i = 0; i < drags.front()->entries.size(); ++i) {
    mean.entries.push_back(mean_of(drags, i));
  }
  return mean;
}

}  // namespace

std::vector<PhysicsDrag> means_by_name(const PhysicsObject& object) {
  std::vector<std::string> names;
  for (const PhysicsDrag& drag : object.drags) {
    if (std::ranges::find(names, drag.name) == names.end()) {
      names.push_back(drag.name);
    }
  }
  std::vector<PhysicsDrag> means;
  for (const std::string& name : names) {
    Drags drags;
    for (const PhysicsDrag& drag : object.drags) {
      if (drag.name == name && drag.no_reference.empty()) {
        drags.push_back(&drag);
      }
    }
    means.push_back(mean_of(name, drags));
  }
  return means;
}

PhysicsDrag mean_of_drags(const PhysicsObject& object) {
  Drags drags;
  for (const PhysicsDrag& drag : object.drags) {
    if (!drag.has_cut && drag.no_reference.empty()) {
      drags.push_back(&drag);
    }
  }
  return mean_of(object.name, drags);
}

namespace {

// Differences below this come from rounding.
constexpr double rounding_of_turns = 1e-6;

/// True if a row repeats the refusal of the row before: an algorithm that cannot take part has one row for all sweeps.
template <class One>
bool repeats(const One& one, const One& before, const std::string& refusal, const std::string& refusal_before) {
  return !refusal.empty() && refusal == refusal_before && one.contestant.algorithm == before.contestant.algorithm;
}

/// The means of the drags of an object, which its table shows.
struct Means {
  std::vector<PhysicsDrag> by_name;  // drags that have a reference solution
  PhysicsDrag all;                   // without the cut
  const PhysicsDrag* cut = nullptr;  // one of by_name; none if nothing is cut

  explicit Means(const PhysicsObject& object) : by_name(means_by_name(object)), all(mean_of_drags(object)) {
    std::erase_if(by_name, [](const PhysicsDrag& drag) { return !drag.no_reference.empty(); });
    const auto found = std::ranges::find(by_name, true, &PhysicsDrag::has_cut);
    cut = found == by_name.end() ? nullptr : &*found;
  }
};

/// A column of the table of an object.
struct MeanColumn {
  FigureTable::Column head;
  const Figure<PhysicsRow>* figure;
  const PhysicsDrag* mean;  // that it shows; null if nothing is cut
  enum class Group { relative_errors, times, no_room_on_a_terminal } group;
};

std::vector<MeanColumn> columns_of(const Means& means, bool for_text) {
  std::vector<MeanColumn> columns;
  for (const Figure<PhysicsRow>& one : physics_figures()) {
    const bool has_times = one.group.ends_with(time_unit);
    using enum MeanColumn::Group;
    const auto place = one.group == relative_error ? relative_errors : has_times ? times : no_room_on_a_terminal;
    if (one.group.empty() || (for_text && place == no_room_on_a_terminal)) {
      continue;
    }
    std::string group(one.group);
    if (has_times && !for_text) {
      group.replace(group.size() - time_unit.size(), time_unit.size(), ": median (quartiles, repetitions), ms");
    }
    if (!one.heading.empty()) {
      const PhysicsDrag* mean = one.heading == after_cut ? means.cut : &means.all;
      columns.push_back({{group, std::string(one.heading)}, &one, mean, place});
      continue;
    }
    for (const PhysicsDrag& drag : means.by_name) {
      if (!drag.has_cut || place == relative_errors) {
        columns.push_back({{group, drag.has_cut ? "cut" : drag.name}, &one, &drag, place});
      }
    }
  }
  std::ranges::stable_sort(columns, {}, &MeanColumn::group);
  return columns;
}

/// Formats times (ms); empty if they were not measured because nothing is prepared or cut.
std::string time_cell(const FigureValue& value, bool for_text) {
  const auto* ms = std::get_if<TimeSpread>(&value);
  if (ms == nullptr || for_text) {
    return ms != nullptr ? figure(ms->median) : for_text ? "-" : "";
  }
  return figure(ms->median) + " (" + figure(ms->lower_quartile) + "–" + figure(ms->upper_quartile) + ", " +
         std::to_string(ms->count) + ")";
}

std::string cell_of(const MeanColumn& column, std::size_t entry, bool for_text) {
  const PhysicsEntry* mean = column.mean == nullptr ? nullptr : &column.mean->entries[entry];
  if (column.group == MeanColumn::Group::times) {
    return time_cell(column.figure->value({.entry = mean}), for_text);
  }
  const std::string cell = mean->measurement ? cell_of(*column.figure, {.entry = mean}) : "n/a";
  const bool lacks_some = mean->measurement && mean->left_out > 0 && column.figure->heading.empty();
  return lacks_some ? cell + " (without " + std::to_string(mean->left_out) + ")" : cell;
}

/// Returns a row under columns, of which an object may lack some.
FigureTable::Row row_of(const Means& means, std::size_t entry, const std::vector<FigureTable::Column>& heads,
                        bool for_text) {
  FigureTable::Row row{label(means.all.entries[entry].contestant), {}, {}};
  if (std::ranges::none_of(means.by_name,
                           [&](const PhysicsDrag& drag) { return drag.entries[entry].measurement.has_value(); })) {
    row.refusal = means.all.entries[entry].refusal;
    return row;
  }
  const auto columns = columns_of(means, for_text);
  for (const FigureTable::Column& head : heads) {
    const auto found = std::ranges::find(columns, head, &MeanColumn::head);
    row.cells.push_back(found == columns.end() ? "-" : cell_of(*found, entry, for_text));
  }
  return row;
}

std::vector<FigureTable::Column> heads_of(const Means& means, bool for_text) {
  std::vector<FigureTable::Column> heads;
  std::ranges::transform(columns_of(means, for_text), std::back_inserter(heads), &MeanColumn::head);
  return heads;
}

std::string about(const Calibration& calibration) {
  const std::string who = label(Contestant{calibration.algorithm, 0, calibration.equilibrium}) + " calibrated";
  return !calibration.refusal.empty()
             ? who + ": left out, " + calibration.refusal
             : who + " in " + figure(calibration.seconds) + " s on " + std::to_string(calibration.drags) +
                   " drags of other elements: " + region_in_words(calibration.softness) + ", " +
                   (calibration.equilibrium ? energy_in_words(calibration.softness)
                                            : std::to_string(calibration.sweeps) + " sweeps");
}

/// Returns the description of a drag without its handle.
std::string what_happens(const PhysicsDrag& drag) {
  const std::string handle = "element " + std::to_string(drag.handle) + ", ";
  return drag.description.starts_with(handle) ? drag.description.substr(handle.size()) : drag.description;
}

/// Returns the levels of the references on refined cells; empty if there are none.
std::string about_refined(const PhysicsObject& object) {
  std::vector<Convergence> all;
  for (const PhysicsDrag& drag : object.drags) {
    if (drag.refined) {
      all.push_back(*drag.refined);
    }
  }
  return all.empty() ? "" : "; " + convergence_in_words(all);
}

std::string about(const PhysicsObject& object) {
  std::vector<ElementId> handles;
  std::vector<std::string> names;
  std::string drags, left_out;
  for (const PhysicsDrag& drag : object.drags) {
    if (std::ranges::find(handles, drag.handle) == handles.end()) {
      handles.push_back(drag.handle);
    }
    if (std::ranges::find(names, drag.name) == names.end()) {
      names.push_back(drag.name);
      drags += "; " + drag.name + ": " + (drag.has_cut ? drag.description : what_happens(drag));
    }
    if (!drag.no_reference.empty()) {
      left_out += "; left out: " + drag.name + " of element " + std::to_string(drag.handle) + ", " + drag.no_reference;
    }
  }
  std::string text = object.description + "; " + thousands(object.elements) + " elements, " + thousands(object.links) +
                     " links, " + std::to_string(object.pins) + " pinned; handles: ";
  for (const ElementId handle : handles) {
    text += (handle == handles.front() ? "" : ", ") + std::to_string(handle);
  }
  text += drags + left_out + about_refined(object);
  if (object.law.kind != StrainLaw::Kind::neo_hookean) {
    text += "; reference: " + label(object.law);
  }
  for (const Calibration& calibration : object.calibrations) {
    text += "; " + about(calibration);
  }
  return text;
}

constexpr const char* how_to_read_text =
    "Relative error: RMS of the error over RMS of the reference's displacements, over all elements; means over the\n"
    "handles of an object. An object that does not move has about 1: a larger error is no better than no method.\n"
    "The reference is neo-Hookean FEM, converged on the same cells as linear FEM, not under "
    "refinement of the mesh;\n"
    "BEM works on its own surface mesh. Times are medians in ms, means over the drags: the first move of a drag, a\n"
    "later move, and the move after a cut with all repeated preparation. Preparation: factorizing is done once for an\n"
    "object, its pins and its cuts; grabbing is done once for each handle. A contestant that iterates makes the least\n"
    "iterations per move with which its answer is within 1 % of its own limit.\n";

FigureTable::Row row_of(const GrowthSeries& series) {
  FigureTable::Row row;
  row.label = label(series.contestant);
  if (series.points.empty()) {
    row.refusal = series.end;
    return row;
  }
  const GrowthPoint& last = series.points.back();
  std::vector<double> errors;
  for (const GrowthPoint& point : series.points) {
    if (point.error) {
      errors.push_back(point.error->relative);
    }
  }
  row.cells = {std::to_string(last.elements),
               figure(last.ms_per_move),
               figure(last.prepare_ms),
               series.growth ? figure(series.growth->power) : "n/a",
               errors.empty() ? "n/a" : figure(errors.front()),
               errors.empty() ? "n/a" : figure(errors.back()),
               series.end};
  return row;
}

}  // namespace

FigureTable physics_table(const PhysicsObject& object, bool for_text) {
  const Means means(object);
  FigureTable table{object.name, about(object), "detail", "contestant", heads_of(means, for_text), {}};
  const auto& entries = means.all.entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || !repeats(entries[i], entries[i - 1], entries[i].refusal, entries[i - 1].refusal)) {
      table.rows.push_back(row_of(means, i, table.columns, for_text));
    }
  }
  return table;
}

FigureTable symmetry_table(const PhysicsReport& report) {
  FigureTable table{"Turned object",
                    "difference of the answer after turning back, at the end of one move",
                    "detail",
                    "object, contestant",
                    {},
                    {}};
  for (const char* group : {"largest (mean rest lengths)", "relative (ratio)"}) {
    for (const double degrees : symmetry_angles) {
      table.columns.push_back({group, "turned by " + figure(degrees) + "°"});
    }
  }
  for (const PhysicsObject& object : report.objects) {
    for (const Symmetry& one : object.symmetry) {
      FigureTable::Row& row = table.rows.emplace_back();
      row.label = object.name + ": " + label(one.contestant);
      row.refusal = one.refusal;
      for (const auto member : {&TurnDifference::max, &TurnDifference::relative}) {
        for (const TurnDifference& turn : one.turns) {
          row.cells.push_back(turn.*member < rounding_of_turns ? "0" : figure(turn.*member));
        }
      }
    }
  }
  return table;
}

FigureTable physics_summary(const PhysicsReport& report) {
  FigureTable table{"Summary", "contestants without sweeps, at equilibrium, and calibrated ones",
                    "detail",  "object, contestant",
                    {},        {}};
  for (const PhysicsObject& object : report.objects) {
    if (auto heads = heads_of(Means(object), true); heads.size() > table.columns.size()) {
      table.columns = std::move(heads);
    }
  }
  for (const PhysicsObject& object : report.objects) {
    const Means means(object);
    for (std::size_t i = 0; i < means.all.entries.size(); ++i) {
      const PhysicsContestant& contestant = means.all.entries[i].contestant;
      FigureTable::Row row = row_of(means, i, table.columns, true);
      if ((contestant.sweeps == 0 || contestant.calibrated) && row.refusal.empty()) {
        row.label = object.name + ": " + row.label;
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

FigureTable growth_table(const PhysicsGrowth& growth) {
  FigureTable table{growth.name,
                    growth.description,
                    "detail",
                    "contestant",
                    {{"the largest object", "elements"},
                     {"the largest object", "ms per move"},
                     {"the largest object", "prepare (ms)"},
                     {"growth of time", "exponent"},
                     {"relative error (ratio)", "first size"},
                     {"relative error (ratio)", "last known"},
                     {"why not larger", ""}},
                    {}};
  for (std::size_t i = 0; i < growth.series.size(); ++i) {
    const GrowthSeries& series = growth.series[i];
    if (!series.points.empty() || i == 0 ||
        !repeats(series, growth.series[i - 1], series.end, growth.series[i - 1].end)) {
      table.rows.push_back(row_of(series));
    }
  }
  return table;
}

bool has_refined(const PhysicsReport& report) {
  return std::ranges::any_of(report.objects, [](const PhysicsObject& object) {
    return std::ranges::any_of(object.drags, [](const PhysicsDrag& drag) { return drag.refined.has_value(); });
  });
}

void write_text(std::ostream& out, const PhysicsReport& report) {
  out << how_to_read_text;
  if (has_refined(report)) {
    out << how_to_read_refined << '\n';
  }
  if (report.objects.size() > 1) {
    write_text(out, physics_summary(report));
  }
  for (const PhysicsObject& object : report.objects) {
    write_text(out, physics_table(object, true));
  }
  if (const FigureTable turned = symmetry_table(report); !turned.rows.empty()) {
    write_text(out, turned);
  }
  for (const PhysicsGrowth& growth : report.growths) {
    out << (&growth == &report.growths.front() ? "\nGrowing objects\n" : "");
    write_text(out, growth_table(growth));
  }
}

}  // namespace chainmail::report
