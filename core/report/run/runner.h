#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "report/run/clocks.h"
#include "report/run/compare.h"
#include "simulate/simulation.h"

namespace chainmail::report {

/// Carries recorded moves out on a case, each time from rest, by one algorithm in one precision.
class Runner {
 public:
  Runner(const Case& object, Algorithm algorithm, Precision precision, const CompareOptions& options);

  /// What a run did, move by move.
  struct Run {
    std::vector<double> ms;  // each move: its pass and its sweeps, without what other programs took
    std::uint64_t checked = 0;
    std::uint64_t moved = 0;
    bool stopped = false;
  };
  /// A request to stop ends it within a pass by a method of elasticity, between other passes and within sweeps.
  Run run(const RecordedMoves& moves, int sweeps, const std::stop_token& stop);
  /// The same, which leaves by Cancelled when it is given up.
  Run run(const RecordedMoves& moves, int sweeps, const chainmail::Progress& progress);

  const Simulation& simulation() const { return simulation_; }
  /// The element that was last in the hand.
  std::optional<ElementId> hand() const { return hand_; }

 private:
  void go_to_rest();
  void carry_out(const Command& command, int sweeps, Run& run);

  const Case& object_;
  std::vector<LinkId> cuts_;     // ascending, as the solver tells them
  std::vector<ElementId> pins_;  // ascending
  double relax_step_;
  Clocks clocks_ = machine_clocks();
  JobState job_;  // of a run that a request ends
  Simulation simulation_;
  std::optional<ElementId> hand_;
};

/// Throws Error where moves cannot be repeated from rest, or are none.
void check(const RecordedMoves& moves);

/// How many passes the commands ask for.
int count_moves(const RecordedMoves& moves);

}  // namespace chainmail::report
