#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "report/run/suite.h"

namespace chainmail::report {

/// Measures for each contestant the time until its relative error is below each of `suite_errors`. A contestant that
/// iterates runs with growing numbers of iterations or sweeps per move; all numbers run in turns. `drag` has many
/// moves, `one_move` goes to the same end in one.
std::vector<SuiteTime> times_to_error(const Case& object, const std::vector<PhysicsContestant>& contestants,
                                      const RecordedMoves& drag, const RecordedMoves& one_move,
                                      const ReferenceSolution& reference, const CompareOptions& options,
                                      const std::function<void(double)>& tell, const std::stop_token& stop);

}  // namespace chainmail::report
