#include "report/contest.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "mesh/error.h"
#include "report/move_times.h"
#include "report/runner.h"

namespace chainmail::report {
namespace {

constexpr int fewest_repetitions = 3, most_repetitions = 51;
constexpr double slow = 1;  // who takes longer for a drag (seconds) repeats it once

using Clock = std::chrono::steady_clock;

/// The time (ms) that a method of elasticity takes before its first move.
double time_of_preparing(const Case& object, ElasticMethod method, ElementId hand) {
  ElasticProblem problem{object.mesh, Cuts(object.mesh), object.pins, {}, object.elastic};
  std::ranges::sort(problem.pins);
  problem.pinned.resize(object.pins.size() * static_cast<std::size_t>(object.mesh->space_dimension));
  return 1e3 * seconds_of(machine_clocks(), [&] { make_elastic(method, problem)->hold(hand); });
}

ElementId hand_of(const RecordedMoves& moves) {
  const auto* grab = std::get_if<commands::Grab>(&moves.commands.front());
  return grab == nullptr ? 0 : grab->element;
}

}  // namespace

/// One contestant with all that its runs need.
class Contest::Participant {
 public:
  Participant(const Case& object, const Contestant& contestant, const CompareOptions& options)
      : object_(object), contestant_(contestant) {
    try {
      runner_ = std::make_unique<Runner>(object, contestant.algorithm, options.precision, options);
    } catch (const Error& error) {
      refusal_ = error.what();
    }
  }

  /// The first run of a drag, which finds the errors, and what preparing takes.
  void try_out(const RecordedMoves& moves, const Truth& truth, const std::stop_token& stop) {
    entry_ = {contestant_, std::nullopt, refusal_};
    times_ = {};
    warm_ = false;
    if (!runner_) {
      return;
    }
    try {
      moves_ = moves;
      prepare();
      const auto start = Clock::now();
      measure(runner_->run(moves_, contestant_.sweeps, stop), truth);
      seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    } catch (const Error& error) {
      entry_.refusal = error.what();
    }
  }

  int repetitions(double seconds) const {
    return !entry_.measurement ? 0
                               : std::clamp(int(seconds / std::max(seconds_, 1e-6)),
                                            seconds_ > slow ? 1 : fewest_repetitions, most_repetitions);
  }

  void repeat(const std::stop_token& stop) {
    if (!warm_) {
      times_ = {};  // the first run was the warm-up
      warm_ = true;
    }
    Runner::Run run = runner_->run(moves_, contestant_.sweeps, stop);
    if (!run.stopped) {
      times_.add(of_moves(std::move(run.ms)));
    }
  }

  PhysicsEntry result() {
    if (entry_.measurement) {
      entry_.measurement->ms_per_move = times_.spread();
    }
    return std::move(entry_);
  }

 private:
  /// Once for the element in the hand: another drag of it finds all prepared.
  void prepare() {
    const ElementId hand = hand_of(moves_);
    if (const auto method = elastic_method(contestant_.algorithm); method && hand != prepared_for_) {
      prepare_ms_ = time_of_preparing(object_, *method, hand);
      prepared_for_ = hand;
    }
  }

  void measure(Runner::Run run, const Truth& truth) {
    const Simulation& simulation = runner_->simulation();
    entry_.refusal = simulation.statistics().remark;
    if (!run.stopped && entry_.refusal.empty()) {
      const PhysicalError error = measure_physical_error(simulation.mesh(), simulation.solver().positions(), truth);
      entry_.measurement = {{}, prepare_ms_, error};
      times_.add(of_moves(std::move(run.ms)));
    }
  }

  /// A method of elasticity prepares in the first move.
  std::vector<double> of_moves(std::vector<double> ms) const {
    if (elastic_method(contestant_.algorithm) && ms.size() > 1) {
      ms.erase(ms.begin());
    }
    return ms;
  }

  const Case& object_;
  Contestant contestant_;
  std::unique_ptr<Runner> runner_;
  std::string refusal_;
  double prepare_ms_ = 0;
  ElementId prepared_for_ = no_element;
  // Of the present drag.
  PhysicsEntry entry_;
  RecordedMoves moves_;
  MoveTimes times_;
  double seconds_ = 0;
  bool warm_ = false;
};

std::vector<Contestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps) {
  std::vector<Contestant> contestants;
  for (const Algorithm algorithm : algorithms) {
    if (elastic_method(algorithm)) {
      contestants.push_back({algorithm, 0});
      continue;
    }
    for (const int count : sweeps) {
      contestants.push_back({algorithm, count});
    }
  }
  return contestants;
}

Contest::Contest(const Case& object, const std::vector<Contestant>& contestants, const CompareOptions& options)
    : options_(options) {
  for (const Contestant& contestant : contestants) {
    participants_.push_back(std::make_unique<Participant>(object, contestant, options_));
  }
}

Contest::~Contest() = default;

std::vector<PhysicsEntry> Contest::run(const RecordedMoves& moves, const Truth& truth,
                                       const std::function<void(double)>& tell, const std::stop_token& stop) {
  const double count = double(participants_.size());
  for (std::size_t i = 0; i < participants_.size() && !stop.stop_requested(); ++i) {
    tell(0.5 * double(i) / count);
    participants_[i]->try_out(moves, truth, stop);
  }
  // In turns: what else the machine does meanwhile hits all alike. Who is slow takes fewer.
  const auto wanted = [&](const Participant& one) {
    return options_.repetitions ? std::min(one.repetitions(1e9), *options_.repetitions)
                                : one.repetitions(options_.seconds / count);
  };
  for (int repetition = 0; repetition < most_repetitions && !stop.stop_requested(); ++repetition) {
    tell(0.5 + 0.5 * repetition / most_repetitions);
    for (const auto& participant : participants_) {
      if (repetition < wanted(*participant) && !stop.stop_requested()) {
        participant->repeat(stop);
      }
    }
  }
  std::vector<PhysicsEntry> entries;
  for (const auto& participant : participants_) {
    entries.push_back(participant->result());
  }
  return entries;
}

}  // namespace chainmail::report
