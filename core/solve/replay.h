#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "solve/body.h"
#include "solve/trace.h"
#include "solve/waiting_list.h"

namespace chainmail {

/// One processed candidate of a pass, in the form that is kept for the next one.
struct Step {
  std::uint32_t element_and_moved;
  ElementId sponsor;
  std::uint32_t region;  // 12 bytes in all

  static constexpr std::uint32_t moved_bit = std::uint32_t{1} << 31;
  static_assert(element_limit < moved_bit);
  ElementId element() const { return element_and_moved & ~moved_bit; }
  bool has_moved() const { return (element_and_moved & moved_bit) != 0; }
  bool operator==(const Step&) const = default;
  void note(bool moved) { element_and_moved = element() | (moved ? moved_bit : 0); }
};

/// Number of steps by which positions are prefetched: about the latency of memory.
inline constexpr std::size_t fetched_ahead = 64;

/// Runs the steps of the last pass again, as long as each element moves, or stays, as it did then. Returns the number
/// of steps that agreed.
///
/// For one object, the next candidate depends only on which elements moved. So while the outcomes agree this is the
/// pass, without its waiting list. And since the steps are known in advance, their positions are prefetched from
/// memory.
template <class Scalar, int Dimension>
std::size_t replay(Body<Scalar, Dimension>& body, std::span<const Step> steps) {
  auto* positions = body.positions.data();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& later = steps[std::min(i + fetched_ahead, steps.size() - 1)];
    __builtin_prefetch(&positions[later.element()], 1);
    __builtin_prefetch(&body.regions.at(later.region));
    const Step& step = steps[i];
    const ElementId element = step.element();
    const auto next = body.clamped(element, step.sponsor, step.region);
    if ((next != positions[element]) != step.has_moved()) {
      return i;
    }
    positions[element] = next;
  }
  return steps.size();
}

/// The steps of the last pass of a waiting list, for the next one. A pass is replayed after two equal passes in a row.
/// From the first difference on, the list runs again, and the record only saves clamping.
class PassRecord {
 public:
  /// Replays a pass. Returns true if that was all of it. Otherwise the pass begins, and update() must be called for
  /// each candidate.
  template <class Body>
  bool begin(Body& body, ElementId grabbed, std::vector<ElementId>& moved) {
    agreed_ = trusts_ && grabbed == grabbed_ ? replay(body, std::span<const Step>(steps_)) : 0;
    if (agreed_ > 0 && agreed_ == steps_.size()) {
      return true;
    }
    trusts_ = grabbed == grabbed_;
    grabbed_ = grabbed;
    next_ = 0;
    moved.clear();
    return false;
  }

  /// Processes a candidate whose element has not been updated: clamps the element into its valid region about its
  /// sponsor. Returns true if it moved. The element counts as updated in either case (thesis 3.1).
  template <class Body>
  bool update(Body& body, Candidate candidate, std::vector<ElementId>& moved) {
    const ElementId element = body.mesh->neighbours[candidate.entry];
    const bool has_moved =
        next_ < agreed_ ? steps_[next_].has_moved() : body.clamp(element, candidate.sponsor, candidate.entry);
    body.mark_updated(element);
    note({element, candidate.sponsor, body.regions.id(candidate.entry)}, has_moved);
    if (has_moved) {
      moved.push_back(element);
    }
    return has_moved;
  }

  void end() {
    trusts_ = trusts_ && next_ == steps_.size();
    steps_.resize(next_);
  }

  std::span<const Step> steps() const { return steps_; }

  /// Call this when the links, the pins, the regions or `moved` were changed by others.
  void forget() { grabbed_ = no_element; }

 private:
  void note(Step step, bool has_moved) {
    step.note(has_moved);
    if (next_ == steps_.size()) {
      steps_.push_back(step);
      trusts_ = false;
    } else {
      trusts_ = trusts_ && steps_[next_] == step;
      steps_[next_] = step;
    }
    ++next_;
  }

  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::size_t agreed_ = 0;
  ElementId grabbed_ = no_element;
  bool trusts_ = false;  // the last two passes were equal
};

}  // namespace chainmail
