#include <algorithm>
#include <chrono>
#include <memory>

#include "mesh/error.h"
#include "mesh/outer_surface.h"
#include "report/move_times.h"
#include "report/physics.h"
#include "report/runner.h"

namespace chainmail::report {
namespace {

constexpr int fewest_repetitions = 3, most_repetitions = 51;
constexpr double slow = 1;  // who takes longer for a drag (seconds) repeats it once

using Clock = std::chrono::steady_clock;

/// What BEM is given of a volume: the same drag and pins on its outer surface, and where that should end.
struct SurfaceContest {
  Case object;
  RecordedMoves moves;
  Truth truth;
};

SurfaceContest on_surface(const Case& volume, const RecordedMoves& moves, const Truth& truth) {
  const OuterSurface surface = outer_surface(volume.mesh);
  SurfaceContest result{volume, moves, {{}, truth.hand}};
  result.object.mesh = surface.mesh;
  result.object.softness.links.clear();
  result.object.pins.clear();
  for (const ElementId pin : volume.pins) {
    if (const ElementId own = surface.on_surface(pin); own != no_element) {
      result.object.pins.push_back(own);
    }
  }
  for (Command& command : result.moves.commands) {
    if (auto* grab = std::get_if<commands::Grab>(&command)) {
      grab->element = surface.on_surface(grab->element);
      if (grab->element == no_element) {
        throw Error("BEM", "the hand holds an element inside, and BEM has the surface alone",
                    "drag one of the surface");
      }
    }
  }
  const auto dimension = static_cast<std::size_t>(volume.mesh->space_dimension);
  for (const ElementId element : surface.elements) {
    const auto first = truth.displacements.begin() + static_cast<std::ptrdiff_t>(element * dimension);
    result.truth.displacements.insert(result.truth.displacements.end(), first,
                                      first + static_cast<std::ptrdiff_t>(dimension));
  }
  return result;
}

/// The time (ms) that a method of elasticity takes before its first move; 0 of the others.
double prepare_ms(const Case& object, const RecordedMoves& moves, Algorithm algorithm) {
  const auto method = elastic_method(algorithm);
  if (!method) {
    return 0;
  }
  ElasticProblem problem{object.mesh, Cuts(object.mesh), object.pins, {}, object.elastic};
  std::ranges::sort(problem.pins);
  problem.pinned.resize(object.pins.size() * static_cast<std::size_t>(object.mesh->space_dimension));
  const auto* grab = std::get_if<commands::Grab>(&moves.commands.front());
  return 1e3 * seconds_of(machine_clocks(), [&] {
           const auto solver = make_elastic(*method, problem);
           if (grab != nullptr) {
             solver->hold(grab->element);
           }
         });
}

/// One contestant with all that its runs need.
class Participant {
 public:
  Participant(const Case& object, const RecordedMoves& moves, const Truth& truth, const Contestant& contestant,
              const CompareOptions& options)
      : object_(object), entry_{contestant, std::nullopt, {}} {
    try {
      const bool has_cells = !object.mesh->tetrahedra.empty() || !object.mesh->hexahedra.empty();
      if (contestant.algorithm == Algorithm::boundary_elements && has_cells) {
        surface_ = std::make_unique<SurfaceContest>(on_surface(object, moves, truth));
      }
      moves_ = surface_ ? &surface_->moves : &moves;
      truth_ = surface_ ? &surface_->truth : &truth;
      runner_ = std::make_unique<Runner>(object_of(), contestant.algorithm, options.precision, options);
    } catch (const Error& error) {
      entry_.refusal = error.what();
    }
  }

  /// The first run, which finds the errors, and what preparing takes. Returns its seconds.
  double try_out(const std::stop_token& stop) {
    if (!runner_) {
      return 0;
    }
    const auto start = Clock::now();
    try {
      const double prepare = prepare_ms(object_of(), *moves_, entry_.contestant.algorithm);
      const Runner::Run run = runner_->run(*moves_, entry_.contestant.sweeps, stop);
      if (run.stopped) {
        return 0;
      }
      if (const std::string& remark = runner_->simulation().statistics().remark; !remark.empty()) {
        entry_.refusal = remark;
        return 0;
      }
      const PositionView positions = runner_->simulation().solver().positions();
      entry_.measurement = {
          {}, prepare, measure_physical_error(runner_->simulation().mesh(), positions, *truth_), !!surface_};
      times_.add(of_moves(run.ms));
    } catch (const Error& error) {
      entry_.refusal = error.what();
    }
    seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    return seconds_;
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
    const Runner::Run run = runner_->run(*moves_, entry_.contestant.sweeps, stop);
    if (!run.stopped) {
      times_.add(of_moves(run.ms));
    }
  }

  PhysicsEntry result() {
    if (entry_.measurement) {
      entry_.measurement->ms_per_move = times_.spread();
    }
    return std::move(entry_);
  }

 private:
  /// A method of elasticity prepares in the first move.
  std::vector<double> of_moves(std::vector<double> ms) const {
    if (elastic_method(entry_.contestant.algorithm) && ms.size() > 1) {
      ms.erase(ms.begin());
    }
    return ms;
  }

  const Case& object_of() const { return surface_ ? surface_->object : object_; }

  const Case& object_;
  PhysicsEntry entry_;
  std::unique_ptr<SurfaceContest> surface_;
  const RecordedMoves* moves_ = nullptr;
  const Truth* truth_ = nullptr;
  std::unique_ptr<Runner> runner_;
  MoveTimes times_;
  double seconds_ = 0;
  bool warm_ = false;
};

}  // namespace

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

std::vector<PhysicsEntry> contest(const Case& object, const RecordedMoves& moves, const Truth& truth,
                                  const std::vector<Contestant>& contestants, const CompareOptions& options,
                                  const std::function<void(double)>& tell, const std::stop_token& stop) {
  std::vector<std::unique_ptr<Participant>> participants;
  for (const Contestant& contestant : contestants) {
    participants.push_back(std::make_unique<Participant>(object, moves, truth, contestant, options));
  }
  const double count = double(participants.size());
  for (std::size_t i = 0; i < participants.size() && !stop.stop_requested(); ++i) {
    tell(0.5 * double(i) / count);
    participants[i]->try_out(stop);
  }
  // In turns: what else the machine does meanwhile hits all alike. Who is slow takes fewer.
  const auto wanted = [&](const Participant& one) {
    return options.repetitions ? std::min(one.repetitions(1e9), *options.repetitions)
                               : one.repetitions(options.seconds / count);
  };
  for (int repetition = 0; repetition < most_repetitions && !stop.stop_requested(); ++repetition) {
    tell(0.5 + 0.5 * repetition / most_repetitions);
    for (const auto& participant : participants) {
      if (repetition < wanted(*participant) && !stop.stop_requested()) {
        participant->repeat(stop);
      }
    }
  }
  std::vector<PhysicsEntry> entries;
  for (const auto& participant : participants) {
    entries.push_back(participant->result());
  }
  return entries;
}

}  // namespace chainmail::report
