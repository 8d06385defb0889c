#include "report/run/suite.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/error.h"
#include "report/run/clocks.h"
#include "report/run/contest.h"
#include "report/run/drag_reference.h"
#include "report/run/preparing.h"
#include "report/run/suite_experiments.h"
#include "report/run/time_to_error.h"

namespace chainmail::report {
namespace {

constexpr double turned_by = 45;  // degrees: ChainMail's boxes follow the axes, and differ most half way between them

/// An experiment that is running.
struct Running {
  const SuiteExperiment& experiment;
  PhysicsOptions options;
  Progress progress;
  SuiteResult result;
};

PhysicsOptions options_of(const SuiteOptions& suite, const SuiteExperiment& experiment) {
  PhysicsOptions options;
  options.contest.algorithms = suite.algorithms;
  options.contest.sweeps = {0};
  options.contest.equilibrium = true;
  options.contest.repetitions = suite.repetitions;
  options.contest.seconds = suite.seconds;
  options.refine = reference_of(experiment);
  options.calibrate = suite.calibrate;
  if (options.contest.algorithms.empty()) {
    for (const AlgorithmInfo& one : every_algorithm()) {
      options.contest.algorithms.push_back(one.algorithm);
    }
  }
  return options;
}

std::optional<double> median_of(const TimeSpread& ms) {
  return ms.count == 0 ? std::nullopt : std::optional(ms.median);
}

SuiteRow row_of(const RecordedMoves& moves, const PhysicsEntry& entry) {
  SuiteRow row{moves.name,   handle_of(moves), !cuts_of(moves).empty(), label(entry.contestant), name(entry.contestant),
               entry.refusal};
  if (!entry.measurement) {
    return row;
  }
  const PhysicsMeasurement& measured = *entry.measurement;
  row.relative = measured.error.relative;
  row.hausdorff = measured.shape.hausdorff;
  row.volume_change = measured.shape.volume_change;
  if (measured.shape.inverted_cells) {
    row.inverted_cells = double(*measured.shape.inverted_cells);
  }
  row.stretch = measured.shape.stretch;
  row.violation = measured.shape.violation;
  if (measured.iterations) {
    row.iterations = double(*measured.iterations);
  }
  row.residual = measured.residual;
  if (measured.binds) {
    row.binds = *measured.binds ? 1 : 0;
  }
  row.factorize_ms = median_of(measured.prepare.factorize);
  row.grab_ms = median_of(measured.prepare.grab);
  row.first_ms = median_of(measured.first_move);
  row.later_ms = median_of(measured.ms_per_move);
  row.after_cut_ms = median_of(measured.move_after_cut);
  if (measured.bytes) {
    row.bytes = double(*measured.bytes);
  }
  return row;
}

/// Returns by how much the last refinement changed a reference, as a share of its RMS displacement.
std::optional<double> change_of(const DragReference& reference) {
  return reference.refined && !reference.refined->levels.empty() ? reference.refined->levels.back().change
                                                                 : std::nullopt;
}

/// Notes what the answers of a drag are compared with.
void note(SuiteResult& result, const DragReference& reference, const StrainLaw& law) {
  if (reference.refined) {
    result.references.push_back(*reference.refined);
  }
  if (result.reference.empty()) {
    result.reference = reference.is_closed_form ? "closed form" : label(law) + " FEM";
  }
}

/// The contest on the object that is turned by 45° with its drags.
class TurnedContest {
 public:
  TurnedContest(const Case& object, const std::vector<PhysicsContestant>& contestants, const CompareOptions& options)
      : turn_(AxesKind::given, rotation_by(*object.mesh, turned_by)),
        object_(turned(object, turn_.rotation())),
        contest_(object_, contestants, options, Measured::errors) {}

  /// Adds the errors of a drag (its number) on the turned object to the rows of the drag: one for each contestant, in
  /// their order. `reference` is that of the object as it is.
  void add_errors(std::size_t drag, const ReferenceSolution& reference, SuiteRow* rows, const Progress& progress) {
    ReferenceSolution turned_reference = reference;
    std::vector<double>& displacements = turned_reference.displacements;
    for (std::size_t at = 0; at < displacements.size(); at += std::size_t(object_.mesh->space_dimension)) {
      turn_into_world(*object_.mesh, turn_, &displacements[at]);
    }
    const auto entries = contest_.run(object_.drags[drag], turned_reference, progress.quiet());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].measurement) {
        rows[i].relative_turned = entries[i].measurement->error.relative;
      }
    }
  }

 private:
  RegionAxes turn_;
  Case object_;
  Contest contest_;
};

std::vector<PhysicsContestant> calibrated_contestants(Running& running, const Case& object) {
  const auto calibrations = calibrations_of(object, running.options, running.progress);
  for (const Calibration& one : calibrations) {
    const std::string who = label(PhysicsContestant{one.algorithm, one.sweeps, one.softness, one.equilibrium});
    running.result.notes.push_back(one.refusal.empty()
                                       ? who + ": " + std::to_string(one.drags) + " drags of other elements, " +
                                             std::to_string(one.evaluations) + " evaluations"
                                       : who + ": left out, " + one.refusal);
  }
  const CompareOptions& contest = running.options.contest;
  return contestants_of(contest.algorithms, contest.sweeps, contest.equilibrium, calibrations);
}

void describe(SuiteResult& result, const Case& object) {
  result.elements = object.mesh->element_count();
  result.links = object.mesh->link_count();
  result.pins = object.pins.size();
}

/// Runs all drags of an object. Only those of the first handle without a cut also run on the turned object.
void run_drags(Running& running, const Case& object) {
  describe(running.result, object);
  const CompareOptions& contest_options = running.options.contest;
  const auto contestants = calibrated_contestants(running, object);
  DragReferences references(object, running.options.refine);
  CompareOptions to_own_limit = contest_options;
  to_own_limit.own_limit = own_limit_of_comparisons;
  Contest contest(object, contestants, to_own_limit);
  TurnedContest turned(object, contestants, contest_options);
  for (std::size_t i = 0; i < object.drags.size() && !running.progress.cancelled(); ++i) {
    const RecordedMoves& moves = object.drags[i];
    running.progress.show(double(i) / double(object.drags.size()));
    try {
      const DragReference reference = references.at_end(moves);
      note(running.result, reference, object.law);
      const std::size_t first = running.result.rows.size();
      for (const PhysicsEntry& entry : contest.run(moves, reference.solution, running.progress.quiet())) {
        running.result.rows.push_back(row_of(moves, entry));
        if (entry.measurement) {
          running.result.rows.back().reference_change = change_of(reference);
        }
      }
      if (handle_of(moves) == handle_of(object.drags.front()) && cuts_of(moves).empty()) {
        turned.add_errors(i, reference.solution, &running.result.rows[first], running.progress);
      }
    } catch (const Error& error) {
      running.result.notes.push_back(moves.name + " of element " + std::to_string(handle_of(moves)) +
                                     " has no reference: " + error.what());
    }
  }
}

std::optional<double> order_of(const std::vector<SuiteOrder::Size>& sizes) {
  if (sizes.size() < 2 || sizes.back().relative <= 0) {
    return std::nullopt;
  }
  return std::log2(sizes[sizes.size() - 2].relative / sizes.back().relative);
}

void run_refinement(Running& running, const std::vector<Case>& sizes) {
  describe(running.result, sizes.back());
  CompareOptions options = running.options.contest;
  options.precision = Precision::double_precision;  // the object hardly moves
  const auto contestants = contestants_of(options.algorithms, options.sweeps, options.equilibrium, {});
  auto& orders = running.result.orders;
  for (const PhysicsContestant& contestant : contestants) {
    orders.push_back({label(contestant), name(contestant), {}, {}, {}});
  }
  for (std::size_t i = 0; i < sizes.size() && !running.progress.cancelled(); ++i) {
    running.progress.show(double(i) / double(sizes.size()));
    Contest contest(sizes[i], contestants, options, Measured::errors);
    const RecordedMoves& moves = sizes[i].drags.front();
    const auto reference = DragReferences(sizes[i], std::nullopt).at_end(moves);
    note(running.result, reference, sizes[i].law);
    const auto entries = contest.run(moves, reference.solution, running.progress.quiet());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (entries[k].measurement) {
        orders[k].sizes.push_back({sizes[i].mesh->element_count(), entries[k].measurement->error.relative});
      } else {
        orders[k].refusal = entries[k].refusal;
      }
    }
  }
  for (SuiteOrder& one : orders) {
    one.order = one.refusal.empty() ? order_of(one.sizes) : std::nullopt;
  }
}

void run_time_to_error(Running& running, const Case& object) {
  describe(running.result, object);
  const auto contestants = calibrated_contestants(running, object);
  DragReferences references(object, running.options.refine);
  const auto reference_of_drag = [&](const RecordedMoves& moves) {
    DragReference reference = references.at_end(moves);
    note(running.result, reference, object.law);
    return reference.solution;
  };
  const ReferenceSolution at_end = reference_of_drag(object.drags.front());
  std::vector<TimedDrag> drags{{object.drags[0], at_end}, {object.drags[1], at_end}};
  ReferenceSolution after_cut;
  if (object.drags.size() > drags.size()) {
    after_cut = reference_of_drag(object.drags[2]);
    drags.push_back({object.drags[2], after_cut});
  }
  running.result.times = times_to_error(object, contestants, drags, running.options.contest, running.progress);
}

SuiteResult result_of(const SuiteExperiment& experiment, const SuiteOptions& options, const Progress& progress) {
  Running running{experiment, options_of(options, experiment), progress, {}};
  running.result.name = experiment.name;
  running.result.description = experiment.description;
  const Clocks clocks = machine_clocks();
  const double begin = clocks.wall();
  const std::vector<Case> cases = experiment.cases(options.organs);
  switch (experiment.kind) {
    case SuiteKind::drags:
      run_drags(running, cases.front());
      break;
    case SuiteKind::refinement:
      run_refinement(running, cases);
      break;
    case SuiteKind::time_to_error:
      run_time_to_error(running, cases.front());
      break;
  }
  running.result.seconds = clocks.wall() - begin;
  return std::move(running.result);
}

const SuiteExperiment& experiment_named(const std::string& name) {
  const auto all = suite_experiments();
  const auto found = std::ranges::find(all, name, &SuiteExperiment::name);
  if (found == all.end()) {
    std::string names;
    for (const SuiteExperiment& one : all) {
      names += (names.empty() ? "" : ", ") + std::string(one.name);
    }
    throw Error("experiments", "there is no experiment " + name, "use some of " + names);
  }
  return *found;
}

}  // namespace

std::optional<double> shortest_ms(const SuiteTime& time, const SuitePointFigures& of, double error) {
  std::optional<double> shortest;
  for (const SuitePoint& point : time.curve) {
    const auto &reached = point.*of.error, &ms = point.*of.ms;
    if (reached && ms && *reached <= error) {
      shortest = std::min(shortest.value_or(*ms), *ms);
    }
  }
  return shortest;
}

std::optional<double> least_error(const SuiteTime& time) {
  std::optional<double> least;
  for (const SuitePoint& point : time.curve) {
    if (point.relative) {
      least = std::min(least.value_or(*point.relative), *point.relative);
    }
  }
  return least;
}

std::vector<std::string> all_suite_names() {
  std::vector<std::string> names;
  for (const SuiteExperiment& one : suite_experiments()) {
    names.emplace_back(one.name);
  }
  return names;
}

std::vector<std::string> suite_names() {
  std::vector<std::string> names;
  for (const SuiteExperiment& one : suite_experiments()) {
    if (!one.only_named) {
      names.emplace_back(one.name);
    }
  }
  return names;
}

std::vector<std::string> part_of(const std::vector<std::string>& names, const Shard& shard) {
  std::vector<std::string> part;
  for (auto i = std::size_t(shard.index - 1); i < names.size(); i += std::size_t(shard.count)) {
    part.push_back(names[i]);
  }
  return part;
}

Suite run_suite(const std::vector<std::string>& names, const SuiteOptions& options, const Progress& progress) {
  std::vector<const SuiteExperiment*> chosen(names.size());
  std::ranges::transform(names, chosen.begin(), [](const std::string& name) { return &experiment_named(name); });
  Suite suite;
  for (std::size_t i = 0; i < chosen.size() && !progress.cancelled(); ++i) {
    const Progress part = progress.part(double(i) / double(chosen.size()), double(i + 1) / double(chosen.size()));
    part.say(std::string(chosen[i]->name));
    part.show(0);
    SuiteResult result = result_of(*chosen[i], options, part);
    if (!progress.cancelled()) {
      suite.results.push_back(std::move(result));
    }
  }
  suite.stopped = progress.cancelled();
  return suite;
}

Suite merged(const std::vector<Suite>& parts) {
  Suite all;
  for (const Suite& part : parts) {
    all.runs.insert(all.runs.end(), part.runs.begin(), part.runs.end());
    for (const SuiteResult& result : part.results) {
      if (std::ranges::count(all.results, result.name, &SuiteResult::name) > 0) {
        throw Error(result.name, "this experiment is in two of the files", "give each part of a suite once");
      }
      all.results.push_back(result);
    }
  }
  const auto names = all_suite_names();
  std::ranges::stable_sort(all.results, {}, [&](const SuiteResult& result) {
    return std::ranges::find(names, result.name) - names.begin();
  });
  return all;
}

std::vector<std::string> missing_from(const Suite& suite) {
  auto names = suite_names();
  std::erase_if(
      names, [&](const std::string& name) { return std::ranges::count(suite.results, name, &SuiteResult::name) > 0; });
  return names;
}

}  // namespace chainmail::report
