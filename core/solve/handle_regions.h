#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "mesh/large_pages.h"
#include "solve/body_view.h"
#include "solve/exact_schedule.h"
#include "solve/trace.h"

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

/// The region about the handle in which each element may lie, for any state of the object. Its bounds are the shortest
/// paths of links from the handle, up and down along each axis; the length of a link is the bound of its region. A path
/// from an element of a handle of many begins at its offset. Links inside the handle are part of no path: the handle is
/// rigid, and holds their ends itself.
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

  using Offset = Position<Scalar, Dimension>;

  /// Drops all regions. Call this for a new handle, when offsets or links, softness or pins have changed. A handle of
  /// one element has no offsets; one of many has an offset for each element.
  void begin(const State& body, std::span<const ElementId> handle, std::span<const Offset> offsets) {
    index_.resize(body.positions.size(), unknown);
    for (const ElementId element : elements_) {
      index_[element] = unknown;
    }
    elements_.clear();
    regions_.clear();
    searched_.clear();
    pins_.clear();
    frontier_.clear();
    handle_size_ = static_cast<Index>(handle.size());
    for (const ElementId element : handle) {
      frontier_.push_back(add(element));
      regions_.back() = {};
      searched_.back().state = waits;
    }
    set_offsets(offsets);
    schedule_.begin_drag();
    visits_ = 0;
  }

  /// True if every element and every pin can lie in its region while the handle is at a displacement, up to a
  /// tolerance (mesh units). False if the handle has rotated so far that it contradicts itself.
  bool agree(const State& body, const Offset& handle, Scalar tolerance) const {
    bool agree = true;
    for (const Bounds& region : regions_) {
      for (int k = 0; k < Dimension; ++k) {
        agree &= region.low[k] <= region.high[k] + tolerance;
      }
    }
    for (const Pin& pin : pins_) {
      for (int k = 0; k < Dimension; ++k) {
        const Scalar at = body.positions[pin.element][k] - handle[k];
        agree &= pin.region.low[k] <= at + tolerance && at <= pin.region.high[k] + tolerance;
      }
    }
    return agree;
  }

  /// Moves the displacement of a handle, on each axis, as little as the known pins require. Returns true if it moved.
  bool hold(const State& body, Offset& handle) const {
    const Offset before = handle;
    for (const Pin& pin : pins_) {
      for (int k = 0; k < Dimension; ++k) {
        const Scalar at = body.positions[pin.element][k];
        handle[k] = std::min(std::max(handle[k], at - pin.region.high[k]), at - pin.region.low[k]);
      }
    }
    return handle != before;
  }

  /// Computes the regions of all elements that a handle with this reach moves. Pins that it finds stop the handle.
  void extend(const State& body, Reach& reach) {
    for (const Pin& pin : pins_) {
      reach.hold(body.positions[pin.element], pin.region);
    }
    schedule_.begin();
    admit_frontier(body, reach);
    while (!schedule_.empty()) {
      const Index index = schedule_.take();
      Searched& one = searched_[index];
      if (one.state != queued) {
        continue;  // visited already, from a lower bucket
      }
      one.state = done;
      ++visits_;
      visit(body, reach, index);
      if constexpr (Schedule::adapts) {
        if (schedule_.must_adapt(visits_, elements_.size())) {
          schedule_.adapt(bucket_width(body), [this](Index i) { return searched_[i].key; });
        }
      }
    }
  }

  /// The elements with a region, those of the handle first, and their regions.
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

  /// Sets the regions of the handle's elements: the offsets themselves. Keys are paths from the extreme offsets, so
  /// that none is below 0.
  void set_offsets(std::span<const Offset> offsets) {
    for (int k = 0; k < Dimension; ++k) {
      const auto of_axis = [k](const Offset& one) { return one[k]; };
      least_[k] = offsets.empty() ? Scalar{0} : of_axis(*std::ranges::min_element(offsets, {}, of_axis));
      most_[k] = offsets.empty() ? Scalar{0} : of_axis(*std::ranges::max_element(offsets, {}, of_axis));
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      std::copy_n(offsets[i].at, Dimension, regions_[i].low);
      std::copy_n(offsets[i].at, Dimension, regions_[i].high);
      searched_[i].key = Reach::infinite;
      for (int k = 0; k < Dimension; ++k) {
        searched_[i].key = std::min({searched_[i].key, offsets[i][k] - least_[k], most_[k] - offsets[i][k]});
      }
    }
  }

  /// Returns the width of buckets in which few elements are visited again: a share of the mean length of the links of
  /// some known elements.
  Scalar bucket_width(const State& body) const {
    double sum = 0;
    std::size_t count = 0;
    const std::size_t step = elements_.size() / sampled_elements + 1;
    for (std::size_t i = 0; i < elements_.size(); i += step) {
      body.for_each_neighbour(elements_[i], [&](ElementId, EntryId entry) {
        const Bounds& link = body.regions[entry];
        for (int k = 0; k < Dimension; ++k) {
          sum += double(link.high[k]) - double(link.low[k]);
        }
        count += 2 * Dimension;
      });
    }
    const auto width = static_cast<Scalar>(width_in_links * sum / double(std::max<std::size_t>(1, count)));
    return width > 0 ? width : Scalar{1};
  }

  bool in_handle(ElementId element) const { return index_[element] < handle_size_; }

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
    const bool has_pins = body.pin_count > 0, has_inner_links = handle_size_ > 1 && index < handle_size_;
    body.for_each_link(elements_[index], [&](ElementId neighbour, std::uint32_t id) {
      if (has_inner_links && in_handle(neighbour)) {
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
      } else {
        narrow(body, reach, neighbour, through);
      }
    });
  }

  void narrow(const State& body, const Reach& reach, ElementId element, const Bounds& through) {
    const Index index = index_[element] == unknown ? add(element) : index_[element];
    Bounds& region = regions_[index];
    // Without branches for each side: which of them become narrower cannot be predicted.
    Bounds both;
    Scalar key = Reach::infinite;
    for (int k = 0; k < Dimension; ++k) {
      both.low[k] = std::max(region.low[k], through.low[k]);
      both.high[k] = std::min(region.high[k], through.high[k]);
      key = std::min(key, through.low[k] > region.low[k] ? most_[k] - through.low[k] : Reach::infinite);
      key = std::min(key, through.high[k] < region.high[k] ? through.high[k] - least_[k] : Reach::infinite);
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

  static constexpr std::size_t sampled_elements = 256;
  static constexpr double width_in_links = 0.05;  // measured by bench_passes

  LargeVector<Index> index_;  // of each element; unknown if the drag has not come near it
  LargeVector<ElementId> elements_;
  LargeVector<Bounds> regions_;
  LargeVector<Searched> searched_;
  std::vector<Index> frontier_;  // elements that wait until they move, and some that no longer wait
  std::vector<Pin> pins_;        // may contain duplicates
  Index handle_size_ = 0;
  Scalar least_[Dimension]{}, most_[Dimension]{};  // offsets of the handle's elements, 0 for one element
  Schedule schedule_;
  std::uint64_t visits_ = 0;
};

}  // namespace chainmail
