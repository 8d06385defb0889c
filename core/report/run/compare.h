#pragma once

#include <functional>
#include <vector>

#include "report/run/contest.h"

namespace chainmail::report {

/// Options of a comparison: how contestants run, and who they are.
struct CompareOptions : ContestOptions {
  /// Algorithms to compare, in their order; empty: the ChainMail family, or all against physics.
  std::vector<Algorithm> algorithms = {};
  std::vector<int> sweeps{0, 10};  // of the ChainMail family, after each move
  bool equilibrium = false;        // true: some algorithms also take part with the equilibrium after each move
};

/// Throws Error if a number is out of its range.
void check(const CompareOptions& options);

/// Receives everything that is finished, drag by drag, on the thread that works.
using Finished = std::function<void(const Results&)>;

/// Compares the ChainMail family on the calling thread with Exact ChainMail in double, without sweeps and on the same
/// moves. In each repetition, all contestants run from rest, one after another. All figures except the times are the
/// same on every machine.
/// The commands SetAlgorithm and SetRelaxation are ignored, because each contestant has its own; KeepState and
/// DropState are ignored too. Throws Error if a drag has no move, if it replaces the object (ReplaceMesh,
/// RestoreState), or if a number in the options is out of its range. A contestant that cannot run the moves is listed
/// with the reason.
///
/// `progress` receives a share between repetitions, and the names of the object and the drag as text. Cancelling takes
/// effect between passes, between sweeps and between iterations; the finished drags stay.
Results compare(const std::vector<Case>& cases, const CompareOptions& options, const Progress& progress = {},
                const Finished& finished = {});

// For comparisons of all kinds.

/// Returns an object and a drag as a report lists them; the object without drags.
ObjectInfo info_of(const Case& object);
DragInfo info_of(const RecordedMoves& moves);
/// Returns the options that concern all contestants.
std::vector<Setting> settings_of(const RunOptions& options);
/// Adds a drag to the last object, and the rows of its contestants.
void add_drag(Results& results, DragInfo drag, std::vector<Row> rows);
/// Returns the progress of a part of a comparison, with its text.
Progress part_of(const Progress& whole, double index, double count, const std::string& text);

}  // namespace chainmail::report
