#pragma once

#include <span>
#include <vector>

#include "report/run/suite.h"

namespace chainmail::report {

/// A drag and the reference solution at its end.
struct TimedDrag {
  const RecordedMoves& moves;
  const ReferenceSolution& reference;
};

/// Measures time and error of each contestant in some drags, in the order of `suite_point_figures`: one of many moves,
/// one to the same end in one move, and perhaps one with a cut. A contestant that iterates runs with growing numbers of
/// iterations or sweeps per move; all numbers run in turns.
std::vector<SuiteTime> times_to_error(const Case& object, const std::vector<PhysicsContestant>& contestants,
                                      std::span<const TimedDrag> drags, const CompareOptions& options,
                                      const Progress& progress);

}  // namespace chainmail::report
