#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "measure/distance.h"
#include "measure/time_spread.h"
#include "measure/violation.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// An algorithm, and the sweeps of relaxation that follow each of its passes.
struct Contestant {
  Algorithm algorithm = Algorithm::natural_queue;
  int sweeps = 0;
};
/// How a contestant is called in a table: `Natural Queue ChainMail, 10 sweeps`.
std::string label(const Contestant& contestant);

struct CompareOptions {
  /// Every algorithm by default, in the order in which they are offered.
  std::vector<Algorithm> algorithms;
  std::vector<int> sweeps{0, 10};
  RelaxationScheme scheme = RelaxationScheme::mean;
  double relax_step = 1;
  /// That of the contestants; the references are in double always.
  Precision precision = Precision::single_precision;
  /// Of each drag, without the warm-up. By default as many as `seconds` hold, and 5 at least.
  std::optional<int> repetitions;
  double seconds = 4;  // to be spent on the repetitions of one drag, over all contestants
};

/// Throws Error where a number is out of its range.
void check(const CompareOptions& options);

/// What the speed of a contestant costs, measured in double at the end of a drag.
struct Errors {
  Violation violation;
  /// From Exact ChainMail without sweeps, run in double on the same commands from rest.
  std::optional<Distance> to_exact;
  std::optional<double> energy_over_exact;
  /// Of the contestant in float from the same one in double.
  Distance float_to_double;
  std::optional<double> largest_over_hand;
  /// From where full relaxation would end; none where that is not defined, or not computed.
  std::optional<Distance> to_equilibrium;

  bool operator==(const Errors&) const = default;
};

/// How a contestant did on one drag.
struct Measurement {
  TimeSpread ms_per_move;     // over the repetitions: a pass and its sweeps, as the thread ran
  double worst_move_ms = 0;   // of the moves, the one with the largest median over the repetitions
  std::uint64_t checked = 0;  // in all moves together
  std::uint64_t moved = 0;    // in all moves together; the hand's element does not count
  Errors errors;
};

struct Entry {
  Contestant contestant;
  std::optional<Measurement> measurement;
  /// Where there is no measurement: why the contestant cannot take part.
  std::string refusal;
};

struct DragResult {
  std::string name;
  std::string description;
  int moves = 0;
  /// Every contestant, in one order for all drags.
  std::vector<Entry> entries;
  /// Where the distances to Exact ChainMail are missing: why.
  std::string no_exact;
};

struct CaseResult {
  std::string name;
  std::string description;
  std::uint64_t elements = 0;
  std::uint64_t links = 0;  // without those that are cut
  std::vector<DragResult> drags;
};

struct Comparison {
  CompareOptions options;
  std::vector<CaseResult> cases;
  /// Whether it was stopped; then what it holds are the drags that were finished.
  bool stopped = false;
};

/// Told from the thread that compares, between repetitions: how much is done (0 to 1), and what is next.
using Progress = std::function<void(double fraction, const std::string& text)>;

/// The experiment: all contestants carry the same recorded moves out, each repetition from rest, in turns, on
/// the thread that calls. All figures but the times are the same on every machine.
///
/// Of the commands, SetAlgorithm and SetRelaxation are passed over (they are the contestants' own), and so are
/// KeepState and DropState. Throws Error where a drag holds no move, where it replaces the object
/// (ReplaceMesh, RestoreState), and where a number in the options is out of its range. A contestant that cannot
/// carry the moves out is listed with the reason.
///
/// `stop` is looked at between passes and between sweeps.
Comparison compare(const std::vector<Case>& cases, const CompareOptions& options, const Progress& progress = {},
                   const std::stop_token& stop = {});

}  // namespace chainmail::report
