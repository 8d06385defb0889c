#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "solve/handle_regions.h"
#include "solve/replay.h"
#include "solve/rigid_handle.h"
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

  /// Moves a handle. The state must be valid, except for links inside a handle of many. On axes on which pins stop it,
  /// the handle moves as far as they allow. A rotation ends where the handle would contradict itself, or pins, through
  /// links outside it. `move` gets the pose that was reached. `moved` receives the elements that moved, without the
  /// handle. `trace`, if given, receives the same elements, the largest move first, ties by id.
  PassCount propagate(State& body, HandleMove& move, std::vector<ElementId>& moved, Trace* trace) {
    remark_.clear();
    visits_ = 0;
    begin(body, move.handle);
    const Reach reach = move.handle.has_one() ? extend_one(body, move) : extend_many(body, move);
    if (trace != nullptr) {
      write_trace(body, reach, *trace);
    }
    this->move(body, reach, moved);
    drop_idle_regions(moved.size());
    const bool stopped = std::find(reach.stopped, reach.stopped + Dimension, true) != reach.stopped + Dimension;
    return {moved.size(), moved.size(), stopped || !remark_.empty(), visits_};
  }

  /// Reason why the last pass did not reach its rotation. Usually empty.
  const std::string& remark() const { return remark_; }

 private:
  using Offset = Position<Scalar, Dimension>;

  /// What the regions are valid for.
  struct Conditions {
    std::uint64_t cuts = 0, pins = 0, softness = 0;
    ElementId first = no_element;  // of the handle
    std::uint64_t grab = 0;        // of a handle of many
    std::uint64_t positions = 0;   // of a handle of many, whose offsets come from them
    bool operator==(const Conditions&) const = default;
  };

  void begin(const State& body, const Handle& handle) {
    const Revisions& now = body.revisions();
    const Conditions conditions{
        now.cuts, now.pins, now.softness, handle.elements()[0], handle.grab(), handle.has_one() ? 0 : now.positions};
    if (conditions == made_for_ && is_where_it_was(body, handle)) {
      return;
    }
    offsets_.clear();
    if (!handle.has_one()) {
      shape_.begin(body, handle);
      offsets_ = shape_.offsets(rotation_ = handle.pose().rotation);
      std::fill_n(at_.at, Dimension, Scalar{0});
    }
    regions_.begin(body, handle.elements(), offsets_);
    made_for_ = conditions;
  }

  /// True if nothing has moved an element of a handle of many since the last pass. Relaxation may, after a release.
  bool is_where_it_was(const State& body, const Handle& handle) const {
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      for (int k = 0; k < Dimension; ++k) {
        if (body.positions[handle.elements()[i]][k] != at_[k] + offsets_[i][k]) {
          return false;
        }
      }
    }
    return true;
  }

  void extend(const State& body, Reach& reach) {
    const std::uint64_t before = regions_.visits();
    regions_.extend(body, reach);
    visits_ += regions_.visits() - before;
  }

  Reach extend_one(const State& body, HandleMove& move) {
    const ElementId element = move.handle.elements()[0];
    Reach reach(body.positions[element], stored_target(body, element, move.pose.pivot).at);
    extend(body, reach);
    for (int k = 0; k < Dimension; ++k) {
      if (reach.stopped[k]) {
        move.pose.pivot[body.mesh->axes[std::size_t(k)]] = body.origin(element, k) + double(reach.to[k]);
      }
    }
    return reach;
  }

  Reach extend_many(const State& body, HandleMove& move) {
    const Pose target = move.pose;
    const Offset to = shape_.at(target);
    std::optional<Offset> turned;
    if (target.rotation != rotation_) {
      turned = turn(body, move.handle, target.rotation, to);
    }
    Reach reach = turned ? Reach(*turned) : Reach(at_, to.at);
    if (turned) {
      for (int k = 0; k < Dimension; ++k) {
        reach.stopped[k] = (*turned)[k] != to[k];
      }
    } else {
      extend(body, reach);
    }
    std::copy_n(reach.to, Dimension, at_.at);
    if (at_ != to) {
      move.pose.pivot = shape_.pivot_at(at_);
    }
    move.pose.rotation = rotation_;
    return reach;
  }

  /// Finds regions for a rotation of the handle, or for the furthest possible one. Returns where the handle is then, as
  /// near to `to` as pins allow; nothing if it cannot rotate. The regions are those of rotation_ in either case.
  std::optional<Offset> turn(const State& body, const Handle& handle, const Point& target, const Offset& to) {
    const Point from = rotation_;
    auto reached = try_rotation(body, handle, target, to);
    if (reached) {
      return reached;
    }
    double possible = 0, impossible = 1;
    const double angle = angle_between(from, target);
    while ((impossible - possible) * angle > finest_angle) {
      const double fraction = (possible + impossible) / 2;
      (try_rotation(body, handle, rotation_between(from, target, fraction), to) ? possible : impossible) = fraction;
    }
    reached = try_rotation(body, handle, rotation_between(from, target, possible), to);
    char text[96];
    std::snprintf(text, sizeof text, "stopped at %.3g degrees by links outside the handle, or by pins",
                  rotation_.norm() * (180 / std::numbers::pi));
    remark_ = text;
    return possible > 0 ? reached : std::nullopt;
  }

  std::optional<Offset> try_rotation(const State& body, const Handle& handle, const Point& rotation,
                                     const Offset& target) {
    Offset to = target;
    rotation_ = rotation;
    offsets_ = shape_.offsets(rotation);
    regions_.begin(body, handle.elements(), offsets_);
    for (int i = 0; i < most_corrections; ++i) {
      Reach reach(to);
      extend(body, reach);
      if (!regions_.hold(body, to)) {
        break;
      }
    }
    double size = 0;
    for (int k = 0; k < Dimension; ++k) {
      size = std::max({size, std::abs(double(to[k])), std::abs(double(offsets_.front()[k]))});
    }
    // The same tolerance as for the links of a state that is taken to be valid.
    const double tolerance = 8 * std::numeric_limits<Scalar>::epsilon() * size;
    return regions_.agree(body, to, static_cast<Scalar>(tolerance)) ? std::optional(to) : std::nullopt;
  }

  static constexpr double finest_angle = 1e-6;  // radians
  // Of the position of a rotated handle, as the search finds more pins.
  static constexpr int most_corrections = 8;

  /// A drag that reached far and then moves little would still clamp all elements that it reached. So the regions are
  /// dropped after enough idle passes to pay for a new search.
  void drop_idle_regions(std::size_t moved) {
    const std::size_t known = regions_.elements().size() - offsets_.size();
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
    const std::size_t in_handle = std::max<std::size_t>(1, offsets_.size());
    for (std::size_t i = in_handle; i < elements.size(); ++i) {
      __builtin_prefetch(&positions[elements[std::min(i + fetched_ahead, elements.size() - 1)]], 1);
      auto& position = positions[elements[i]];
      const auto next = clamped(position, reach.low, reach.high, regions[i]);
      if (next != position) {
        position = next;
        moved[count++] = elements[i];
      }
    }
    moved.resize(count);
    std::copy_n(reach.to, Dimension, positions[elements[0]].at);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      for (int k = 0; k < Dimension; ++k) {
        positions[elements[i]][k] = reach.to[k] + offsets_[i][k];
      }
    }
  }

  struct Row {
    double way;
    TraceRow row;
  };

  void write_trace(const State& body, const Reach& reach, Trace& trace) const {
    std::vector<Row> rows;
    for (std::size_t i = std::max<std::size_t>(1, offsets_.size()); i < regions_.elements().size(); ++i) {
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

  Offset at_{};  // of a handle of many: its displacement after the last pass
  HandleRegions<Scalar, Dimension, Schedule> regions_;
  Conditions made_for_;
  RigidHandle<Scalar, Dimension> shape_;  // of a handle of many; the members below too
  std::vector<Offset> offsets_;           // for rotation_; empty for a handle of one
  Point rotation_ = Point::Zero();
  std::string remark_;
  std::uint64_t visits_ = 0;  // in this pass
  int idle_passes_ = 0;       // passes in a row that moved few of the known elements
};

}  // namespace chainmail
