#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <vector>

#include "exact/exact_schedule.h"
#include "exact/region_partition.h"
#include "exact/thread_team.h"
#include "mesh/progress.h"

namespace chainmail {

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
/// So threads may search too. Each has a partition of the elements; they work in rounds, in which no partition reads
/// what another one writes. Pins that are found stop the handle while the search goes on, and then the order matters
/// for which elements become known: an object with pins has one partition.
///
/// The body stores displacements from rest. One search handles all axes.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class HandleRegions {
 public:
  using State = BodyView<Scalar, Dimension>;
  using Reach = HandleReach<Scalar, Dimension>;
  using Bounds = Region<Scalar, Dimension>;
  using Offset = Position<Scalar, Dimension>;
  using Partition = RegionPartition<Scalar, Dimension, Schedule>;

  /// Drops all regions. Call this for a new handle, when offsets or links, softness or pins have changed. A handle of
  /// one element has no offsets; one of many has an offset for each element. The search will use `threads` at most.
  [[gnu::noinline]] void begin(const State& body, std::span<const ElementId> handle, std::span<const Offset> offsets,
                               int threads = 1) {
    search_.index.resize(body.positions.size(), Search::unknown);
    for (Partition& partition : partitions_) {
      partition.clear(search_);
    }
    divide(body, threads);
    search_.handle.assign(handle.begin(), handle.end());
    for (int k = 0; k < Dimension; ++k) {
      search_.least[k] = search_.most[k] = offsets.empty() ? Scalar{0} : offsets[0][k];
      for (const Offset& one : offsets) {
        search_.least[k] = std::min(search_.least[k], one[k]);
        search_.most[k] = std::max(search_.most[k], one[k]);
      }
    }
    for (std::size_t i = 0; i < handle.size(); ++i) {
      partitions_[search_.partition_of(handle[i])].add_to_handle(search_, handle[i],
                                                                 offsets.empty() ? Offset{} : offsets[i]);
    }
  }

  /// True if every element and every pin can lie in its region while the handle is at a displacement, up to a
  /// tolerance (mesh units). False if the handle has rotated so far that it contradicts itself.
  [[gnu::noinline]] bool agree(const State& body, const Offset& handle, Scalar tolerance) const {
    bool agree = true;
    for (const Partition& partition : partitions_) {
      for (const Bounds& region : partition.regions()) {
        for (int k = 0; k < Dimension; ++k) {
          agree &= region.low[k] <= region.high[k] + tolerance;
        }
      }
      for (const auto& pin : partition.pins()) {
        for (int k = 0; k < Dimension; ++k) {
          const Scalar at = body.positions[pin.element][k] - handle[k];
          agree &= pin.region.low[k] <= at + tolerance && at <= pin.region.high[k] + tolerance;
        }
      }
    }
    return agree;
  }

  /// Moves the displacement of a handle, on each axis, as little as the known pins require. Returns true if it moved.
  [[gnu::noinline]] bool hold(const State& body, Offset& handle) const {
    const Offset before = handle;
    for (const Partition& partition : partitions_) {
      for (const auto& pin : partition.pins()) {
        for (int k = 0; k < Dimension; ++k) {
          const Scalar at = body.positions[pin.element][k];
          handle[k] = std::min(std::max(handle[k], at - pin.region.high[k]), at - pin.region.low[k]);
        }
      }
    }
    return handle != before;
  }

  [[gnu::noinline]] void swap(HandleRegions& other) { std::swap(*this, other); }

  /// Computes the regions of all elements, before it is known where the handle goes.
  void extend_everywhere(const State& body, ThreadTeam& team, const Progress& progress) {
    Reach reach = Reach::everywhere();
    extend(body, reach, team, progress);
  }

  /// True if a handle with this reach moves all elements that have a region, and no pin stops it: then the search would
  /// have found just these regions.
  [[gnu::noinline]] bool moves_all(const State& body, const Reach& reach) const {
    Reach held = reach;
    for (const Partition& partition : partitions_) {
      for (const auto& pin : partition.pins()) {
        held.hold(body.positions[pin.element], pin.region);
      }
    }
    bool moves = std::find(held.stopped, held.stopped + Dimension, true) == held.stopped + Dimension;
    for (const Partition& partition : partitions_) {
      moves = moves && partition.moves_all(body, reach);
    }
    return moves;
  }

  /// Computes the regions of all elements that a handle with this reach moves. Pins that it finds stop the handle.
  [[gnu::noinline]] void extend(const State& body, Reach& reach, ThreadTeam& team, const Progress& progress = {}) {
    for (const Partition& partition : partitions_) {
      for (const auto& pin : partition.pins()) {
        reach.hold(body.positions[pin.element], pin.region);
      }
    }
    for (Partition& partition : partitions_) {
      partition.begin(body, reach);
    }
    if constexpr (Schedule::has_rounds) {
      if (partitions_.size() > 1) {
        extend_in_rounds(body, reach, team, progress);
        return;
      }
    }
    partitions_.front().run(search_, body, reach, [&](Partition& partition) {
      progress.report(partition.visits(), body.positions.size());
      if constexpr (Schedule::adapts) {
        if (partition.schedule().must_adapt(partition.visits(), partition.elements().size())) {
          partition.adapt(bucket_width(body));
        }
      }
    });
  }

  std::span<const Partition> partitions() const { return partitions_; }
  std::span<const ElementId> handle() const { return search_.handle; }  // ascending
  /// Number of elements with a region.
  std::size_t known() const {
    std::size_t known = 0;
    for (const Partition& partition : partitions_) {
      known += partition.elements().size();
    }
    return known;
  }
  /// Returns the region of an element, or null if the drag has not come near it.
  const Bounds* find(ElementId element) const {
    const auto index = search_.index[element];
    return index == Search::unknown ? nullptr : &partitions_[search_.partition_of(element)].regions()[index];
  }
  /// Number of visits of elements in this drag, on all axes together.
  std::uint64_t visits() const {
    std::uint64_t visits = 0;
    for (const Partition& partition : partitions_) {
      visits += partition.visits();
    }
    return visits;
  }

 private:
  using Search = typename Partition::Search;

  /// Divides the elements into partitions, if that can pay.
  [[gnu::cold]] void divide(const BodyLinks& body, int threads) {
    const std::size_t elements = body.element_count();
    bool divides = false;
    if constexpr (Schedule::has_rounds) {
      divides = threads > 1 && body.pin_count == 0 && elements >= Schedule::min_to_share;
    }
    search_.partition_count = divides ? std::bit_ceil(static_cast<unsigned>(std::min(threads, max_partitions))) : 1;
    const std::size_t stripes = std::max<std::size_t>(32, 8 * search_.partition_count);
    search_.stripe = divides ? std::bit_width(std::max<std::size_t>(1, elements / stripes)) - 1 : 31;
    if (partitions_.size() != search_.partition_count) {
      partitions_ = std::vector<Partition>(search_.partition_count);
      for (std::size_t i = 0; i < partitions_.size(); ++i) {
        partitions_[i].set_number(i, partitions_.size());
      }
    }
  }

  [[gnu::noinline]] void extend_in_rounds(const State& body, Reach& reach, ThreadTeam& team, const Progress& progress) {
    for (;;) {
      progress.report(0);
      std::size_t waiting = 0;
      auto lowest = std::numeric_limits<typename Schedule::Number>::max();
      bool has_messages = false;
      for (Partition& partition : partitions_) {
        waiting += partition.schedule().size();
        has_messages |= partition.has_messages();
        lowest = std::min(lowest, partition.schedule().lowest());
      }
      if (waiting == 0 && !has_messages) {
        return;
      }
      for (Partition& partition : partitions_) {
        partition.schedule().begin_round(lowest);
      }
      const auto run = [&](std::size_t i) { partitions_[i].run_round(search_, body, reach, partitions_, round_); };
      if (waiting >= min_for_helpers) {
        team.call_helpers();
        team.run(partitions_.size(), run);
      } else {
        for (std::size_t i = 0; i < partitions_.size(); ++i) {
          run(i);
        }
      }
      ++round_;
      if constexpr (Schedule::adapts) {
        if (partitions_.front().schedule().must_adapt(visits(), known())) {
          const Scalar width = bucket_width(body);
          for (Partition& partition : partitions_) {
            partition.adapt(width);
          }
        }
      }
    }
  }

  /// Returns the width of buckets in which few elements are visited again: a fraction of the mean length of the links
  /// of some known elements.
  [[gnu::noinline]] Scalar bucket_width(const State& body) const {
    double sum = 0;
    std::size_t count = 0;
    const std::size_t step = known() / sampled_elements + 1;
    for (const Partition& partition : partitions_) {
      for (std::size_t i = 0; i < partition.elements().size(); i += step) {
        body.for_each_neighbour(partition.elements()[i], [&](ElementId, EntryId entry) {
          const Bounds& link = body.regions[entry];
          for (int k = 0; k < Dimension; ++k) {
            sum += double(link.high[k]) - double(link.low[k]);
          }
          count += 2 * Dimension;
        });
      }
    }
    const auto width = static_cast<Scalar>(width_in_links * sum / double(std::max<std::size_t>(1, count)));
    return width > 0 ? width : Scalar{1};
  }

  static constexpr std::size_t sampled_elements = 256;
  static constexpr double width_in_links = 0.05;  // measured by bench_passes
  static constexpr int max_partitions = 64;
  static constexpr std::size_t min_for_helpers = 128;  // waiting elements, of which a round visits some

  Search search_;
  std::vector<Partition> partitions_;
  std::uint64_t round_ = 0;
};

}  // namespace chainmail
