#pragma once

#include <vector>

#include "report/run/clocks.h"
#include "report/run/compare.h"
#include "simulate/simulation.h"

namespace chainmail::report {

/// Runs recorded moves on a case from rest, with one algorithm in one precision.
class Runner {
 public:
  Runner(const Case& object, Algorithm algorithm, Precision precision, const CompareOptions& options);

  /// Times and counts of a run.
  struct Run {
    std::vector<double> ms;  // time of each move: its pass and its relaxation, without the time of other programs
    double grab_ms = 0;      // time of all grabs
    std::uint64_t checked = 0;
    std::uint64_t moved = 0;
    bool stopped = false;
  };
  /// Runs the moves. Cancelling takes effect within a pass of a method of elasticity, between passes of other
  /// algorithms, within sweeps, and between iterations.
  /// With `must_converge`, a drag ends at the first move of a method of elasticity that does not converge.
  Run run(const RecordedMoves& moves, Relaxing relaxing, const Progress& progress, bool must_converge = false);
  /// Does the same as part of a longer work, whose share stays: cancelled, it returns `stopped` instead of throwing
  /// Cancelled.
  Run try_run(const RecordedMoves& moves, Relaxing relaxing, const Progress& progress, bool must_converge = false);

  const Simulation& simulation() const { return simulation_; }
  /// Returns how close the object is to the equilibrium; none if it was not relaxed to it.
  std::optional<EquilibriumCertificate> certificate() { return simulation_.certificate(); }
  /// Returns the elements of the last handle; none before the first run.
  const std::vector<ElementId>& handle() const { return handle_; }

 private:
  void go_to_rest();
  void carry_out(const Command& command, Relaxing relaxing, Run& run);
  void relax(Relaxing relaxing);

  const Case& object_;
  std::vector<LinkId> cuts_;     // ascending, as in the solver
  std::vector<ElementId> pins_;  // ascending
  double relax_step_;
  Clocks clocks_;
  Simulation simulation_;
  std::vector<ElementId> handle_;
};

/// Throws Error if the moves cannot be repeated from rest, or if there are none.
void check(const RecordedMoves& moves);

/// Returns the number of passes.
int count_moves(const RecordedMoves& moves);

}  // namespace chainmail::report
