#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solve/exact.h"
#include "solve/repair.h"

namespace chainmail {

/// Exact ChainMail from any state: repairs a start that is not valid, then lets the propagation answer.
template <class Scalar, int Dimension>
class ExactSolver {
 public:
  using State = Body<Scalar, Dimension>;

  /// Says what is known of the links without looking at them: that all hold, or nothing. What is not known to
  /// be valid is looked at before the next pass.
  void set_valid(bool is_valid) {
    is_valid_ = is_valid;
    reach_ = is_valid ? 0 : reach_;
  }

  /// To be called where links, softness or pins were changed.
  void forget() { propagation_.forget(); }

  /// A pass as ExactPropagation has it, from any state.
  PassCount move(State& body, std::span<const ElementId> pins, ElementId grabbed, const Scalar (&target)[Dimension],
                 std::vector<ElementId>& moved, Trace* trace) {
    const double reach = note_reach(body, grabbed, target);
    Repair repair(body, search_, reach_);
    std::vector<Place<Scalar, Dimension>> before;
    if (!is_valid_ && !repair.is_valid()) {
      before = body.places;
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
  /// Numbers as large as this leave links with the rounding of their size; once the hand is back among small
  /// ones, the object must be looked at again.
  double note_reach(const State& body, ElementId grabbed, const Scalar (&target)[Dimension]) {
    double reach = 0;
    for (int k = 0; k < Dimension; ++k) {
      const double from = double(body.places[grabbed][k]);
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

  /// A repair and the pass after it count as one: what moved is what stands elsewhere than before. What the
  /// pass did not reach has moved without a sponsor.
  void add_repaired(const State& body, const std::vector<Place<Scalar, Dimension>>& before, ElementId grabbed,
                    std::vector<ElementId>& moved, PassCount& count, Trace* trace) const {
    const auto has_moved = [&](ElementId e) {
      return !std::equal(before[e].at, before[e].at + Dimension, body.places[e].at);
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
  double furthest_ = 0;  // displacement or move since the links were last looked at (mesh units)
};

}  // namespace chainmail
