#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "report/run/physics.h"
#include "report/run/preparing.h"

namespace chainmail::report {

/// What a contest measures.
enum class Measured {
  times_and_errors,
  errors  // no preparation is timed, and no drag is repeated
};

/// Runs all contestants on one object, drag by drag. Each contestant keeps its preparation for the object and for a
/// handle.
class Contest {
 public:
  /// The object must outlive the contest. A contestant that cannot take part is listed with the reason.
  Contest(const Case& object, const std::vector<PhysicsContestant>& contestants, const CompareOptions& options,
          Measured measured = Measured::times_and_errors);
  ~Contest();

  /// Runs a drag with all contestants, and compares them with the reference solution at its end.
  std::vector<PhysicsEntry> run(const RecordedMoves& moves, const ReferenceSolution& reference,
                                const Progress& progress);

 private:
  class Participant;
  /// Times of preparation. Contestants that differ in their iterations or sweeps share them.
  using Preparations = std::vector<std::pair<PhysicsContestant, PreparingTimes>>;

  CompareOptions options_;
  Measured measured_;
  Preparations preparations_;
  std::vector<std::unique_ptr<Participant>> participants_;
};

}  // namespace chainmail::report
