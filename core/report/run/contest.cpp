#include "report/run/contest.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "mesh/error.h"
#include "report/run/drag_times.h"
#include "report/run/memory_in_use.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"

namespace chainmail::report {
namespace {

constexpr int min_repetitions = 3, max_repetitions = 51;
constexpr double longest_repeated_drag = 0.3;  // seconds; slower drags are not repeated
constexpr double own_limits_residual = 0.01;   // of the iterations to a contestant's own limit, over the wanted share
constexpr double rounding_of_handle = 1e-4;    // mean rest lengths; positions are in float

/// Returns true if the handle is where the reference has it.
bool handle_is_there(const Simulation& simulation, const std::vector<ElementId>& handle,
                     const ReferenceSolution& reference) {
  const Mesh& mesh = simulation.mesh();
  const PositionView positions = simulation.body().positions();
  const auto n = std::size_t(mesh.space_dimension);
  return std::ranges::all_of(handle, [&](ElementId element) {
    for (std::size_t k = 0; k < n; ++k) {
      const double target = mesh.rest[element * n + k] + reference.displacements[element * n + k];
      if (!(std::abs(positions(element, int(k)) - target) <= rounding_of_handle * mesh.mean_link_length)) {
        return false;
      }
    }
    return true;
  });
}

}  // namespace

/// One contestant with its solver and its times.
class Contest::Participant {
 public:
  Participant(const Case& object, const PhysicsContestant& contestant, const CompareOptions& options, bool is_timed)
      : object_(object),
        whole_(object),
        contestant_(contestant),
        options_(options),
        is_timed_(is_timed),
        clocks_(options.clocks) {
    if (!contestant.algorithm) {
      return;
    }
    if (contestant.limit > 0 && !contestant.equilibrium) {
      object_.elastic.iterations = std::uint32_t(contestant.limit);
    }
    object_.softness = softness_of(contestant, object_.softness);
    const auto before = bytes_in_use();
    try {
      runner_ = std::make_unique<Runner>(object_, *contestant.algorithm, options.precision, options);
    } catch (const Error& error) {
      refusal_ = error.what();
    }
    bytes_ = bytes_since(before);
  }

  /// Runs a drag for the first time and measures the errors. `preparations` is null if nothing is timed.
  void try_out(const RecordedMoves& moves, const ReferenceSolution& reference, Preparations* preparations,
               const Progress& progress) {
    entry_ = {contestant_, std::nullopt, refusal_};
    times_ = {};
    warm_ = false;
    limited_ = nullptr;
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
      const PreparingTimes* preparing = preparations != nullptr ? &prepared(*preparations) : nullptr;
      has_cut_ = !cuts_of(moves).empty();
      moves_ = prepares(contestant_) ? with_preparing_move(*object_.mesh, moves) : moves;
      const auto before = bytes_in_use();
      if (is_timed_ && !prepares(contestant_)) {
        run(progress);  // prepares, so that no time of the next run contains this
        times_ = {};
      }
      run(progress);
      bytes_ = has_run_ ? bytes_ : sum_of(bytes_, bytes_since(before));
      has_run_ = true;
      measure(reference);
      if (entry_.measurement && preparing != nullptr) {
        entry_.measurement->prepare = preparing->of(handle_of(moves));
      }
    } catch (const Error& error) {
      entry_.refusal = error.what();
    }
  }

  /// Call this after try_out(). From now on the drag runs with the least number of iterations per move with which the
  /// answer at its end is close to that of try_out(), the own limit.
  void limit_iterations(const RecordedMoves& moves, const ReferenceSolution& reference, const Progress& progress) {
    if (!entry_.measurement || !runner_ || contestant_.limit > 0) {
      return;
    }
    ReferenceSolution own = reference;  // its own converged answer, which each number of iterations is compared with
    own.displacements = displacements();
    for (const int limit : limits_of(contestant_)) {
      Participant& one = limited_to(limit);
      one.try_out(moves, own, nullptr, progress);
      if (one.entry_.measurement && one.entry_.measurement->error.relative <= options_.own_limit) {
        one.measure(reference);
        const Preparation prepare = entry_.measurement->prepare;
        entry_.measurement = one.entry_.measurement;
        entry_.measurement->prepare = prepare;
        entry_.measurement->iterations = limit;
        limited_ = &one;
        return;
      }
    }
  }

  int repetitions(double seconds) const {
    if (limited_ != nullptr) {
      return limited_->repetitions(seconds);
    }
    if (!entry_.measurement || !runner_ || seconds_ > longest_repeated_drag) {
      return 0;
    }
    return std::clamp(int(seconds / std::max(seconds_, 1e-6)), min_repetitions, max_repetitions);
  }

  void repeat(const Progress& progress) {
    if (limited_ != nullptr) {
      limited_->repeat(progress);
      return;
    }
    if (!warm_) {
      times_ = {};  // the first run was a warm-up
      warm_ = true;
    }
    run(progress);
  }

  PhysicsEntry result() {
    if (auto& measured = entry_.measurement; measured && runner_) {
      const RepeatedDrag& times = limited_ != nullptr ? limited_->times_ : times_;
      measured->first_move = times.spread(&DragTimes::first);
      measured->ms_per_move = times.spread(&DragTimes::later);
      measured->move_after_cut = has_cut_ ? times.spread(&DragTimes::after_cut) : TimeSpread();
    }
    return std::move(entry_);
  }

 private:
  /// Returns the times of preparation for the object and all its handles. Measures them for the first contestant of
  /// those that share them.
  const PreparingTimes& prepared(Preparations& preparations) const {
    PhysicsContestant shared = contestant_;
    shared.limit = shared.sweeps = 0;
    const auto found = std::ranges::find(preparations, shared, &Preparations::value_type::first);
    if (found != preparations.end()) {
      return found->second;
    }
    const Algorithm method = *contestant_.algorithm;
    return preparations
        .emplace_back(shared, info(method).elastic ? PreparingTimes(object_, method, clocks_)
                                                   : PreparingTimes(object_, method, contestant_.equilibrium, options_))
        .second;
  }

  Participant& limited_to(int limit) {
    std::unique_ptr<Participant>& one = by_limit_[limit];
    if (!one) {
      PhysicsContestant contestant = contestant_;
      contestant.limit = limit;
      one = std::make_unique<Participant>(whole_, contestant, options_, is_timed_);
    }
    return *one;
  }

  /// The displacements at the end of the last run.
  std::vector<double> displacements() const {
    const PositionView at = runner_->simulation().body().positions();
    const auto n = std::size_t(object_.mesh->space_dimension);
    std::vector<double> displacements(object_.mesh->rest.size());
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      displacements[i] = at(ElementId(i / n), int(i % n)) - object_.mesh->rest[i];
    }
    return displacements;
  }

  Relaxing relaxing() const {
    Relaxing relaxing(contestant_.sweeps, contestant_.equilibrium);
    relaxing.iterations = contestant_.limit > 0 ? contestant_.limit : relaxing.iterations;
    if (options_.own_limit > 0) {
      relaxing.until = own_limits_residual * options_.own_limit;  // the own limit itself must be closer than that
    }
    return relaxing;
  }

  void run(const Progress& progress) {
    const double start = clocks_.wall();
    const Runner::Run run = runner_->try_run(moves_, relaxing(), progress, contestant_.limit == 0);
    stopped_ = run.stopped;
    if (run.stopped) {
      return;
    }
    const DragTimes times = split(run.ms, prepares(contestant_), has_cut_);
    // Without a cut, the repetitions of the drag do not prepare again.
    seconds_ = clocks_.wall() - start - (has_cut_ ? 0 : times.preparing / 1e3);
    times_.add(times);
  }

  /// A contestant that did not converge, by its own rule, has no figures, unless its iterations are limited.
  void measure(const ReferenceSolution& reference) {
    const Simulation& simulation = runner_->simulation();
    if (contestant_.limit == 0 || !handle_is_there(simulation, runner_->handle(), reference)) {
      entry_.refusal = simulation.statistics().remark;
    }
    const auto equilibrium = contestant_.equilibrium ? runner_->certificate() : std::nullopt;
    if (contestant_.limit == 0 && equilibrium && equilibrium->residual > compared_residual) {
      entry_.refusal = "it did not reach the residual in " + std::to_string(equilibrium_iterations) + " iterations";
    }
    if (!stopped_ && entry_.refusal.empty()) {
      PhysicsMeasurement& measured = entry_.measurement.emplace();
      measured.error = measure_physical_error(simulation.mesh(), simulation.body().positions(), reference);
      measured.shape = shape_of(simulation.body().positions(), simulation.body().cuts(), reference);
      measured.bytes = bytes_;
      if (equilibrium) {
        measured.residual = equilibrium->residual;
        measured.binds = equilibrium->binds;
      }
      if (!std::isfinite(measured.error.relative)) {
        entry_.measurement.reset();
        entry_.refusal = "its positions are not numbers: it diverged";
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

  Case object_;        // with the softness of the contestant
  const Case& whole_;  // as it was given
  PhysicsContestant contestant_;
  CompareOptions options_;
  bool is_timed_;
  std::map<int, std::unique_ptr<Participant>> by_limit_;  // by the number of iterations
  std::unique_ptr<Runner> runner_;
  std::string refusal_;
  std::optional<std::uint64_t> bytes_;  // held after the first drag
  bool has_run_ = false;
  Clocks clocks_;
  // State of the current drag:
  PhysicsEntry entry_;
  RecordedMoves moves_;
  bool has_cut_ = false;
  RepeatedDrag times_;
  double seconds_ = 0;
  bool warm_ = false, stopped_ = false;
  Participant* limited_ = nullptr;  // runs in place of this one; one of by_limit_
};

Contest::Contest(const Case& object, const std::vector<PhysicsContestant>& contestants, const CompareOptions& options,
                 Measured measured)
    : options_(options), measured_(measured) {
  for (const PhysicsContestant& contestant : contestants) {
    participants_.push_back(std::make_unique<Participant>(object, contestant, options_, measured_ != Measured::errors));
  }
}

Contest::~Contest() = default;

std::vector<PhysicsEntry> Contest::run(const RecordedMoves& moves, const ReferenceSolution& reference,
                                       const Progress& progress) {
  const double count = double(participants_.size());
  for (std::size_t i = 0; i < participants_.size() && !progress.cancelled(); ++i) {
    progress.show(0.5 * double(i) / count);
    participants_[i]->try_out(moves, reference, measured_ == Measured::errors ? nullptr : &preparations_, progress);
    if (options_.own_limit > 0 && measured_ != Measured::errors) {
      participants_[i]->limit_iterations(moves, reference, progress);
    }
  }
  // Contestants run in turns, so that other load on the machine affects all of them equally. Slow contestants repeat
  // less often.
  const auto wanted = [&](const Participant& one) {
    return measured_ == Measured::errors ? 0
           : options_.repetitions        ? std::min(one.repetitions(1e9), *options_.repetitions)
                                         : one.repetitions(options_.seconds / count);
  };
  for (int repetition = 0; repetition < max_repetitions && !progress.cancelled(); ++repetition) {
    progress.show(0.5 + 0.5 * repetition / max_repetitions);
    for (const auto& participant : participants_) {
      if (repetition < wanted(*participant) && !progress.cancelled()) {
        participant->repeat(progress);
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
