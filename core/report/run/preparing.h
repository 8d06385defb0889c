#pragma once

#include <map>

#include "report/run/physics.h"

namespace chainmail::report {

/// What preparing takes for an object and each element that a drag of it grabs.
class PreparingTimes {
 public:
  PreparingTimes() = default;
  /// Prepares several times, as long as a second lasts, and at least once. Throws Error where the method has no answer.
  PreparingTimes(const Case& object, ElasticMethod method);

  Preparation of(ElementId handle) const;

 private:
  std::vector<double> factorize_;
  std::map<ElementId, std::vector<double>> grab_;  // those that cannot be grabbed are missing
};

/// The elements that the drags of an object grab, each once, in their order.
std::vector<ElementId> handles_of(const Case& object);
/// The element that a drag grabs; 0 where it grabs none.
ElementId handle_of(const RecordedMoves& moves);
/// The links that a drag cuts.
std::vector<LinkId> cuts_of(const RecordedMoves& moves);

}  // namespace chainmail::report
