#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "chainmail/recorded_pass.h"
#include "chainmail/waiting_list.h"

namespace chainmail {

/// A candidate of a pass, and how long it waited: at step k it is on the waiting list if entered <= k < left.
struct WaitingCandidate {
  ElementId element = 0;
  ElementId sponsor = 0;
  std::uint32_t entered = 0;
  std::uint32_t left = 0;
  bool dropped = false;  // its element had been updated when its turn came
};

/// The waiting list of a recorded pass at each of its steps.
///
/// The algorithm's own list is fed by the common loop of a pass. The only difference is that the trace, not a
/// computation, says whether an element moved. The history of a pass is unknown if its algorithm has no list (Exact
/// ChainMail), or if the list does not lead to the pass.
class WaitingHistory {
 public:
  /// Creates an unknown history.
  WaitingHistory() = default;

  /// Creates a known history. `keys`, one per candidate, are used for TakingOrder::by_key only.
  WaitingHistory(TakingOrder order, std::vector<WaitingCandidate> candidates, std::vector<double> keys)
      : known_(true), order_(order), candidates_(std::move(candidates)), keys_(std::move(keys)) {}
  bool known() const { return known_; }
  /// Every candidate that ever waited, in the order in which they entered.
  const std::vector<WaitingCandidate>& candidates() const { return candidates_; }

  /// Returns the indices of the candidates that wait at a step, the next one first. Takes time in proportion to the
  /// number of candidates.
  std::vector<std::uint32_t> at(std::size_t step) const;

 private:
  bool known_ = false;
  TakingOrder order_ = TakingOrder::first_in;
  std::vector<WaitingCandidate> candidates_;
  std::vector<double> keys_;  // the candidate with the largest key is taken first
};

}  // namespace chainmail
