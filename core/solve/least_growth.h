#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "solve/body.h"
#include "solve/exact_schedule.h"
#include "solve/path_search.h"

namespace chainmail {

/// The heart of Exact ChainMail: how far each element must go, at least, along each axis, when the hand goes
/// as far as it does and every link is to hold.
///
/// A link is two difference constraints an axis, so that a move by D is a shortest-path problem: an
/// element that has moved by d_i forces its neighbour to d_j ≥ d_i − slack_ij, and the answer is the least
/// fixed point of that. Rounded subtraction and max are monotone, so the fixed point in floating point is
/// unique as well: no schedule changes a bit of it. The derivation is this project's own.
///
/// The body holds displacements from rest and is valid. All axes go through one queue, mirrored where the
/// hand goes down. `Schedule` is one of exact_schedule.h.
template <class Scalar, int Dimension, class Schedule>
class LeastGrowth {
 public:
  using State = Body<Scalar, Dimension>;

  /// Finds the answer for a hand that goes to this displacement from rest, or, along axes on which pins hold
  /// it, as far as they let it. To be forgotten before the next.
  void find(const State& body, ElementId grabbed, const Scalar (&target)[Dimension]) {
    growth_.resize(body.elements.size());
    visits_ = 0;
    for (int k = 0; k < Dimension; ++k) {
      const Scalar by = target[k] - body.elements[grabbed].position[k];
      is_down_[k] = by < 0;
      distance_[k] = std::abs(by);
      stopped_[k] = false;
    }
    while (!grow(body, grabbed)) {
      hold_back(body, grabbed);
      forget();
    }
  }

  void forget() {
    for (const ElementId element : reached_) {
      growth_[element] = {};
    }
    reached_.clear();
  }

  /// How far an element goes along each axis, in the hand's direction, not below 0 (mesh units).
  const Scalar (&by(ElementId element) const)[Dimension] { return growth_[element].by; }
  /// The elements that have to move, the grabbed one first.
  std::span<const ElementId> reached() const { return reached_; }
  /// Of elements, on all axes together, with those before the hand was held back.
  std::uint64_t visits() const { return visits_; }
  bool is_down(int k) const { return is_down_[k]; }
  /// Whether pins hold the hand back along an axis.
  bool stopped(int k) const { return stopped_[k]; }

  /// How much further element i may go on axis k before it pushes its neighbour j.
  Scalar slack(const State& body, ElementId i, ElementId j, EntryId entry, int k) const {
    const Scalar apart = body.elements[j].position[k] - body.elements[i].position[k];
    const auto& region = body.regions[entry];
    const Scalar slack = is_down_[k] ? region.high[k] - apart : apart - region.low[k];
    return slack > 0 ? slack : 0;
  }

 private:
  struct Growth {
    Scalar by[Dimension]{};  // displacement in this pass so far, along the hand's direction, not below 0
    Scalar key = 0;          // largest of them that grew since the last visit; 0: not waiting
    bool reached = false;
  };

  /// Finds the least fixed point for the hand's distance. Gives up, returning false, where a pin would have
  /// to move along an axis on which the hand has not been held back yet.
  bool grow(const State& body, ElementId grabbed) {
    Growth& hand = growth_[grabbed];
    std::copy(std::begin(distance_), std::end(distance_), hand.by);
    hand.key = *std::max_element(std::begin(distance_), std::end(distance_));
    reach(grabbed);
    schedule_.begin(hand.key);
    if (hand.key > 0) {
      schedule_.admit(grabbed, hand.key);
    }
    bool holds = true;
    const std::uint64_t visited_before = visits_;
    while (!schedule_.empty()) {
      const auto [key, element] = schedule_.take();
      // Visited since it was admitted, or admitted again with more.
      const bool is_over = schedule_.keeps_place() ? !(growth_[element].key > 0) : growth_[element].key != key;
      if (is_over || !holds) {
        continue;
      }
      growth_[element].key = 0;
      ++visits_;
      body.for_each_neighbour(element, [&, from = element](ElementId neighbour, EntryId entry) {
        if (push(body, from, neighbour, entry) && body.pinned(neighbour)) {
          holds = !pulls(growth_[neighbour]) && holds;
        }
      });
      if constexpr (Schedule::adapts) {
        schedule_.visited(visits_ - visited_before, reached_.size(), [this](ElementId e) { return growth_[e].key; });
      }
    }
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

  std::vector<Growth> growth_;
  std::vector<ElementId> reached_;
  std::uint64_t visits_ = 0;
  Schedule schedule_;
  PathSearch search_;
  // Along each axis: the hand goes down it, how far it goes, and whether pins hold it back.
  bool is_down_[Dimension]{};
  Scalar distance_[Dimension]{};
  bool stopped_[Dimension]{};
  bool ends_at_pin_[Dimension]{};  // and was not held back yet
};

}  // namespace chainmail
