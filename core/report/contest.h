#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "report/physics.h"

namespace chainmail::report {

/// Who takes part: the ChainMail family by all numbers of sweeps, the others without.
std::vector<Contestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps);

/// All contestants on one object, drag by drag. What they have prepared for the object and the element in the hand,
/// they keep.
class Contest {
 public:
  /// The object must outlive it. Who cannot take part is listed with the reason.
  Contest(const Case& object, const std::vector<Contestant>& contestants, const CompareOptions& options);
  ~Contest();

  /// A drag by all of them, against where the truth has it end.
  std::vector<PhysicsEntry> run(const RecordedMoves& moves, const Truth& truth, const std::function<void(double)>& tell,
                                const std::stop_token& stop);

 private:
  class Participant;

  CompareOptions options_;
  std::vector<std::unique_ptr<Participant>> participants_;
};

}  // namespace chainmail::report
