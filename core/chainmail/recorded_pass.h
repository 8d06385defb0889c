#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "body/method.h"
#include "body/softness.h"
#include "chainmail/waiting_list.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Everything except positions that a pass depends on.
struct PassConditions {
  Cuts cuts;
  std::vector<ElementId> pins;  // ascending
  std::shared_ptr<const Softness> softness;
};

/// One pass that can be replayed step by step. An element is updated at most once per pass, so the positions of all
/// elements before it and those of the updated elements after it give every state between. At step k the handle is
/// at its target, and the first k candidates of the trace have been taken.
struct RecordedPass {
  MeshPointer mesh;
  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t number = 0;       // index of the pass in its simulation, from 1
  std::uint64_t in_drag = 0;      // index of the pass in its drag, from 1
  std::vector<ElementId> handle;  // ascending
  std::shared_ptr<const PassConditions> conditions;
  /// Positions of all elements before the pass, space_dimension coordinates each (mesh units). They may be about
  /// another point than the origin, because an object far from it would lose digits.
  std::vector<float> before;
  Trace trace;
  /// Positions after the pass: the elements of the handle, then the element of each row of the trace (mesh units).
  std::vector<float> after;

  std::size_t step_count() const { return trace.size(); }
  /// Position of an element before the pass (mesh units).
  std::span<const float> position_before(ElementId element) const { return position(before, element); }
  /// Position of the element of a row after the pass.
  std::span<const float> position_after(std::size_t row) const { return position(after, handle.size() + row); }
  /// Position of element number i of the handle after the pass.
  std::span<const float> handle_after(std::size_t i) const { return position(after, i); }

 private:
  std::span<const float> position(const std::vector<float>& positions, std::size_t i) const {
    const auto coordinates = static_cast<std::size_t>(mesh->space_dimension);
    return std::span(positions).subspan(i * coordinates, coordinates);
  }
};

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
