#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "solve/exact.h"
#include "solve/method.h"
#include "solve/repair.h"

namespace chainmail {

/// Exact ChainMail from any state: repairs an invalid start, then runs the propagation.
template <class Scalar, int Dimension>
class ExactMethod final : public Method {
 public:
  using State = BodyView<Scalar, Dimension>;

  PassCount move(Body& body, const HandleMove& handle, PassOutput output) override {
    State view = body.view<Scalar, Dimension>();
    const auto target = stored_target(view, handle.element, handle.target);
    if (body.is_at_rest()) {
      body.reach().since_rest = 0;
    }
    bool is_valid = body.is_at_rest() || (links_hold_ && made_for_ == conditions_of(body.revisions()));
    const double reach = note_reach(body, view, handle.element, target, is_valid);
    Repair repair(view, search_, body.reach().since_rest);
    std::vector<Position<Scalar, Dimension>> before;
    if (!is_valid && !repair.is_valid()) {
      before.assign(view.positions.begin(), view.positions.end());
      repair.run(body.pins(), handle.element);
    }
    links_hold_ = true;
    made_for_ = conditions_of(body.revisions());
    body.reach().since_rest = std::max(body.reach().since_rest, reach);
    PassCount count = propagation_.propagate(view, handle.element, target.at, output.moved, output.trace);
    if (!before.empty()) {
      add_repaired(view, before, handle.element, output.moved, count, output.trace);
    }
    return count;
  }

 private:
  /// Large coordinates leave large rounding errors in the links. When the handle returns to small coordinates, the
  /// links must be checked again.
  static double note_reach(Body& body, const State& view, ElementId grabbed, const Position<Scalar, Dimension>& target,
                           bool& is_valid) {
    double reach = 0;
    for (int k = 0; k < Dimension; ++k) {
      const double from = double(view.positions[grabbed][k]);
      reach = std::max({reach, std::abs(double(target[k])), std::abs(from)});
    }
    double& furthest = body.reach().since_check;
    const double rounding = std::numeric_limits<Scalar>::epsilon() * furthest;
    if (64 * reach < furthest && rounding > 1e-6 * view.mesh->mean_link_length) {
      is_valid = false;
      furthest = 0;
    }
    furthest = std::max(furthest, reach);
    return reach;
  }

  /// What keeps the links valid that a pass left valid. Cutting links and pinning elements do.
  struct Conditions {
    std::uint64_t restored = 0, softness = 0, positions = 0;
    bool operator==(const Conditions&) const = default;
  };
  static Conditions conditions_of(const Revisions& revisions) {
    return {revisions.restored, revisions.softness, revisions.positions};
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
  bool links_hold_ = false;  // all links were valid after the last pass
  Conditions made_for_;      // of that pass
};

}  // namespace chainmail
