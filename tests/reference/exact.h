#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "reference/object.h"

namespace reference {

/// Computes the smallest displacements that answer a move by D along an axis, with the algorithm of Bellman and Ford:
/// it checks all links, round after round, until no displacement grows. Computed in double, from valid positions,
/// without queues, keys or mirrored axes. `cut` marks links that are cut.
class LeastAnswer {
 public:
  LeastAnswer(MeshPointer mesh, const FactorsOfLink& factors, std::function<bool(ElementId, ElementId)> cut)
      : mesh_(std::move(mesh)), object_(mesh_, factors), cut_(std::move(cut)) {
    for (const auto& one : object_.softness) {
      bounds_.push_back(one);
    }
  }

  /// Returns the bounds of all elements (element_count x space_dimension each) while the elements of a handle are at
  /// these positions: the shortest paths from all of them at once, without the links between two of them.
  struct Bounds {
    std::vector<double> low, high;
  };
  Bounds about(const std::vector<ElementId>& handle, const std::vector<double>& positions) const {
    const double infinite = std::numeric_limits<double>::infinity();
    Bounds bounds{std::vector<double>(positions.size(), -infinite), std::vector<double>(positions.size(), infinite)};
    const auto is_held = [&](ElementId e) { return std::find(handle.begin(), handle.end(), e) != handle.end(); };
    const auto n = static_cast<std::size_t>(object_.space_dimension);
    for (const ElementId e : handle) {
      for (std::size_t k = 0; k < n; ++k) {
        bounds.low[e * n + k] = bounds.high[e * n + k] = positions[e * n + k];
      }
    }
    for (bool narrowed = true; narrowed;) {
      narrowed = false;
      for (const SoftnessData<double>& link : bounds_) {
        if (cut_(link.sponsor, link.neighbour) || (is_held(link.sponsor) && is_held(link.neighbour))) {
          continue;
        }
        for (std::size_t k = 0; k < n; ++k) {
          double& low = bounds.low[link.neighbour * n + k];
          double& high = bounds.high[link.neighbour * n + k];
          const double lowest = bounds.low[link.sponsor * n + k] + link.low[k];
          const double highest = bounds.high[link.sponsor * n + k] + link.high[k];
          narrowed = narrowed || lowest > low || highest < high;
          low = std::max(low, lowest);
          high = std::min(high, highest);
        }
      }
    }
    return bounds;
  }

  /// Returns the positions (element_count x space_dimension) after the grabbed element moved to its target.
  std::vector<double> move(const std::vector<double>& positions, ElementId grabbed,
                           const std::array<double, 3>& target) const {
    std::vector<double> result = positions;
    for (int k = 0; k < object_.space_dimension; ++k) {
      move_along(positions, grabbed, target[k], k, result);
    }
    return result;
  }

 private:
  void move_along(const std::vector<double>& x, ElementId grabbed, double target, int k,
                  std::vector<double>& result) const {
    const auto at = [&](ElementId e) { return std::size_t{e} * object_.space_dimension + k; };
    const double by = target - x[at(grabbed)];
    std::vector<double> gone(mesh_->element_count());
    gone[grabbed] = std::abs(by);
    for (bool grew = true; grew;) {
      grew = false;
      for (const SoftnessData<double>& link : bounds_) {
        if (cut_(link.sponsor, link.neighbour)) {
          continue;
        }
        const double apart = x[at(link.neighbour)] - x[at(link.sponsor)];
        const double slack = std::max(0.0, by < 0 ? link.high[k] - apart : apart - link.low[k]);
        const double needed = gone[link.sponsor] - slack;
        if (needed > gone[link.neighbour]) {
          gone[link.neighbour] = needed;
          grew = true;
        }
      }
    }
    for (ElementId e = 0; e < gone.size(); ++e) {
      result[at(e)] = by < 0 ? x[at(e)] - gone[e] : x[at(e)] + gone[e];
    }
  }

  MeshPointer mesh_;
  Object<double> object_;
  std::vector<SoftnessData<double>> bounds_;
  std::function<bool(ElementId, ElementId)> cut_;
};

}  // namespace reference
