#include "report/run/suite.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include "mesh/error.h"
#include "report/run/drag_reference.h"

namespace chainmail::report {
namespace {

constexpr double turned_by = 45;  // degrees: ChainMail's boxes follow the axes, and differ most half way between them
constexpr std::array sweeps_tried{0, 1, 3, 10, 30, 100, 300};

PhysicsOptions options_of(const SuiteOptions& suite, const SuiteExperiment& experiment) {
  PhysicsOptions options;
  options.algorithms = suite.algorithms;
  options.sweeps = {0};
  options.equilibrium = true;
  options.repetitions = suite.repetitions;
  options.seconds = suite.seconds;
  options.refine = reference_of(experiment);
  options.calibrate = suite.calibrate;
  if (options.algorithms.empty()) {
    for (const AlgorithmInfo& one : every_algorithm()) {
      options.algorithms.push_back(one.algorithm);
    }
  }
  return options;
}

/// An experiment that is running.
struct Running {
  PhysicsOptions options;
  Progress progress;
  Results results{.kind = ReportKind::suite};

  ObjectInfo& object() { return results.objects.back(); }
};

/// The contest on the object that is turned by 45° with its drags.
class TurnedContest {
 public:
  TurnedContest(const Case& object, const std::vector<Contestant>& contestants, ContestOptions options)
      : turn_(AxesKind::given, rotation_by(*object.mesh, turned_by)), object_(turned(object, turn_.rotation())) {
    options.own_limit = 0;
    options.only_errors = true;
    contest_.emplace(object_, contestants, options);
  }

  /// Adds the errors of a drag (its number) on the turned object to the rows of the drag, one for each contestant in
  /// their order. `reference` is that of the object as it is.
  void add_errors(std::size_t drag, const ReferenceSolution& reference, std::vector<Row>& rows,
                  const Progress& progress) {
    ReferenceSolution turned_reference = reference;
    std::vector<double>& displacements = turned_reference.displacements;
    for (std::size_t at = 0; at < displacements.size(); at += std::size_t(object_.mesh->space_dimension)) {
      turn_into_world(*object_.mesh, turn_, &displacements[at]);
    }
    PhysicsReferee referee(turned_reference);
    const std::vector<Row> turned = contest_->run(object_.drags[drag], &referee, progress.quiet());
    for (std::size_t i = 0; i < turned.size(); ++i) {
      if (rows[i].has_figures()) {
        rows[i].set(figures::relative_turned, turned[i][figures::relative]);
      }
    }
  }

 private:
  RegionAxes turn_;
  Case object_;
  std::optional<Contest> contest_;
};

std::vector<Contestant> calibrated_contestants(Running& running, const Case& object) {
  const auto calibrations = calibrations_of(object, running.options, running.progress);
  for (const Calibration& one : calibrations) {
    running.object().notes.push_back(in_words(one));
  }
  const PhysicsOptions& options = running.options;
  return contestants_of(options.algorithms, options.sweeps, options.equilibrium, calibrations);
}

/// Lists a drag with what its answers are compared with.
DragInfo described(Running& running, const RecordedMoves& moves, const DragReference& reference, const StrainLaw& law) {
  DragInfo drag = info_of(moves);
  drag.handle_displacement = reference.solution.handle_displacement;
  drag.reference = reference.refined;
  if (running.object().reference.empty()) {
    running.object().reference = reference.is_closed_form ? "closed form" : label(law) + " FEM";
  }
  return drag;
}

/// Runs all drags of an object. Only those of the first handle without a cut also run on the turned object.
void run_drags(Running& running, const Case& object) {
  const auto contestants = calibrated_contestants(running, object);
  DragReferences references(object, running.options.refine);
  Contest contest(object, contestants, running.options);
  TurnedContest turned(object, contestants, running.options);
  for (std::size_t i = 0; i < object.drags.size() && !running.progress.cancelled(); ++i) {
    const RecordedMoves& moves = object.drags[i];
    const Progress part =
        running.progress.part(double(i) / double(object.drags.size()), double(i + 1) / double(object.drags.size()));
    try {
      const DragReference reference = references.at_end(moves);
      PhysicsReferee referee(reference.solution, reference.change());
      std::vector<Row> rows = contest.run(moves, &referee, part);
      if (handle_of(moves) == handle_of(object.drags.front()) && cuts_of(moves).empty()) {
        turned.add_errors(i, reference.solution, rows, running.progress);
      }
      add_drag(running.results, described(running, moves, reference, object.law), std::move(rows));
    } catch (const Error& error) {
      DragInfo drag = info_of(moves);
      drag.no_reference = error.what();
      add_drag(running.results, std::move(drag), {});
    }
  }
}

void run_refinement(Running& running, const std::vector<Case>& sizes) {
  ContestOptions options = running.options;
  options.precision = Precision::double_precision;  // the object hardly moves
  options.own_limit = 0;
  options.only_errors = true;
  const PhysicsOptions& who = running.options;
  const auto contestants = contestants_of(who.algorithms, who.sweeps, who.equilibrium, {});
  const ObjectInfo experiment = running.object();
  running.results.objects.clear();
  for (std::size_t i = 0; i < sizes.size() && !running.progress.cancelled(); ++i) {
    running.progress.show(double(i) / double(sizes.size()));
    running.results.objects.push_back(info_of(sizes[i]));
    ObjectInfo& object = running.object();
    object.series = experiment.name;
    object.description = experiment.description;
    object.name = experiment.name + ", " + std::to_string(object.elements) + " elements";
    const RecordedMoves& moves = sizes[i].drags.front();
    const auto reference = DragReferences(sizes[i], std::nullopt).at_end(moves);
    PhysicsReferee referee(reference.solution);
    std::vector<Row> rows = Contest(sizes[i], contestants, options).run(moves, &referee, running.progress.quiet());
    add_drag(running.results, described(running, moves, reference, sizes[i].law), std::move(rows));
  }
}

/// Returns the variants of a contestant that run: with growing numbers of iterations or sweeps per move.
std::vector<Contestant> variants_of(const Contestant& contestant) {
  std::vector<Contestant> all;
  const auto add = [&](const auto& numbers, int Contestant::*member) {
    for (const int number : numbers) {
      all.push_back(contestant);
      all.back().*member = number;
    }
  };
  if (const auto limits = limits_of(contestant); !limits.empty()) {
    // The same for all contestants: with more, each takes longer than methods that are closer.
    add(std::span(limits.begin(), std::ranges::upper_bound(limits, equilibrium_iterations)), &Contestant::limit);
  } else if (contestant.calibrated && !contestant.equilibrium) {
    add(sweeps_tried, &Contestant::sweeps);
  } else {
    all.push_back(contestant);
  }
  return all;
}

/// Measures time and error of each contestant in all drags: one of many moves, one to the same end in one move, and
/// perhaps one with a cut. All numbers of iterations run in turns.
void run_time_to_error(Running& running, const Case& object) {
  std::vector<Contestant> variants;
  for (const Contestant& contestant : calibrated_contestants(running, object)) {
    if (contestant.algorithm) {
      std::ranges::copy(variants_of(contestant), std::back_inserter(variants));
    }
  }
  ContestOptions options = running.options;
  options.own_limit = 0;
  DragReferences references(object, running.options.refine);
  Contest contest(object, variants, options);
  std::optional<DragReference> last;
  for (const RecordedMoves& moves : object.drags) {
    const auto done = double(running.object().drags.size()), all = double(object.drags.size());
    if (!last || count_moves(moves) != 1) {  // one move ends where the drag before it does
      last = references.at_end(moves);
    }
    PhysicsReferee referee(last->solution, last->change());
    std::vector<Row> rows = contest.run(moves, &referee, running.progress.part(done / all, (done + 1) / all));
    add_drag(running.results, described(running, moves, *last, object.law), std::move(rows));
  }
}

Results results_of(const SuiteExperiment& experiment, const SuiteOptions& options, const Progress& progress) {
  Running running{options_of(options, experiment), progress};
  const Clocks clocks = machine_clocks();
  const double begin = clocks.wall();
  const std::vector<Case> cases = experiment.cases(options.organs);
  running.results.objects.push_back(info_of(cases.front()));
  running.object().name = experiment.name;
  running.object().description = experiment.description;
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
  running.results.objects.front().seconds = clocks.wall() - begin;
  return std::move(running.results);
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

Results run_suite(const std::vector<std::string>& names, const SuiteOptions& options, const Progress& progress) {
  std::vector<const SuiteExperiment*> chosen(names.size());
  std::ranges::transform(names, chosen.begin(), [](const std::string& name) { return &experiment_named(name); });
  Results suite{.kind = ReportKind::suite};
  for (std::size_t i = 0; i < chosen.size() && !progress.cancelled(); ++i) {
    Results one = results_of(*chosen[i], options,
                             part_of(progress, double(i), double(chosen.size()), std::string(chosen[i]->name)));
    if (!progress.cancelled()) {
      suite.add(std::move(one));
    }
  }
  suite.stopped = progress.cancelled();
  return suite;
}

namespace {

const std::string& experiment_of(const ObjectInfo& object) {
  return object.series.empty() ? object.name : object.series;
}

bool contains(const Results& suite, const std::string& experiment) {
  return std::ranges::any_of(suite.objects, [&](const ObjectInfo& one) { return experiment_of(one) == experiment; });
}

}  // namespace

Results merged(const std::vector<Results>& parts) {
  Results all{.kind = ReportKind::suite};
  for (const Results& part : parts) {
    for (const ObjectInfo& object : part.objects) {
      if (contains(all, experiment_of(object))) {
        throw Error(experiment_of(object), "this experiment is in two of the files", "give each part of a suite once");
      }
    }
    all.add(part);
  }
  const auto names = all_suite_names();
  std::vector<std::size_t> order(all.objects.size()), place(order.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t object) {
    return std::ranges::find(names, experiment_of(all.objects[object])) - names.begin();
  });
  std::vector<ObjectInfo> objects;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    objects.push_back(std::move(all.objects[order[i]]));
  }
  all.objects = std::move(objects);
  for (Row& row : all.rows) {
    row.object = place[row.object];
  }
  std::ranges::stable_sort(all.rows, {}, &Row::object);
  return all;
}

std::vector<std::string> missing_from(const Results& suite) {
  auto names = suite_names();
  std::erase_if(names, [&](const std::string& name) { return contains(suite, name); });
  return names;
}

}  // namespace chainmail::report
