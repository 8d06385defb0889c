#include "report/run/compare.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <set>

#include "mesh/error.h"
#include "mesh/parameters.h"
#include "report/run/errors.h"
#include "report/run/runner.h"

namespace chainmail::report {
namespace {

constexpr int min_repetitions_of_drag = 5;
constexpr int max_repetitions_of_drag = 51;
constexpr double warm_up_share = 0.25;  // share of the progress for references and warm-up

using Clock = std::chrono::steady_clock;

/// The times of a drag's moves over its repetitions (ms).
class MoveTimes {
 public:
  /// Adds the times of the moves of one repetition (ms). All repetitions have the same number of moves.
  void add(std::vector<double> ms) { runs_.push_back(std::move(ms)); }

  /// Returns the spread, over the repetitions, of the mean time per move.
  TimeSpread spread() const;
  /// Returns the time of the slowest move: each move counts with its median over the repetitions.
  double worst() const;

 private:
  std::vector<std::vector<double>> runs_;
};

TimeSpread MoveTimes::spread() const {
  std::vector<double> means;
  for (const auto& run : runs_) {
    means.push_back(std::accumulate(run.begin(), run.end(), 0.0) / double(run.size()));
  }
  return spread_of(std::move(means));
}

double MoveTimes::worst() const {
  double worst = 0;
  for (std::size_t move = 0; !runs_.empty() && move < runs_.front().size(); ++move) {
    std::vector<double> of_move;
    for (const auto& run : runs_) {
      of_move.push_back(run[move]);
    }
    worst = std::max(worst, spread_of(std::move(of_move)).median);
  }
  return worst;
}

/// The runner of an algorithm, which all its contestants share; or the reason why there is none.
struct Participant {
  std::unique_ptr<Runner> runner;
  std::string refusal;
};

/// Runs one drag on one object with all contestants.
class Experiment {
 public:
  Experiment(const Case& object, const RecordedMoves& moves, const CompareOptions& options, const Progress& progress)
      : object_(object), moves_(moves), options_(options), progress_(progress) {
    result_ = {moves.name, moves.description, count_moves(moves), {}, {}};
    for (std::size_t i = 0; i < options.algorithms.size(); ++i) {
      if (!info(options.algorithms[i]).relaxes()) {
        add(i, {options.algorithms[i], 0});
        continue;
      }
      for (const int sweeps : options.sweeps) {
        add(i, {options.algorithms[i], sweeps});
      }
      if (options.equilibrium && takes_part_at_equilibrium(options.algorithms[i])) {
        add(i, {options.algorithms[i], 0, true});
      }
    }
    times_.resize(result_.entries.size());
  }

  /// Returns nothing if it was cancelled.
  std::optional<DragResult> run() {
    make_runners();
    measure_errors();
    for (int repetition = 0; repetition < repetitions_ && !progress_.cancelled(); ++repetition) {
      progress_.show(warm_up_share + (1 - warm_up_share) * repetition / repetitions_);
      repeat(static_cast<std::size_t>(repetition));
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (auto& measurement = result_.entries[i].measurement) {
        measurement->ms_per_move = times_[i].spread();
        measurement->worst_move_ms = times_[i].worst();
      }
    }
    return progress_.cancelled() ? std::nullopt : std::optional(std::move(result_));
  }

 private:
  void add(std::size_t participant, const Contestant& contestant) {
    result_.entries.push_back({contestant, std::nullopt, {}});
    participant_of_.push_back(participant);
  }

  Participant& participant_of(std::size_t entry) { return participants_[participant_of_[entry]]; }

  void make_runners() {
    for (const Algorithm algorithm : options_.algorithms) {
      Participant& participant = participants_.emplace_back();
      try {
        participant.runner = std::make_unique<Runner>(object_, algorithm, options_.precision, options_);
      } catch (const Error& error) {
        participant.refusal = error.what();
      }
    }
  }

  /// Runs the warm-up, which is not timed, and measures the errors, which are the same in every repetition.
  void measure_errors() {
    References references(object_, moves_, options_, progress_);
    result_.no_exact = references.no_exact();
    double seconds = 0;
    for (std::size_t i = 0; i < result_.entries.size() && !progress_.cancelled(); ++i) {
      progress_.show(warm_up_share * double(i) / double(result_.entries.size()));
      Entry& entry = result_.entries[i];
      entry.refusal = participant_of(i).refusal;
      if (participant_of(i).runner) {
        seconds += try_out(entry, *participant_of(i).runner, references);
      }
    }
    repetitions_ = options_.repetitions.value_or(static_cast<int>(std::clamp<double>(
        options_.seconds / std::max(seconds, 1e-6), min_repetitions_of_drag, max_repetitions_of_drag)));
  }

  /// Returns the time of a run in seconds.
  double try_out(Entry& entry, Runner& runner, References& references) {
    const auto start = Clock::now();
    try {
      const Runner::Run run = runner.try_run(moves_, entry.contestant.relaxing(), progress_);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (const std::string remark = runner.simulation().statistics().remark;
          !remark.empty() && info(entry.contestant.algorithm).elastic) {
        entry.refusal = remark;
      } else if (!run.stopped) {
        entry.measurement = Measurement{{}, 0, run.checked, run.moved, references.errors_of(runner, entry.contestant)};
      }
      return seconds;
    } catch (const Error& error) {
      entry.refusal = error.what();
      return 0;
    }
  }

  /// Runs each contestant once. Rotates the order so that order effects cancel.
  void repeat(std::size_t repetition) {
    const std::size_t count = result_.entries.size();
    for (std::size_t turn = 0; turn < count && !progress_.cancelled(); ++turn) {
      const std::size_t i = (turn + repetition) % count;
      if (result_.entries[i].measurement) {
        auto run = participant_of(i).runner->try_run(moves_, result_.entries[i].contestant.relaxing(), progress_);
        if (!run.stopped) {
          times_[i].add(std::move(run.ms));
        }
      }
    }
  }

  const Case& object_;
  const RecordedMoves& moves_;
  const CompareOptions& options_;
  const Progress& progress_;
  DragResult result_;
  std::vector<Participant> participants_;    // one per algorithm
  std::vector<std::size_t> participant_of_;  // of each contestant: the index of its participant
  std::vector<MoveTimes> times_;             // one per contestant
  int repetitions_ = 0;
};

CompareOptions checked(const std::vector<Case>& cases, CompareOptions options) {
  if (options.algorithms.empty()) {
    for (const AlgorithmInfo& one : algorithms()) {
      options.algorithms.push_back(one.algorithm);
    }
  }
  check(options);
  for (const Case& object : cases) {
    std::ranges::for_each(object.drags, [](const RecordedMoves& moves) { check(moves); });
  }
  return options;
}

}  // namespace

void check(const CompareOptions& options) {
  const bool is_empty = options.sweeps.empty() && !options.equilibrium;
  if (is_empty || std::ranges::any_of(options.sweeps, [](int sweeps) { return sweeps < 0; })) {
    throw Error("relax", "there is no number of sweeps, or a number below 0", "use numbers from 0");
  }
  if (!info(options.scheme).sweeps) {
    throw Error("relaxation", "the equilibrium is not a scheme of sweeps",
                "use mean or link, and list the equilibrium next to the numbers of sweeps");
  }
  check(parameters::relax_step, options.relax_step);
  if (options.repetitions && *options.repetitions < 1) {
    throw Error("repetitions", "the number is below 1", "use 1 or more");
  }
}

bool takes_part_at_equilibrium(Algorithm algorithm) {
  return algorithm == Algorithm::exact || algorithm == Algorithm::natural_queue;
}

std::string label(const Contestant& contestant) {
  if (contestant.equilibrium) {
    std::string name(info(contestant.algorithm).label);
    constexpr std::string_view family = " ChainMail";
    if (name.ends_with(family)) {
      name.resize(name.size() - family.size());
    }
    return name + " + equilibrium";
  }
  return std::string(info(contestant.algorithm).label) + (contestant.sweeps == 0 ? ""
                                                          : contestant.sweeps == 1
                                                              ? ", 1 sweep"
                                                              : ", " + std::to_string(contestant.sweeps) + " sweeps");
}

Comparison compare(const std::vector<Case>& cases, const CompareOptions& options, const Progress& progress) {
  Comparison comparison{checked(cases, options), {}, false};
  std::size_t drags = 0, done = 0;
  for (const Case& object : cases) {
    drags += object.drags.size();
  }
  for (const Case& object : cases) {
    CaseResult& result = comparison.cases.emplace_back();
    result = {object.name,
              object.description,
              object.mesh->element_count(),
              object.mesh->link_count() - std::set(object.cuts.begin(), object.cuts.end()).size(),
              {}};
    for (const RecordedMoves& moves : object.drags) {
      const Progress of_drag = progress.part(double(done) / double(drags), double(done + 1) / double(drags));
      of_drag.say(object.name + ", " + moves.name);
      of_drag.show(0);
      auto drag = Experiment(object, moves, comparison.options, of_drag).run();
      if (!drag) {
        comparison.stopped = true;
        return comparison;
      }
      result.drags.push_back(std::move(*drag));
      ++done;
    }
  }
  progress.say("done");
  progress.show(1);
  return comparison;
}

}  // namespace chainmail::report
