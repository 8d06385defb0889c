#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solve/handle_regions.h"
#include "solve/replay.h"
#include "solve/trace.h"

namespace chainmail {

/// Exact ChainMail: moves every element, on every axis, as little as any valid answer to the move can.
///
/// HandleRegions computes the region about the handle in which each element may lie. A pass clamps each element into
/// its own region, like a neighbour of the handle. No element waits for another one, so no order changes a bit of the
/// answer, and no rounding adds up along the links.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class ExactPropagation {
 public:
  using State = BodyView<Scalar, Dimension>;
  using Reach = HandleReach<Scalar, Dimension>;

  /// Moves the grabbed element to this displacement from rest. On axes on which pins stop it, it moves as far as they
  /// allow. The state must be valid. `moved` receives the elements that moved, without the grabbed one. `trace`, if
  /// given, receives the same elements, the largest move first, ties by id.
  PassCount propagate(State& body, ElementId grabbed, const Scalar* target, std::vector<ElementId>& moved,
                      Trace* trace) {
    const Conditions conditions{body.revisions().cuts, body.revisions().pins, body.revisions().softness, grabbed};
    if (conditions != made_for_) {
      regions_.begin(body, grabbed);
      made_for_ = conditions;
    }
    Reach reach(body.positions[grabbed], target);
    const std::uint64_t visits_before = regions_.visits();
    regions_.extend(body, reach);
    if (trace != nullptr) {
      write_trace(body, reach, *trace);
    }
    move(body, reach, moved);
    std::copy_n(reach.to, Dimension, body.positions[grabbed].at);
    drop_what_rests(moved.size());
    const bool stopped = std::find(reach.stopped, reach.stopped + Dimension, true) != reach.stopped + Dimension;
    return {moved.size(), moved.size(), stopped, regions_.visits() - visits_before};
  }

 private:
  /// What the regions are valid for.
  struct Conditions {
    std::uint64_t cuts = 0, pins = 0, softness = 0;
    ElementId grabbed = no_element;
    bool operator==(const Conditions&) const = default;
  };

  /// A drag that reached far and then moves little would still clamp all elements that it reached. So the regions are
  /// dropped after enough idle passes to pay for a new search.
  void drop_what_rests(std::size_t moved) {
    const std::size_t known = regions_.elements().size();
    idle_passes_ = moved < known / 4 ? idle_passes_ + 1 : 0;
    if (idle_passes_ == passes_of_a_search) {
      made_for_ = {};
      idle_passes_ = 0;
    }
  }

  static constexpr int passes_of_a_search = 16;  // approximate; measured in tests/bench

  void move(State& body, const Reach& reach, std::vector<ElementId>& moved) {
    const auto elements = regions_.elements();
    const auto regions = regions_.regions();
    auto* positions = body.positions.data();
    moved.resize(elements.size());
    std::size_t count = 0;
    for (std::size_t i = 1; i < elements.size(); ++i) {
      __builtin_prefetch(&positions[elements[std::min(i + fetched_ahead, elements.size() - 1)]], 1);
      auto& position = positions[elements[i]];
      const auto next = clamped(position, reach.low, reach.high, regions[i]);
      if (next != position) {
        position = next;
        moved[count++] = elements[i];
      }
    }
    moved.resize(count);
  }

  struct Row {
    double way;
    TraceRow row;
  };

  void write_trace(const State& body, const Reach& reach, Trace& trace) const {
    std::vector<Row> rows;
    for (std::size_t i = 1; i < regions_.elements().size(); ++i) {
      const ElementId element = regions_.elements()[i];
      const auto next = clamped(body.positions[element], reach.low, reach.high, regions_.regions()[i]);
      double ways[Dimension];
      for (int k = 0; k < Dimension; ++k) {
        ways[k] = std::abs(double(next[k]) - double(body.positions[element][k]));
      }
      const double* furthest = std::max_element(ways, ways + Dimension);
      if (*furthest > 0) {
        const auto k = static_cast<int>(furthest - ways);
        rows.push_back(
            {*furthest, {element, binding_neighbour(body, element, k, next[k] > body.positions[element][k]), true}});
      }
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
      return a.way != b.way ? a.way > b.way : a.row.element < b.row.element;
    });
    for (const Row& row : rows) {
      trace.push_back(row.row);
    }
  }

  /// Returns the neighbour with the lowest id on the shortest path to the element, along an axis, up or down. The
  /// region of a link seen from its other end is mirrored, to the bit.
  ElementId binding_neighbour(const State& body, ElementId element, int k, bool up) const {
    const auto& to = *regions_.find(element);
    ElementId binding = no_element;
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const auto* from = regions_.find(neighbour);
      const auto& link = body.regions[entry];
      if (from != nullptr &&
          (up ? from->low[k] - link.high[k] == to.low[k] : from->high[k] - link.low[k] == to.high[k])) {
        binding = std::min(binding, neighbour);
      }
    });
    return binding;
  }

  HandleRegions<Scalar, Dimension, Schedule> regions_;
  Conditions made_for_;
  int idle_passes_ = 0;  // passes in a row that moved few of the known elements
};

}  // namespace chainmail
