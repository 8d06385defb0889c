#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solve/exact.h"
#include "solve/repair.h"

namespace chainmail {

/// Exact ChainMail from any state: repairs an invalid start, then runs the propagation.
template <class Scalar, int Dimension>
class ExactSolver {
 public:
  using State = Body<Scalar, Dimension>;

  /// Sets what is known about the links without a check: all are valid, or nothing is known. In the second case the
  /// next pass checks them first.
  void set_valid(bool is_valid) {
    is_valid_ = is_valid;
    reach_ = is_valid ? 0 : reach_;
  }

  /// Call this when links, softness or pins have changed.
  void forget() { propagation_.forget(); }

  /// Runs a pass like ExactPropagation, from any state.
  PassCount move(State& body, std::span<const ElementId> pins, ElementId grabbed, const Scalar (&target)[Dimension],
                 std::vector<ElementId>& moved, Trace* trace) {
    const double reach = note_reach(body, grabbed, target);
    Repair repair(body, search_, reach_);
    std::vector<Position<Scalar, Dimension>> before;
    if (!is_valid_ && !repair.is_valid()) {
      before = body.positions;
      repair.run(pins, grabbed);
    }
    is_valid_ = true;
    reach_ = std::max(reach_, reach);
    PassCount count = propagation_.propagate(body, grabbed, target, moved, trace);
    if (!before.empty()) {
      add_repaired(body, before, grabbed, moved, count, trace);
    }
    return count;
  }

 private:
  /// Large coordinates leave large rounding errors in the links. When the handle returns to small coordinates, the
  /// links must be checked again.
  double note_reach(const State& body, ElementId grabbed, const Scalar (&target)[Dimension]) {
    double reach = 0;
    for (int k = 0; k < Dimension; ++k) {
      const double from = double(body.positions[grabbed][k]);
      reach = std::max({reach, std::abs(double(target[k])), std::abs(from)});
    }
    const double rounding = std::numeric_limits<Scalar>::epsilon() * furthest_;
    if (64 * reach < furthest_ && rounding > 1e-6 * body.mesh->mean_link_length) {
      is_valid_ = false;
      furthest_ = 0;
    }
    furthest_ = std::max(furthest_, reach);
    return reach;
  }

  /// Counts a repair and the pass after it as one pass. An element has moved if its position changed in total. Elements
  /// that the pass did not reach moved without a sponsor.
  void add_repaired(const State& body, const std::vector<Position<Scalar, Dimension>>& before, ElementId grabbed,
                    std::vector<ElementId>& moved, PassCount& count, Trace* trace) const {
    const auto has_moved = [&](ElementId e) {
      return !std::equal(before[e].at, before[e].at + Dimension, body.positions[e].at);
    };
    std::vector<bool> reached(before.size());
    for (const ElementId element : moved) {
      reached[element] = true;
    }
    if (trace != nullptr) {
      for (auto row = trace->end() - static_cast<std::ptrdiff_t>(count.checked); row != trace->end(); ++row) {
        row->moved = has_moved(row->element);
      }
    }
    moved.clear();
    for (ElementId e = 0; e < before.size(); ++e) {
      if (e == grabbed || !has_moved(e)) {
        continue;
      }
      moved.push_back(e);
      if (!reached[e]) {
        ++count.checked;
        if (trace != nullptr) {
          trace->push_back({e, no_element, true});
        }
      }
    }
    count.moved = moved.size();
  }

  ExactPropagation<Scalar, Dimension> propagation_;
  PathSearch search_;
  bool is_valid_ = true;
  double reach_ = 0;     // the largest displacement or move since the object was at rest (mesh units)
  double furthest_ = 0;  // largest displacement or move since the links were last checked (mesh units)
};

}  // namespace chainmail
