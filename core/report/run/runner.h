#pragma once

#include <optional>
#include <vector>

#include "mesh/progress.h"
#include "report/run/cases.h"
#include "report/run/clocks.h"
#include "simulate/simulation.h"

namespace chainmail::report {

/// Residual at which a comparison ends the iterations to the equilibrium: the error that is left is well below the
/// physical error of every method.
inline constexpr double compared_residual = 1e-2;

/// The relaxation after each pass: a number of sweeps, or iterations to the equilibrium.
struct Relaxing {
  Relaxing(int count = 0, bool to_equilibrium = false, int most = equilibrium_iterations)
      : sweeps(count), equilibrium(to_equilibrium), iterations(most) {}

  int sweeps;        // 0 with `equilibrium`
  bool equilibrium;  // until the residual is at most `until`, but at most `iterations`
  int iterations;
  double until = compared_residual;

  bool is_none() const { return sweeps == 0 && !equilibrium; }
};

/// How all contestants run.
struct RunOptions {
  /// Scheme of the sweeps.
  RelaxationScheme scheme = RelaxationScheme::mean;
  double relax_step = parameters::relax_step.default_value;
  /// Precision of the contestants. The references are always in double.
  Precision precision = Precision::single_precision;
  Clocks clocks = machine_clocks();  // of everything but passes, which measure themselves
};

/// Gives a simulation of the mesh of an object at rest its elasticity, softness, cuts and pins.
void set_up(Simulation& simulation, const Case& object);

/// Runs recorded moves on a case from rest, with one algorithm in one precision.
class Runner {
 public:
  Runner(const Case& object, Algorithm algorithm, Precision precision, const RunOptions& options);

  /// Times and counts of a run.
  struct Run {
    std::vector<double> ms;  // time of each move: its pass and its relaxation, without the time of other programs
    double grab_ms = 0;      // time of all grabs
    std::uint64_t checked = 0;
    std::uint64_t moved = 0;
    bool stopped = false;
  };
  /// Runs the moves. Cancelling takes effect within a pass of a method of elasticity, between passes of other
  /// algorithms, within sweeps, and between iterations; then it returns `stopped`.
  /// With `must_converge`, a drag ends at the first move of a method of elasticity that does not converge.
  Run run(const RecordedMoves& moves, Relaxing relaxing, const Progress& progress = {}, bool must_converge = false);

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
