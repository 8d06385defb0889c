#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Shortest paths along links (Dijkstra 1959), in double. A search costs only what it touches; its memory is reused by
/// the next one.
class PathSearch {
 public:
  static constexpr double unreached = std::numeric_limits<double>::infinity();

  void begin(ElementId element_count) {
    if (labels_.size() != element_count) {
      labels_.assign(element_count, unreached);
      hops_.assign(element_count, 0);
    } else {
      for (const ElementId element : touched_) {
        labels_[element] = unreached;
      }
    }
    touched_.clear();
    heap_.clear();
  }

  void add_source(ElementId element, double label) { lower(element, label, 0); }

  /// Lowers labels until label_j ≤ label_i + weight(i, j, entry) on every link that is not cut. Weights must be 0 or
  /// more.
  template <class Body, class Weight>
  void run(const Body& body, Weight weight) {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [label, element] = heap_.back();
      heap_.pop_back();
      if (label > labels_[element]) {
        continue;
      }
      body.for_each_neighbour(element, [&, from = label, sponsor = element](ElementId neighbour, EntryId entry) {
        const double through = from + weight(sponsor, neighbour, entry);
        if (through < labels_[neighbour]) {
          lower(neighbour, through, hops_[sponsor] + 1);
        }
      });
    }
  }

  /// Length of the shortest path to an element, including the source's label, and its number of links.
  double label(ElementId element) const { return labels_[element]; }
  std::uint32_t hops(ElementId element) const { return hops_[element]; }

 private:
  void lower(ElementId element, double label, std::uint32_t hops) {
    if (labels_[element] == unreached) {
      touched_.push_back(element);
    }
    labels_[element] = label;
    hops_[element] = hops;
    heap_.emplace_back(label, element);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  std::vector<double> labels_;
  std::vector<std::uint32_t> hops_;
  std::vector<ElementId> touched_;
  std::vector<std::pair<double, ElementId>> heap_;
};

}  // namespace chainmail
