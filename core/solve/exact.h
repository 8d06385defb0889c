#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "solve/body.h"
#include "solve/exact_schedule.h"
#include "solve/path_search.h"
#include "solve/trace.h"

namespace chainmail {

/// Exact ChainMail: moves every element, on every axis, as little as any valid answer to the move can.
///
/// A link is two difference constraints an axis, so that a move by D is a shortest-path problem: an
/// element that has moved by d_i forces its neighbour to d_j ≥ d_i − slack_ij, and the answer is the least
/// fixed point of that. Rounded subtraction and max are monotone, so the fixed point in floating point is
/// unique as well: no schedule changes a bit of it. The derivation is this project's own.
///
/// The body holds displacements from rest. All axes go through one queue, mirrored where the hand goes
/// down. `Schedule` is one of exact_schedule.h.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class ExactPropagation {
 public:
  using State = Body<Scalar, Dimension>;

  struct Result {
    std::uint64_t checked = 0;  // elements that the pass reached
    std::uint64_t visits = 0;   // of elements, on all axes together, with those before the hand was held back
    bool stopped = false;       // by pins, short of its target
  };

  /// Answers a move of the grabbed element to this displacement from rest. The state must be valid.
  /// `moved` receives the elements that moved, without the grabbed one; `trace`, where given, the reached
  /// ones, those that had to go furthest first, ties by id.
  Result propagate(State& body, std::span<const ElementId> pins, ElementId grabbed, const Scalar (&target)[Dimension],
                   std::vector<ElementId>& moved, Trace* trace) {
    growth_.resize(body.elements.size());
    reached_.clear();
    for (int k = 0; k < Dimension; ++k) {
      const Scalar by = target[k] - body.elements[grabbed].position[k];
      is_down_[k] = by < 0;
      distance_[k] = std::abs(by);
      stopped_[k] = false;
    }
    Result result;
    while (!grow(body, grabbed, result)) {
      hold_back(body, grabbed);
      forget();
    }
    result.stopped = std::any_of(std::begin(stopped_), std::end(stopped_), [](bool one) { return one; });
    const Excess excess = result.stopped ? excess_at(pins) : Excess{};
    result.checked = reached_.size() - 1;
    if (trace != nullptr) {
      write_trace(body, grabbed, excess, *trace);
    }
    move(body, grabbed, target, excess, moved);
    return result;
  }

  /// The elements that the last pass reached, the grabbed one first.
  std::span<const ElementId> reached() const { return reached_; }

 private:
  struct Growth {
    Scalar by[Dimension]{};  // displacement in this pass so far, along the hand's direction, not below 0
    Scalar key = 0;          // largest of them that grew since the last visit; 0: not waiting
    bool reached = false;
  };

  using Excess = std::array<Scalar, Dimension>;

  /// Finds the least fixed point for the hand's distance. Gives up, returning false, where a pin would have
  /// to move along an axis on which the hand has not been held back yet.
  bool grow(const State& body, ElementId grabbed, Result& result) {
    Growth& hand = growth_[grabbed];
    std::copy(std::begin(distance_), std::end(distance_), hand.by);
    hand.key = *std::max_element(std::begin(distance_), std::end(distance_));
    reach(grabbed);
    schedule_.begin(hand.key);
    if (hand.key > 0) {
      schedule_.admit(grabbed, hand.key);
    }
    bool holds = true;
    std::uint64_t visits = 0;
    while (!schedule_.empty()) {
      const auto [key, element] = schedule_.take();
      // Visited since it was admitted, or admitted again with more.
      const bool is_over = schedule_.keeps_place() ? !(growth_[element].key > 0) : growth_[element].key != key;
      if (is_over || !holds) {
        continue;
      }
      growth_[element].key = 0;
      ++visits;
      body.for_each_neighbour(element, [&, from = element](ElementId neighbour, EntryId entry) {
        if (push(body, from, neighbour, entry) && body.pinned(neighbour)) {
          holds = !pulls(growth_[neighbour]) && holds;
        }
      });
      if constexpr (Schedule::adapts) {
        schedule_.visited(visits, reached_.size(), [this](ElementId e) { return growth_[e].key; });
      }
    }
    result.visits += visits;
    return holds;
  }

  /// Whether a pinned element would have to move along an axis on which the hand was not held back; notes
  /// which.
  bool pulls(const Growth& pin) {
    bool pulls = false;
    for (int k = 0; k < Dimension; ++k) {
      ends_at_pin_[k] |= pin.by[k] > 0 && !stopped_[k];
      pulls |= ends_at_pin_[k];
    }
    return pulls;
  }

  /// Shortens the hand's way, along each axis on which it ends at a pin, to where the object is taut: the
  /// shortest path of slack to the nearest pin. Summed from 0, it keeps its digits however far the hand is.
  void hold_back(const State& body, ElementId grabbed) {
    for (int k = 0; k < Dimension; ++k) {
      if (!std::exchange(ends_at_pin_[k], false)) {
        continue;
      }
      search_.begin(body.mesh->element_count());
      search_.add_source(grabbed, 0);
      const auto pin = search_.run(
          body, [&](ElementId i, ElementId j, EntryId entry) { return double(slack(body, i, j, entry, k)); },
          [&](ElementId e) { return body.pinned(e); });
      if (pin) {
        distance_[k] = std::min(distance_[k], static_cast<Scalar>(search_.label(*pin)));
      }
      stopped_[k] = true;
    }
  }

  /// How much further element i may go on axis k before it pushes its neighbour j.
  Scalar slack(const State& body, ElementId i, ElementId j, EntryId entry, int k) const {
    const Scalar apart = body.elements[j].position[k] - body.elements[i].position[k];
    const auto& region = body.regions[entry];
    const Scalar slack = is_down_[k] ? region.high[k] - apart : apart - region.low[k];
    return slack > 0 ? slack : 0;
  }

  /// Says whether the neighbour has to go further than was known.
  bool push(const State& body, ElementId element, ElementId neighbour, EntryId entry) {
    const Growth& from = growth_[element];
    Growth& to = growth_[neighbour];
    bool may_grow = false;
    for (int k = 0; k < Dimension; ++k) {
      may_grow |= from.by[k] > to.by[k];
    }
    if (!may_grow) {
      return false;  // slack is never below 0; most neighbours behind the front end here
    }
    Scalar grown = 0;
    for (int k = 0; k < Dimension; ++k) {
      const Scalar needed = from.by[k] - slack(body, element, neighbour, entry, k);
      if (needed > to.by[k]) {
        to.by[k] = needed;
        grown = std::max(grown, needed);
      }
    }
    if (grown > 0) {
      reach(neighbour);
      if (grown > to.key) {
        const bool waits = to.key > 0;
        to.key = grown;
        if (!(waits && schedule_.keeps_place())) {
          schedule_.admit(neighbour, grown);
        }
      }
    }
    return grown > 0;
  }

  void reach(ElementId element) {
    if (!growth_[element].reached) {
      growth_[element].reached = true;
      reached_.push_back(element);
    }
  }

  void forget() {
    for (const ElementId element : reached_) {
      growth_[element] = {};
    }
    reached_.clear();
  }

  /// By how much pins would still have to move: some ulps, from rounding along the paths. It is taken off
  /// all displacements. Each is the larger of 0 and D less a length of path, so that this is the answer for
  /// a hand that stops as much sooner.
  Excess excess_at(std::span<const ElementId> pins) const {
    Excess excess{};
    for (const ElementId pin : pins) {
      for (int k = 0; k < Dimension; ++k) {
        excess[k] = std::max(excess[k], growth_[pin].by[k]);
      }
    }
    return excess;
  }

  Scalar moved_to(const State& body, ElementId element, const Excess& excess, int k) const {
    const Scalar by = std::max(growth_[element].by[k] - excess[k], Scalar{0});
    const Scalar u = body.elements[element].position[k];
    return is_down_[k] ? u - by : u + by;
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
    moved.reserve(reached_.size());
    for (const ElementId element : reached_) {
      Scalar* u = body.elements[element].position;
      bool has_moved = false;
      for (int k = 0; k < Dimension; ++k) {
        const Scalar next = moved_to(body, element, excess, k);
        has_moved |= next != u[k];
        u[k] = next;
      }
      growth_[element] = {};
      if (has_moved && element != grabbed) {
        moved.push_back(element);
      }
    }
    for (int k = 0; k < Dimension; ++k) {
      if (!stopped_[k]) {  // where the hand arrives it stands at its target, which is no sum that was rounded
        body.elements[grabbed].position[k] = target[k];
      }
    }
  }

  /// The neighbour with the lowest id that made the element go as far as it does on the axis on which it
  /// goes furthest.
  ElementId binding_neighbour(const State& body, ElementId element) const {
    const Growth& to = growth_[element];
    const int k = static_cast<int>(std::max_element(std::begin(to.by), std::end(to.by)) - std::begin(to.by));
    ElementId binding = no_element;
    for (const ElementId neighbour : body.mesh->neighbours_of(element)) {
      body.for_each_neighbour(neighbour, [&](ElementId back, EntryId entry) {
        if (back == element && growth_[neighbour].by[k] - slack(body, neighbour, element, entry, k) == to.by[k]) {
          binding = std::min(binding, neighbour);
        }
      });
    }
    return binding;
  }

  void write_trace(const State& body, ElementId grabbed, const Excess& excess, Trace& trace) const {
    std::vector<ElementId> order;
    std::copy_if(reached_.begin(), reached_.end(), std::back_inserter(order),
                 [&](ElementId e) { return e != grabbed; });
    const auto furthest = [&](ElementId e) { return *std::max_element(growth_[e].by, growth_[e].by + Dimension); };
    std::sort(order.begin(), order.end(),
              [&](ElementId a, ElementId b) { return furthest(a) != furthest(b) ? furthest(a) > furthest(b) : a < b; });
    for (const ElementId element : order) {
      trace.push_back({element, binding_neighbour(body, element), moves(body, element, excess)});
    }
  }

  std::vector<Growth> growth_;
  std::vector<ElementId> reached_;  // by the last pass, the grabbed one first
  Schedule schedule_;
  PathSearch search_;
  // Along each axis: the hand goes down it, how far it goes, and whether pins hold it back.
  bool is_down_[Dimension]{};
  Scalar distance_[Dimension]{};
  bool stopped_[Dimension]{};
  bool ends_at_pin_[Dimension]{};  // and was not held back yet
};

}  // namespace chainmail
