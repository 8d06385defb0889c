#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solve/body_view.h"
#include "solve/exact_schedule.h"
#include "solve/trace.h"

namespace chainmail {

/// Target of the grabbed element, as bounds of displacements. On an axis along which it moves up, `low` is the target
/// and `high` is infinite. On an axis along which it moves down, `high` is the target and `low` is minus infinite. On
/// an axis along which it stays, both are infinite.
template <class Scalar, int Dimension>
struct HandleReach {
  static constexpr Scalar infinite = std::numeric_limits<Scalar>::infinity();

  HandleReach(const Position<Scalar, Dimension>& from, const Scalar* target) {
    for (int k = 0; k < Dimension; ++k) {
      start[k] = from[k];
      set(k, target[k]);
    }
  }

  void set(int k, Scalar target) {
    to[k] = target;
    low[k] = target > start[k] ? target : -infinite;
    high[k] = target < start[k] ? target : infinite;
  }

  /// Limits the reach of the handle by a pinned element, which has this region about the handle.
  void hold(const Position<Scalar, Dimension>& pin, const Region<Scalar, Dimension>& region) {
    for (int k = 0; k < Dimension; ++k) {
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
};

/// The region about the grabbed element in which each element may lie, for any state of the object. Its bounds are the
/// shortest paths of links from the handle, up and down along each axis; the length of a link is the bound of its
/// region.
///
/// A link is two difference constraints per axis. In a valid state the slacks along a path add up to the path's length
/// less the distance of its ends. So the shortest path depends on softness and links only, not on positions, and the
/// regions are valid for a whole drag. They are computed as the drag needs them: the neighbours of an element get
/// theirs once it moves (as candidates are admitted in every ChainMail), and no schedule changes a bit of them. The
/// derivation is this project's own.
///
/// The body stores displacements from rest. One search handles all axes.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class HandleRegions {
 public:
  using State = BodyView<Scalar, Dimension>;
  using Reach = HandleReach<Scalar, Dimension>;
  using Bounds = Region<Scalar, Dimension>;

  /// Drops all regions. Call this for a new handle, or when links, softness or pins have changed.
  void begin(const State& body, ElementId grabbed) {
    index_.resize(body.positions.size(), unknown);
    for (const ElementId element : elements_) {
      index_[element] = unknown;
    }
    elements_.clear();
    regions_.clear();
    searched_.clear();
    pins_.clear();
    frontier_.assign(1, add(grabbed));
    regions_.front() = {};
    searched_.front().state = waits;
    schedule_.begin_drag();
    visits_ = 0;
  }

  /// Computes the regions of all elements that a handle with this reach moves. Pins that it finds stop the handle.
  void extend(const State& body, Reach& reach) {
    for (const Pin& pin : pins_) {
      reach.hold(body.positions[pin.element], pin.region);
    }
    schedule_.begin();
    admit_frontier(body, reach);
    while (!schedule_.empty()) {
      const auto [key, index] = schedule_.take();
      Searched& one = searched_[index];
      if (one.state != queued || (one.key != key && !schedule_.keeps_position())) {
        continue;  // visited already, or admitted again with a smaller key
      }
      one.state = done;
      ++visits_;
      visit(body, reach, index);
      if constexpr (Schedule::adapts) {
        schedule_.visited(visits_, elements_.size(), [this](Index i) { return searched_[i].key; });
      }
    }
  }

  /// The elements with a region, the grabbed one first, and their regions.
  std::span<const ElementId> elements() const { return elements_; }
  std::span<const Bounds> regions() const { return regions_; }
  /// Returns the region of an element, or null if the drag has not come near it.
  const Bounds* find(ElementId element) const {
    return index_[element] == unknown ? nullptr : &regions_[index_[element]];
  }
  /// Number of visits of elements in this drag, on all axes together.
  std::uint64_t visits() const { return visits_; }

 private:
  using Index = std::uint32_t;  // in the order in which elements became known
  static constexpr Index unknown = no_element;
  enum SearchState : std::uint32_t { done, queued, waits };
  struct Searched {
    Scalar key = 0;  // the shortest path found since the last visit
    SearchState state = done;
  };
  struct Pin {
    ElementId element;
    Bounds region;
  };

  Index add(ElementId element) {
    const auto index = static_cast<Index>(elements_.size());
    index_[element] = index;
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

  void admit_frontier(const State& body, const Reach& reach) {
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

  void admit(Index index) {
    searched_[index].state = queued;
    schedule_.admit(index, searched_[index].key);
  }

  void visit(const State& body, Reach& reach, Index index) {
    const Bounds from = regions_[index];
    const bool has_pins = body.pin_count > 0;
    body.for_each_neighbour(elements_[index], [&](ElementId neighbour, EntryId entry) {
      const Bounds& link = body.regions[entry];
      Bounds through;
      for (int k = 0; k < Dimension; ++k) {
        through.low[k] = from.low[k] + link.low[k];
        through.high[k] = from.high[k] + link.high[k];
      }
      if (has_pins && body.pinned(neighbour)) {
        pins_.push_back({neighbour, through});
        reach.hold(body.positions[neighbour], through);
      } else {
        narrow(body, reach, neighbour, through);
      }
    });
  }

  void narrow(const State& body, const Reach& reach, ElementId element, const Bounds& through) {
    const Index index = index_[element] == unknown ? add(element) : index_[element];
    Bounds& region = regions_[index];
    Scalar key = Reach::infinite;
    for (int k = 0; k < Dimension; ++k) {
      if (through.low[k] > region.low[k]) {
        region.low[k] = through.low[k];
        key = std::min(key, -through.low[k]);
      }
      if (through.high[k] < region.high[k]) {
        region.high[k] = through.high[k];
        key = std::min(key, through.high[k]);
      }
    }
    if (key < Reach::infinite) {
      await(body, reach, index, key);
    }
  }

  /// Call this when an element's region became narrower. The regions of its neighbours may follow when it moves.
  void await(const State& body, const Reach& reach, Index index, Scalar key) {
    Searched& one = searched_[index];
    const bool is_smaller = one.state == done || key < one.key;
    one.key = is_smaller ? key : one.key;
    if (one.state == queued) {
      if (is_smaller && !schedule_.keeps_position()) {
        schedule_.admit(index, key);
      }
    } else if (moves(body, reach, index)) {
      admit(index);
    } else if (one.state == done) {
      one.state = waits;
      frontier_.push_back(index);
    }
  }

  std::vector<Index> index_;  // of each element; unknown if the drag has not come near it
  std::vector<ElementId> elements_;
  std::vector<Bounds> regions_;
  std::vector<Searched> searched_;
  std::vector<Index> frontier_;  // elements that wait until they move, and some that no longer wait
  std::vector<Pin> pins_;        // may contain duplicates
  Schedule schedule_;
  std::uint64_t visits_ = 0;
};

}  // namespace chainmail
