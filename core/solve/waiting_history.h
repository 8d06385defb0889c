#pragma once

#include <cstdint>
#include <vector>

#include "solve/recorded_pass.h"

namespace chainmail {

/// A candidate of a pass, and how long it waited: at step k it is on the waiting list where entered <= k < left.
struct WaitingCandidate {
  ElementId element = 0;
  ElementId sponsor = 0;
  std::uint32_t entered = 0;
  std::uint32_t left = 0;
  bool dropped = false;  // when its turn came its element had been updated
};

/// What stood on the waiting list of a recorded pass at each of its steps.
///
/// It is the algorithm's own list, fed by the loop that every pass runs in; only whether an element moved is read from
/// the trace instead of computed. Of Exact ChainMail, which has no list, nothing is known, nor of a pass that
/// the list does not lead through.
class WaitingHistory {
 public:
  WaitingHistory() = default;
  explicit WaitingHistory(const RecordedPass& pass);

  bool known() const { return known_; }
  /// Every candidate that ever waited, in the order in which they entered.
  const std::vector<WaitingCandidate>& candidates() const { return candidates_; }
  /// Which of them wait at a step, the next one first. Time: the number of candidates.
  std::vector<std::uint32_t> at(std::size_t step) const;

 private:
  enum class Order { first_in, last_in, by_key };

  template <int Dimension>
  void follow(const RecordedPass& pass);
  void follow_natural_queue(const RecordedPass& pass);

  bool known_ = false;
  Order order_ = Order::first_in;
  std::vector<WaitingCandidate> candidates_;
  std::vector<double> keys_;  // of each, where the largest is taken first
};

}  // namespace chainmail
