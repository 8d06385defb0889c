#pragma once

#include <map>

#include "elastic/elastic.h"
#include "measure/pass_times.h"
#include "report/run/runner.h"

namespace chainmail::report {

/// Times of the preparation of a contestant (ms), over some repetitions.
struct Preparation {
  TimeSpread factorize;  // once per object with its pins and cuts
  TimeSpread grab;       // once per handle: the response of the object to it

  double ms() const { return factorize.median + grab.median; }
};

/// Preparation is repeated for about a second, unless there is less time.
inline constexpr double enough_preparing = 1;

/// Times of a contestant to prepare for an object, and for each element that its drags grab.
class PreparingTimes {
 public:
  PreparingTimes() = default;
  /// Of a method of elasticity. Repeats the preparation for about so many seconds, and does it at least once. Throws
  /// Error if the method has no solution.
  PreparingTimes(const Case& object, Algorithm method, double seconds = enough_preparing,
                 const Clocks& clocks = machine_clocks());
  /// Of ChainMail, which prepares in the first move after a grab: a move that repeats the last one takes so much less.
  /// Between two handles it grabs another element, so that it keeps nothing of the last drag. Throws Error if the
  /// object does not fit the algorithm.
  PreparingTimes(const Case& object, Algorithm algorithm, bool equilibrium, double seconds, const RunOptions& options);

  Preparation of(ElementId handle) const;

 private:
  std::vector<double> factorize_;
  std::map<ElementId, std::vector<double>> grab_;  // ms; elements that cannot be grabbed are missing
};

/// Returns the elastic problem of an object with its pins at rest, with these links cut.
ElasticProblem elastic_problem(const Case& object, const std::vector<LinkId>& cut = {});
/// The same, with the material of the reference solution.
ElasticProblem reference_problem(const Case& object, const std::vector<LinkId>& cut = {});
/// Returns the elements that the drags of an object grab, each once, in their order.
std::vector<ElementId> handles_of(const Case& object);
/// Returns the element that a drag grabs, the first of many, or 0 if it grabs none.
ElementId handle_of(const RecordedMoves& moves);
/// Returns the elements of the first handle of a drag; element 0 if there is none.
std::vector<ElementId> grabbed_by(const RecordedMoves& moves);
/// Returns the links that a drag cuts.
std::vector<LinkId> cuts_of(const RecordedMoves& moves);

}  // namespace chainmail::report
