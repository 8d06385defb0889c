#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <vector>

#include "solve/least_growth.h"
#include "solve/trace.h"

namespace chainmail {

/// Exact ChainMail: moves every element, on every axis, as little as any valid answer to the move can.
/// LeastGrowth says how far each must go; here they go there.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class ExactPropagation {
 public:
  using State = Body<Scalar, Dimension>;

  /// Answers a move of the grabbed element to this displacement from rest. The state must be valid.
  /// `moved` receives the elements that moved, without the grabbed one; `trace`, where given, the reached
  /// ones, those that had to go furthest first, ties by id.
  PassCount propagate(State& body, std::span<const ElementId> pins, ElementId grabbed,
                      const Scalar (&target)[Dimension], std::vector<ElementId>& moved, Trace* trace) {
    growth_.forget();
    growth_.find(body, grabbed, target);
    PassCount count{growth_.reached().size() - 1, 0, false, growth_.visits()};
    for (int k = 0; k < Dimension; ++k) {
      count.stopped |= growth_.stopped(k);
    }
    const Excess excess = count.stopped ? excess_at(pins) : Excess{};
    if (trace != nullptr) {
      write_trace(body, excess, *trace);
    }
    move(body, grabbed, target, excess, moved);
    count.moved = moved.size();
    return count;
  }

  /// The elements that the last pass reached, the grabbed one first.
  std::span<const ElementId> reached() const { return growth_.reached(); }

 private:
  using Excess = std::array<Scalar, Dimension>;

  /// By how much pins would still have to move: some ulps, from rounding along the paths. It is taken off
  /// all displacements. Each is the larger of 0 and D less a length of path, so that this is the answer for
  /// a hand that stops as much sooner.
  Excess excess_at(std::span<const ElementId> pins) const {
    Excess excess{};
    for (const ElementId pin : pins) {
      for (int k = 0; k < Dimension; ++k) {
        excess[k] = std::max(excess[k], growth_.by(pin)[k]);
      }
    }
    return excess;
  }

  Scalar moved_to(const State& body, ElementId element, const Excess& excess, int k) const {
    const Scalar by = std::max(growth_.by(element)[k] - excess[k], Scalar{0});
    const Scalar u = body.elements[element].position[k];
    return growth_.is_down(k) ? u - by : u + by;
  }

  bool moves(const State& body, ElementId element, const Excess& excess) const {
    bool moves = false;
    for (int k = 0; k < Dimension; ++k) {
      moves |= moved_to(body, element, excess, k) != body.elements[element].position[k];
    }
    return moves;
  }

  void move(State& body, ElementId grabbed, const Scalar (&target)[Dimension], const Excess& excess,
            std::vector<ElementId>& moved) {
    moved.clear();
    moved.reserve(growth_.reached().size());
    for (const ElementId element : growth_.reached()) {
      Scalar* u = body.elements[element].position;
      bool has_moved = false;
      for (int k = 0; k < Dimension; ++k) {
        const Scalar next = moved_to(body, element, excess, k);
        has_moved |= next != u[k];
        u[k] = next;
      }
      if (has_moved && element != grabbed) {
        moved.push_back(element);
      }
    }
    for (int k = 0; k < Dimension; ++k) {
      if (!growth_.stopped(k)) {  // where the hand arrives it stands at its target, which is no sum that was rounded
        body.elements[grabbed].position[k] = target[k];
      }
    }
  }

  /// The neighbour with the lowest id that made the element go as far as it does on the axis on which it
  /// goes furthest.
  ElementId binding_neighbour(const State& body, ElementId element) const {
    const auto& to = growth_.by(element);
    const int k = static_cast<int>(std::max_element(std::begin(to), std::end(to)) - std::begin(to));
    ElementId binding = no_element;
    for (const ElementId neighbour : body.mesh->neighbours_of(element)) {
      body.for_each_neighbour(neighbour, [&](ElementId back, EntryId entry) {
        if (back == element && growth_.by(neighbour)[k] - growth_.slack(body, neighbour, element, entry, k) == to[k]) {
          binding = std::min(binding, neighbour);
        }
      });
    }
    return binding;
  }

  void write_trace(const State& body, const Excess& excess, Trace& trace) const {
    std::vector<ElementId> order(growth_.reached().begin() + 1, growth_.reached().end());
    const auto furthest = [&](ElementId e) { return *std::max_element(growth_.by(e), growth_.by(e) + Dimension); };
    std::sort(order.begin(), order.end(),
              [&](ElementId a, ElementId b) { return furthest(a) != furthest(b) ? furthest(a) > furthest(b) : a < b; });
    for (const ElementId element : order) {
      trace.push_back({element, binding_neighbour(body, element), moves(body, element, excess)});
    }
  }

  LeastGrowth<Scalar, Dimension, Schedule> growth_;
};

}  // namespace chainmail
