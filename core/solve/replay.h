#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "solve/body.h"
#include "solve/trace.h"
#include "solve/waiting_list.h"

namespace chainmail {

/// One processed candidate of a pass, as it is kept for the next one.
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

/// Steps whose places are fetched before they are needed: about what a wait for memory takes.
inline constexpr std::size_t fetched_ahead = 64;

/// Carries out the steps of the last pass again, as long as each element moves, or stays, as it did then; returns
/// how many steps that were.
///
/// Which candidate comes next depends, but for the object's links, only on which elements moved. So while the
/// outcomes agree this is the pass, without its waiting list; and as the steps are known ahead, their places are
/// fetched from memory before they are needed.
template <class Scalar, int Dimension>
std::size_t replay(Body<Scalar, Dimension>& body, std::span<const Step> steps) {
  auto* places = body.places.data();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& later = steps[std::min(i + fetched_ahead, steps.size() - 1)];
    __builtin_prefetch(&places[later.element()], 1);
    __builtin_prefetch(&body.regions.at(later.region));
    const Step& step = steps[i];
    const ElementId element = step.element();
    const auto next = body.clamped(element, step.sponsor, step.region);
    if ((next != places[element]) != step.has_moved()) {
      return i;
    }
    places[element] = next;
  }
  return steps.size();
}

/// What the passes of one solver by a waiting list did, for the next one. A pass is replayed once two in a row
/// went the same way, and from where it turns out otherwise only what is known of it is taken over: the list has
/// to be worked through again.
class PassRecord {
 public:
  /// Replays a pass; says whether that was all of it. If not, it begins, and each update is to be asked for.
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

  /// Takes a candidate whose element has not been updated: clamps the element into its valid region about its
  /// sponsor, and says whether that moved it. Updated it is in either case (thesis 3.1).
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

  /// To be called where the links, the pins, the regions or `moved` were changed by others.
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
  bool trusts_ = false;  // the last pass went as the one before
};

}  // namespace chainmail
