#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_view.h"
#include "body/method.h"
#include "chainmail/waiting_list.h"
#include "mesh/large_pages.h"

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
std::size_t replay(const BodyView<Scalar, Dimension>& body, std::span<const Step> steps) {
  auto* const positions = body.positions.data();
  const auto* const regions = body.regions.data();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& later = steps[std::min(i + fetched_ahead, steps.size() - 1)];
    __builtin_prefetch(&positions[later.element()], 1);
    __builtin_prefetch(&regions[later.region]);
    const Step& step = steps[i];
    const ElementId element = step.element();
    const Scalar* about = positions[step.sponsor].at;
    const auto next = clamped(positions[element], about, about, regions[step.region]);
    if ((next != positions[element]) != step.has_moved()) {
      return i;
    }
    positions[element] = next;
  }
  return steps.size();
}

/// What a pass may use of the last one.
enum class Replay {
  none,               // nothing: its order depends on positions
  whole,              // all of it, or else the pass runs from the beginning
  up_to_a_difference  // the pass goes on where the outcomes differ
};

/// The processed candidates of the last pass, for the next pass of the same handle. Or those of a pass that has not
/// happened: one that moves every element, for the first pass of a handle.
///
/// The next pass begins with a replay. Where that ends at a difference, an algorithm goes on from there (Natural
/// Queue), so that a replay never costs anything; or it runs its list again, and the record saves clamping up to there.
/// Such a replay has failed if it agrees for less than half of its steps. After two failures in a row, some passes are
/// not replayed: 1, then 2, 4, 8 and so on, until a replay succeeds.
class PassRecord {
 public:
  /// Begins a pass. Returns true if a replay was all of it. Otherwise the pass must run, from the beginning or from
  /// step agreed(), and end() must be called.
  template <class View>
  bool begin(View& body, std::span<const ElementId> handle, std::vector<ElementId>& moved, Replay uses) {
    make_room(body);
    if (uses == Replay::none) {
      handle_.clear();
    }
    const bool is_known = is_of(body, handle);
    agreed_ = is_known && unused_ == 0 ? replay(body, steps()) : 0;
    return end_replay(body, handle, moved, uses, is_known);
  }

  /// True if the steps are those of a pass of this handle on the body as it is.
  bool knows(const BodyLinks& body, std::span<const ElementId> handle) const {
    return count_ > 0 && is_of(body, handle);
  }

  /// Begins the record of a pass that has not happened. Its steps follow, by note() or in queue(), then end().
  void predict(const BodyLinks& body, std::span<const ElementId> handle);

  /// Number of steps that agreed, if the pass is not all replayed. They have been carried out.
  std::size_t agreed() const { return agreed_; }

  /// Processes a candidate whose element has not been updated: clamps the element into its valid region about its
  /// sponsor. Returns true if it moved. The element counts as updated in either case (thesis 3.1).
  template <class View>
  bool update(View& body, Candidate candidate, std::vector<ElementId>& moved) {
    const ElementId element = body.mesh->neighbours[candidate.entry];
    const bool has_moved =
        next_ < agreed_ ? steps_[next_].has_moved() : body.clamp(element, candidate.sponsor, candidate.entry);
    note(body, candidate, has_moved);
    if (has_moved) {
      moved.push_back(element);
    }
    return has_moved;
  }

  /// Adds a step. The element counts as updated.
  void note(const BodyLinks& body, Candidate candidate, bool has_moved) {
    const ElementId element = body.mesh->neighbours[candidate.entry];
    body.mark_updated(element);
    steps_[next_] = {element, candidate.sponsor, body.region_id(candidate.entry)};
    steps_[next_++].note(has_moved);
  }

  void end() { count_ = next_; }

  /// Takes memory for the steps of this body, if that has not been done.
  void make_room(const BodyLinks& body);

  /// The steps of the last pass.
  std::span<const Step> steps() const { return {steps_.get(), count_}; }
  /// Writes them as rows of a trace.
  void write(Trace& trace) const;

  /// For a pass whose queue is its record: the steps, with room for one more than there are elements; and the call at
  /// the end of the pass.
  Step* queue() { return steps_.get(); }
  void end(std::size_t count) { count_ = count; }

 private:
  bool is_of(const BodyLinks& body, std::span<const ElementId> handle) const;
  /// Ends the replay in begin(), or its omission.
  bool end_replay(const BodyLinks& body, std::span<const ElementId> handle, std::vector<ElementId>& moved, Replay uses,
                  bool is_known);

  static constexpr int max_failures = 8;  // at most 64 passes without a replay

  LargeArray<Step> steps_;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t agreed_ = 0;
  Revisions made_for_;
  std::vector<ElementId> handle_;  // of the last pass; empty before it
  bool is_predicted_ = false;      // the steps are of a pass that has not happened
  int failures_ = 0;               // replays in a row that failed
  int unused_ = 0;                 // number of coming passes that are not replayed
};

}  // namespace chainmail
