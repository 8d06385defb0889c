#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measure/distance.h"
#include "measure/pass_times.h"
#include "measure/violation.h"
#include "mesh/progress.h"
#include "report/run/cases.h"
#include "report/run/clocks.h"
#include "report/run/shape_figures.h"

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

/// An algorithm with the relaxation after each pass.
struct Contestant {
  Algorithm algorithm = Algorithm::natural_queue;
  int sweeps = 0;
  bool equilibrium = false;

  Relaxing relaxing() const { return {sweeps, equilibrium}; }
};
/// Returns the name of a contestant in a table: `Natural Queue ChainMail, 10 sweeps`, `Exact + equilibrium`.
std::string label(const Contestant& contestant);
/// Returns true if the algorithm also takes part with relaxation to the equilibrium.
bool takes_part_at_equilibrium(Algorithm algorithm);

struct CompareOptions {
  /// Algorithms to compare; empty: the ChainMail family, in the order of algorithms().
  std::vector<Algorithm> algorithms;
  std::vector<int> sweeps{0, 10};
  bool equilibrium = false;  // true: some algorithms also take part with the equilibrium after each move
  /// Scheme of the sweeps.
  RelaxationScheme scheme = RelaxationScheme::mean;
  double relax_step = 1;
  /// Precision of the contestants. The references are always in double.
  Precision precision = Precision::single_precision;
  /// Number of repetitions of each drag, without the warm-up; none: as many as fit in `seconds`, at least 5.
  std::optional<int> repetitions;
  /// Share of the way that ends the iterations of every contestant alike: the number of iterations per move is the
  /// least with which its answer at the end of a drag is so close to its own limit. 0: each stops by its own rule.
  double own_limit = 0;
  double seconds = 4;                // total time for the repetitions of one drag with all contestants
  Clocks clocks = machine_clocks();  // of everything but passes, which measure themselves
};

/// Throws Error if a number is out of its range.
void check(const CompareOptions& options);

/// Errors of a contestant, measured in double at the end of a drag.
struct Errors {
  Violation violation;
  /// Distance to Exact ChainMail without sweeps, run in double on the same commands from rest.
  std::optional<Distance> to_exact;
  std::optional<double> energy_over_exact;
  /// Distance between the contestant in float and in double.
  Distance float_to_double;
  std::optional<double> largest_over_handle;
  /// Distance to the end of full relaxation; none if that is not defined or not computed.
  std::optional<Distance> to_equilibrium;
  /// The reference of the Hausdorff distance is Exact ChainMail, as for `to_exact`.
  ShapeFigures shape;

  bool operator==(const Errors&) const = default;
};

/// Times and errors of a contestant on one drag.
struct Measurement {
  TimeSpread ms_per_move;     // time of a pass and its relaxation, over the repetitions
  double worst_move_ms = 0;   // time of the slowest move, by its median over the repetitions
  std::uint64_t checked = 0;  // number of checked elements in all moves
  std::uint64_t moved = 0;    // number of moved elements in all moves, without the handle
  Errors errors;
};

struct Entry {
  Contestant contestant;
  std::optional<Measurement> measurement;
  /// Reason why the contestant cannot take part; empty if there is a measurement.
  std::string refusal;
};

struct DragResult {
  std::string name;
  std::string description;
  int moves = 0;
  /// All contestants, in the same order for all drags.
  std::vector<Entry> entries;
  /// Reason why there are no distances to Exact ChainMail; empty if there are.
  std::string no_exact;
};

struct CaseResult {
  std::string name;
  std::string description;
  std::uint64_t elements = 0;
  std::uint64_t links = 0;  // number of uncut links
  std::vector<DragResult> drags;
};

struct Comparison {
  CompareOptions options;
  std::vector<CaseResult> cases;
  /// True if the comparison was stopped. Then it contains only the finished drags.
  bool stopped = false;
};

/// Runs the comparison on the calling thread. In each repetition, all contestants run the same recorded moves from
/// rest, one contestant after another. All figures except the times are the same on every machine.
/// The commands SetAlgorithm and SetRelaxation are ignored, because each contestant has its own; KeepState and
/// DropState are ignored too. Throws Error if a drag has no move, if it replaces the object (ReplaceMesh,
/// RestoreState), or if a number in the options is out of its range. A contestant that cannot run the moves is listed
/// with the reason.
///
/// `progress` receives a share between repetitions, and the names of the object and the drag as text. Cancelling takes
/// effect between passes, between sweeps and between iterations.
Comparison compare(const std::vector<Case>& cases, const CompareOptions& options, const Progress& progress = {});

}  // namespace chainmail::report
