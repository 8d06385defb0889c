#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "body/body_view.h"
#include "body/positions.h"
#include "body/region.h"
#include "chainmail/replay.h"
#include "mesh/large_pages.h"

namespace chainmail {

/// Target of the handle, as bounds of displacements. On an axis along which it moves up, `low` is the target and `high`
/// is infinite. On an axis along which it moves down, `high` is the target and `low` is minus infinite. On an axis
/// along which it stays, both are infinite. A handle that has rotated moves its elements both ways: then both are the
/// target.
///
/// A handle of one element is at the displacement of that element. Of a handle of many, each element is at the
/// handle's displacement plus an offset of its own.
template <class Scalar, int Dimension>
struct HandleReach {
  static constexpr Scalar infinite = std::numeric_limits<Scalar>::infinity();

  HandleReach(const Position<Scalar, Dimension>& from, const Scalar* target) {
    for (int k = 0; k < Dimension; ++k) {
      start[k] = from[k];
      set(k, target[k]);
    }
  }
  /// The reach of a handle that has rotated and is at a displacement.
  explicit HandleReach(const Position<Scalar, Dimension>& at) {
    for (int k = 0; k < Dimension; ++k) {
      start[k] = to[k] = low[k] = high[k] = at[k];
    }
  }

  /// A reach for which every element moves, and that no pin stops.
  static HandleReach everywhere() {
    HandleReach reach{Position<Scalar, Dimension>{}};
    std::fill_n(reach.low, Dimension, std::numeric_limits<Scalar>::max());
    std::fill_n(reach.high, Dimension, std::numeric_limits<Scalar>::lowest());
    reach.is_everywhere = true;
    return reach;
  }

  void set(int k, Scalar target) {
    to[k] = target;
    low[k] = target > start[k] ? target : -infinite;
    high[k] = target < start[k] ? target : infinite;
  }

  /// Limits the reach of the handle by a pinned element, which has this region about the handle.
  void hold(const Position<Scalar, Dimension>& pin, const Region<Scalar, Dimension>& region) {
    for (int k = 0; k < Dimension && !is_everywhere; ++k) {
      const Scalar furthest = std::max(start[k], pin[k] - region.low[k]);
      const Scalar lowest = std::min(start[k], pin[k] - region.high[k]);
      if (low[k] > furthest || high[k] < lowest) {
        set(k, low[k] > furthest ? furthest : lowest);
        stopped[k] = true;
      }
    }
  }

  Scalar start[Dimension], to[Dimension];
  Scalar low[Dimension], high[Dimension];
  bool stopped[Dimension]{};
  bool is_everywhere = false;
};

/// What all partitions of a search for regions have in common.
template <class Scalar, int Dimension>
struct RegionSearch {
  static constexpr std::uint32_t unknown = no_element;

  /// The partition that searches for the region of an element: stripes of ids take turns, since a front is in a few of
  /// them at a time.
  std::size_t partition_of(ElementId element) const { return (element >> stripe) & (partition_count - 1); }
  bool in_handle(ElementId element) const { return std::ranges::binary_search(handle, element); }

  std::size_t partition_count = 1;   // a power of two
  int stripe = 31;                   // the logarithm of the number of ids in one
  LargeVector<std::uint32_t> index;  // of each element in its partition; unknown if the drag has not come near it
  std::vector<ElementId> handle;     // ascending
  Scalar least[Dimension]{}, most[Dimension]{};  // offsets of the handle's elements, 0 for one element
};

/// The part of the elements whose regions about the handle one thread computes: see HandleRegions.
///
/// A partition reads and writes only what belongs to its own elements. What it finds out about others goes into
/// messages, which their partitions read in the next round.
template <class Scalar, int Dimension, class Schedule>
class alignas(64) RegionPartition {
 public:
  using State = BodyView<Scalar, Dimension>;
  using Reach = HandleReach<Scalar, Dimension>;
  using Bounds = Region<Scalar, Dimension>;
  using Offset = Position<Scalar, Dimension>;
  using Search = RegionSearch<Scalar, Dimension>;
  using Index = std::uint32_t;  // in the order in which elements became known

  struct Pin {
    ElementId element;
    Bounds region;
  };

  /// Drops all regions.
  [[gnu::noinline]] void clear(Search& search) {
    for (const ElementId element : elements_) {
      search.index[element] = Search::unknown;
    }
    elements_.clear();
    regions_.clear();
    searched_.clear();
    pins_.clear();
    frontier_.clear();
    handle_size_ = 0;
    visits_ = 0;
    schedule_.begin_drag();
    for (auto& of_round : messages_) {
      for (auto& messages : of_round) {
        messages.clear();  // a search that was cancelled may have left some
      }
    }
  }

  void set_number(std::size_t number, std::size_t partition_count) {
    number_ = number;
    messages_[0].resize(partition_count);
    messages_[1].resize(partition_count);
  }

  /// Adds an element of the handle. Call this before all others become known.
  [[gnu::noinline]] void add_to_handle(Search& search, ElementId element, const Offset& offset) {
    frontier_.push_back(add(search, element));
    std::copy_n(offset.at, Dimension, regions_.back().low);
    std::copy_n(offset.at, Dimension, regions_.back().high);
    Searched& one = searched_.back();
    one.state = waits;
    one.key = Reach::infinite;
    for (int k = 0; k < Dimension; ++k) {
      one.key = std::min({one.key, offset[k] - search.least[k], search.most[k] - offset[k]});
    }
    ++handle_size_;
  }

  /// Begins a pass: admits the elements that now move.
  [[gnu::noinline]] void begin(const State& body, const Reach& reach) {
    schedule_.begin();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < frontier_.size(); ++i) {
      const Index index = frontier_[i];
      if (searched_[index].state != waits) {
        continue;
      }
      if (moves(body, reach, index)) {
        admit(index);
      } else {
        frontier_[kept++] = index;
      }
    }
    frontier_.resize(kept);
  }

  /// The search of a single partition, which lets pins that it finds stop the handle.
  template <class Adapt>
  void run(Search& search, const State& body, Reach& reach, Adapt adapt) {
    while (!schedule_.empty()) {
      if (visit_next<true>(search, body, reach, 0)) {
        adapt(*this);
      }
    }
  }

  /// One round of one of several partitions: reads the messages that the others wrote in the last round, then visits
  /// the elements of this one. There are no pins.
  [[gnu::noinline]] void run_round(Search& search, const State& body, Reach& reach,
                                   std::span<RegionPartition> partitions, std::uint64_t round) {
    for (RegionPartition& other : partitions) {
      auto& messages = other.messages_[(round + 1) % 2][number_];
      for (const Message& message : messages) {
        narrow(search, body, reach, message.element, message.through);
      }
      messages.clear();
    }
    while (schedule_.in_round()) {
      visit_next<false>(search, body, reach, round % 2);
    }
  }
  /// True if every element, and all of the handle, moves.
  [[gnu::noinline]] bool moves_all(const State& body, const Reach& reach) const {
    for (Index i = 0; i < elements_.size(); ++i) {
      __builtin_prefetch(&body.positions[elements_[std::min<std::size_t>(i + fetched_ahead, elements_.size() - 1)]]);
      if (!moves(body, reach, i)) {
        return false;
      }
    }
    return true;
  }

  bool has_messages() const {
    for (const auto& of_round : messages_) {
      for (const auto& messages : of_round) {
        if (!messages.empty()) {
          return true;
        }
      }
    }
    return false;
  }

  /// Goes on in the order of keys: see AdaptiveSchedule.
  [[gnu::noinline]] void adapt(Scalar width) {
    schedule_.adapt(width, [this](Index i) { return searched_[i].key; });
  }

  /// The elements with a region, those of the handle first, and their regions.
  std::span<const ElementId> elements() const { return elements_; }
  std::span<const Bounds> regions() const { return regions_; }
  /// Number of the first elements that are the handle's.
  std::size_t handle_size() const { return handle_size_; }
  std::span<const Pin> pins() const { return pins_; }  // may contain duplicates
  Schedule& schedule() { return schedule_; }
  /// Number of visits of elements in this drag, on all axes together.
  std::uint64_t visits() const { return visits_; }

 private:
  enum SearchState : std::uint32_t { done, queued, waits };
  struct Searched {
    Scalar key = 0;  // the shortest path found since the last visit
    SearchState state = done;
  };
  /// An element of another partition may lie in this region at most.
  struct Message {
    ElementId element;
    Bounds through;
  };

  Index add(Search& search, ElementId element) {
    const auto index = static_cast<Index>(elements_.size());
    search.index[element] = index;
    elements_.push_back(element);
    Bounds anywhere;
    std::fill_n(anywhere.low, Dimension, -Reach::infinite);
    std::fill_n(anywhere.high, Dimension, Reach::infinite);
    regions_.push_back(anywhere);
    searched_.emplace_back();
    return index;
  }

  bool moves(const State& body, const Reach& reach, Index index) const {
    const auto& position = body.positions[elements_[index]];
    const Bounds& region = regions_[index];
    bool moves = false;
    for (int k = 0; k < Dimension; ++k) {
      moves |= reach.low[k] + region.low[k] > position[k] || reach.high[k] + region.high[k] < position[k];
    }
    return moves;
  }

  void admit(Index index) {
    searched_[index].state = queued;
    schedule_.admit(index, searched_[index].key);
  }

  /// Visits the next element, unless it was visited already. Returns true if so.
  template <bool IsAlone>
  bool visit_next(Search& search, const State& body, Reach& reach, std::size_t messages) {
    const Index index = schedule_.take();
    if (searched_[index].state != queued) {
      return false;
    }
    searched_[index].state = done;
    ++visits_;
    visit<IsAlone>(search, body, reach, index, messages);
    return true;
  }

  template <bool IsAlone>
  void visit(Search& search, const State& body, Reach& reach, Index index, std::size_t messages) {
    const Bounds from = regions_[index];
    const bool has_pins = body.pin_count > 0, has_inner_links = search.handle.size() > 1 && index < handle_size_;
    body.for_each_link(elements_[index], [&](ElementId neighbour, std::uint32_t id) {
      if (has_inner_links && search.in_handle(neighbour)) {
        return;
      }
      const Bounds& link = body.regions.at(id);
      Bounds through;
      for (int k = 0; k < Dimension; ++k) {
        through.low[k] = from.low[k] + link.low[k];
        through.high[k] = from.high[k] + link.high[k];
      }
      if (has_pins && body.pinned(neighbour)) {
        pins_.push_back({neighbour, through});
        reach.hold(body.positions[neighbour], through);
        return;
      }
      if (const std::size_t to = IsAlone ? number_ : search.partition_of(neighbour); to == number_) {
        narrow(search, body, reach, neighbour, through);
      } else {
        write(messages_[messages][to], {neighbour, through});
      }
    });
  }

  [[gnu::noinline]] static void write(std::vector<Message>& messages, const Message& message) {
    messages.push_back(message);
  }

  [[gnu::always_inline]] void narrow(Search& search, const State& body, const Reach& reach, ElementId element,
                                     const Bounds& through) {
    const Index known = search.index[element];
    const Index index = known == Search::unknown ? add(search, element) : known;
    Bounds& region = regions_[index];
    // Without branches for each side: which of them become narrower cannot be predicted.
    Bounds both;
    Scalar key = Reach::infinite;
    for (int k = 0; k < Dimension; ++k) {
      both.low[k] = std::max(region.low[k], through.low[k]);
      both.high[k] = std::min(region.high[k], through.high[k]);
      key = std::min(key, through.low[k] > region.low[k] ? search.most[k] - through.low[k] : Reach::infinite);
      key = std::min(key, through.high[k] < region.high[k] ? through.high[k] - search.least[k] : Reach::infinite);
    }
    if (key < Reach::infinite) {
      region = both;
      await(body, reach, index, key);
    }
  }

  /// Call this when an element's region became narrower. The regions of its neighbours may follow when it moves.
  void await(const State& body, const Reach& reach, Index index, Scalar key) {
    Searched& one = searched_[index];
    const Scalar before = one.state == done ? Reach::infinite : one.key;
    one.key = std::min(before, key);
    if (one.state == queued) {
      if (key < before && !schedule_.keeps_position() && schedule_.number(key) < schedule_.number(before)) {
        schedule_.admit(index, key);
      }
    } else if (moves(body, reach, index)) {
      admit(index);
    } else if (one.state == done) {
      one.state = waits;
      frontier_.push_back(index);
    }
  }

  std::size_t number_ = 0;
  LargeVector<ElementId> elements_;
  LargeVector<Bounds> regions_;
  LargeVector<Searched> searched_;
  std::vector<Index> frontier_;  // elements that wait until they move, and some that no longer wait
  std::vector<Pin> pins_;
  std::size_t handle_size_ = 0;
  Schedule schedule_;
  std::uint64_t visits_ = 0;
  std::vector<std::vector<Message>> messages_[2];  // of the even rounds and of the odd ones, to each partition
};

}  // namespace chainmail
