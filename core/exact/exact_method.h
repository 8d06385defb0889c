#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "body/method.h"
#include "exact/exact.h"
#include "exact/restore_validity.h"

namespace chainmail {

/// Exact ChainMail from any state: makes an invalid start valid, then runs the propagation.
template <class Scalar, int Dimension>
class ExactMethod final : public Method {
 public:
  using State = BodyView<Scalar, Dimension>;

  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    State view = body.view<Scalar, Dimension>();
    const double size = size_of(view, move);
    if (body.is_at_rest()) {
      body.reach().since_rest = 0;
    }
    bool is_valid = body.is_at_rest() || holds(body, move.handle);
    note_reach(body, view, size, is_valid);
    links_hold_ = is_valid;  // if this fails, the next pass checks again
    RestoreValidity restore(view, search_, body.reach().since_rest, move.handle.elements());
    std::vector<Position<Scalar, Dimension>> before;
    if (!is_valid && !restore.is_valid()) {
      before.assign(view.positions.begin(), view.positions.end());
      restore.run(body.pins());
    }
    links_hold_ = true;
    made_for_ = revisions_of(body);
    handle_.assign(move.handle.elements().begin(), move.handle.elements().end());
    body.reach().since_rest = std::max(body.reach().since_rest, size);
    PassCount count = propagation_.propagate(view, move, output.moved, output.trace, output.threads);
    if (!before.empty()) {
      add_restored(view, before, move.handle, output.moved, count, output.trace);
    }
    return count;
  }

  void prepare(Body& body, ElementId element, int threads, const Progress& progress) override {
    const State view = body.view<Scalar, Dimension>();
    propagation_.prepare(view, Handle(body, {element}), threads, progress);
  }

  std::string remark() const override { return propagation_.remark(); }

 private:
  /// Returns the largest stored coordinate of the handle, before and after the move. Throws Error if one is out of
  /// range.
  [[gnu::noinline]] static double size_of(const State& view, const HandleMove& move) {
    double size = 0;
    for_each_target(view, move, [&](ElementId element, const Position<Scalar, Dimension>& target) {
      for (int k = 0; k < Dimension; ++k) {
        size = std::max({size, std::abs(double(target[k])), std::abs(double(view.positions[element][k]))});
      }
    });
    return size;
  }

  /// True if nothing has changed since the last pass left all links valid, outside the handle of many that it had.
  bool holds(const Body& body, const Handle& handle) const {
    return links_hold_ && made_for_ == revisions_of(body) &&
           (handle_.size() == 1 || std::ranges::equal(handle_, handle.elements()));
  }

  /// Large coordinates leave large rounding errors in the links. When the handle returns to small coordinates, the
  /// links must be checked again.
  static void note_reach(Body& body, const State& view, double size, bool& is_valid) {
    double& furthest = body.reach().since_check;
    const double rounding = std::numeric_limits<Scalar>::epsilon() * furthest;
    if (64 * size < furthest && rounding > 1e-6 * view.mesh->mean_link_length) {
      is_valid = false;
      furthest = 0;
    }
    furthest = std::max(furthest, size);
  }

  /// The changes that may make valid links invalid. Cutting links and pinning elements cannot.
  static Revisions revisions_of(const Body& body) {
    return body.revisions().only({&Revisions::restored, &Revisions::softness, &Revisions::positions});
  }

  /// Counts the restoration of validity and the pass after it as one pass. An element has moved if its position changed
  /// in total. Elements that the pass did not reach moved without a sponsor.
  [[gnu::cold]] void add_restored(const State& body, const std::vector<Position<Scalar, Dimension>>& before,
                                  const Handle& handle, std::vector<ElementId>& moved, PassCount& count,
                                  Trace* trace) const {
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
      if (!has_moved(e) || handle.contains(e)) {
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
  bool links_hold_ = false;        // all links were valid after the last pass
  Revisions made_for_;             // of that pass
  std::vector<ElementId> handle_;  // of that pass
};

}  // namespace chainmail
