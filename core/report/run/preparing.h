#pragma once

#include <map>

#include "report/run/physics.h"

namespace chainmail::report {

/// Times to prepare a method of elasticity for an object, and for each element that its drags grab.
class PreparingTimes {
 public:
  PreparingTimes() = default;
  /// Repeats the preparation for about a second, and does it at least once. Throws Error if the method has no solution.
  PreparingTimes(const Case& object, ElasticMethod method, const Clocks& clocks = machine_clocks());

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
