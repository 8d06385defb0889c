#pragma once

#include <algorithm>
#include <functional>
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
