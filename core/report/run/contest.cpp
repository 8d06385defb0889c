#include "report/run/contest.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "mesh/error.h"
#include "report/run/drag_times.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"

namespace chainmail::report {
namespace {

constexpr int fewest_repetitions = 3, most_repetitions = 51;
constexpr double longest_repeated_drag = 0.3;  // seconds; slower drags are not repeated

}  // namespace

/// One contestant with its solver and its times.
class Contest::Participant {
 public:
  Participant(const Case& object, const PhysicsContestant& contestant, const CompareOptions& options)
      : object_(object), contestant_(contestant) {
    if (!contestant.algorithm) {
      return;
    }
    if (contestant.calibrated) {
      object_.softness = {*contestant.calibrated, {}, object_.softness.energy, object_.softness.frame};
    }
    try {
      runner_ = std::make_unique<Runner>(object_, *contestant.algorithm, options.precision, options);
    } catch (const Error& error) {
      refusal_ = error.what();
    }
  }

  /// Runs a drag for the first time and measures the errors.
  void try_out(const RecordedMoves& moves, const ReferenceSolution& reference, const std::stop_token& stop) {
    entry_ = {contestant_, std::nullopt, refusal_};
    times_ = {};
    warm_ = false;
    if (!contestant_.algorithm) {
      PhysicsMeasurement& measured = entry_.measurement.emplace();
      measured.error = error_of_nothing_moving(*object_.mesh, reference);
      const std::vector<double> at = positions_of_nothing_moving(*object_.mesh, reference);
      measured.shape = shape_of(view_of(at), Cuts(object_.mesh), reference);
      return;
    }
    if (!runner_) {
      return;
    }
    try {
      prepare();
      has_cut_ = !cuts_of(moves).empty();
      moves_ = prepares(contestant_) ? with_preparing_move(*object_.mesh, moves) : moves;
      run(stop);
      measure(handle_of(moves), reference);
    } catch (const Error& error) {
      entry_.refusal = error.what();
    }
  }

  int repetitions(double seconds) const {
    if (!entry_.measurement || !runner_ || seconds_ > longest_repeated_drag) {
      return 0;
    }
    return std::clamp(int(seconds / std::max(seconds_, 1e-6)), fewest_repetitions, most_repetitions);
  }

  void repeat(const std::stop_token& stop) {
    if (!warm_) {
      times_ = {};  // the first run was a warm-up
      warm_ = true;
    }
    run(stop);
  }

  PhysicsEntry result() {
    if (auto& measured = entry_.measurement; measured && runner_) {
      measured->first_move = times_.spread(&DragTimes::first);
      measured->ms_per_move = times_.spread(&DragTimes::later);
      measured->move_after_cut = has_cut_ ? times_.spread(&DragTimes::after_cut) : TimeSpread();
    }
    return std::move(entry_);
  }

 private:
  /// Prepares once for the object and all its handles.
  void prepare() {
    if (prepares(contestant_) && !preparing_) {
      preparing_.emplace(object_, *info(*contestant_.algorithm).elastic);
    }
  }

  void run(const std::stop_token& stop) {
    const double start = clocks_.wall();
    const Runner::Run run = runner_->run(moves_, {contestant_.sweeps, contestant_.equilibrium}, stop);
    stopped_ = run.stopped;
    if (run.stopped) {
      return;
    }
    const DragTimes times = split(run.ms, prepares(contestant_), has_cut_);
    // Without a cut, the repetitions of the drag do not prepare again.
    seconds_ = clocks_.wall() - start - (has_cut_ ? 0 : times.preparing / 1e3);
    times_.add(times);
  }

  void measure(ElementId handle, const ReferenceSolution& reference) {
    const Simulation& simulation = runner_->simulation();
    entry_.refusal = simulation.statistics().remark;
    if (!stopped_ && entry_.refusal.empty()) {
      PhysicsMeasurement& measured = entry_.measurement.emplace();
      measured.error = measure_physical_error(simulation.mesh(), simulation.body().positions(), reference);
      measured.shape = shape_of(simulation.body().positions(), simulation.body().cuts(), reference);
      if (preparing_) {
        measured.prepare = preparing_->of(handle);
      }
    }
  }

  PositionView view_of(const std::vector<double>& positions) const {
    return {positions.data(), std::size_t(object_.mesh->space_dimension) * sizeof(double), Precision::double_precision};
  }

  ShapeFigures shape_of(const PositionView& positions, const Cuts& cuts, const ReferenceSolution& reference) const {
    std::vector<double> at = object_.mesh->rest;
    std::ranges::transform(at, reference.displacements, at.begin(), std::plus());
    return shape_figures(*object_.mesh, object_.softness, cuts, positions, view_of(at));
  }

  Case object_;  // with the softness of the contestant
  PhysicsContestant contestant_;
  std::unique_ptr<Runner> runner_;
  std::string refusal_;
  std::optional<PreparingTimes> preparing_;
  Clocks clocks_ = machine_clocks();
  // State of the current drag:
  PhysicsEntry entry_;
  RecordedMoves moves_;
  bool has_cut_ = false;
  RepeatedDrag times_;
  double seconds_ = 0;
  bool warm_ = false, stopped_ = false;
};

Contest::Contest(const Case& object, const std::vector<PhysicsContestant>& contestants, const CompareOptions& options)
    : options_(options) {
  for (const PhysicsContestant& contestant : contestants) {
    participants_.push_back(std::make_unique<Participant>(object, contestant, options_));
  }
}

Contest::~Contest() = default;

std::vector<PhysicsEntry> Contest::run(const RecordedMoves& moves, const ReferenceSolution& reference,
                                       const std::function<void(double)>& tell, const std::stop_token& stop) {
  const double count = double(participants_.size());
  for (std::size_t i = 0; i < participants_.size() && !stop.stop_requested(); ++i) {
    tell(0.5 * double(i) / count);
    participants_[i]->try_out(moves, reference, stop);
  }
  // Contestants run in turns, so that other load on the machine affects all of them equally. Slow contestants repeat
  // less often.
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
