#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "mesh/error.h"
#include "solve/exact.h"
#include "solve/original.h"
#include "solve/propagate.h"
#include "solve/relaxation.h"
#include "solve/solver.h"

namespace chainmail {

/// The solver of one scalar and one space dimension.
template <class Scalar, int Dimension>
class TypedSolver final : public Solver {
 public:
  TypedSolver(const MeshPointer& mesh, Algorithm algorithm)
      : body_(mesh, algorithm == Algorithm::exact), algorithm_(algorithm) {}

  void set_algorithm(Algorithm algorithm) override {
    check(algorithm, *body_.mesh);
    algorithm_ = algorithm;
    if (body_.from_rest != (algorithm == Algorithm::exact)) {
      body_.hold_from_rest(algorithm == Algorithm::exact, softness_);
      is_valid_ = at_rest_;
      if (at_rest_) {
        body_.reset_positions();  // what rounding to absolute positions took is known here
      }
    }
  }

  void set_softness(const Softness& softness) override {
    softness_ = softness;
    body_.set_softness(softness);
    is_valid_ = at_rest_;
  }

  void cut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.cut(link);
    }
  }

  void uncut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.uncut(link);
    }
    is_valid_ = at_rest_;
  }

  void pin(std::span<const ElementId> elements) override {
    for (const ElementId element : elements) {
      const auto place = std::lower_bound(pins_.begin(), pins_.end(), element);
      if (place == pins_.end() || *place != element) {
        pins_.insert(place, element);
        body_.set_pinned(element, true);
      }
    }
  }

  void unpin(std::span<const ElementId> elements) override {
    for (const ElementId element : elements) {
      const auto place = std::lower_bound(pins_.begin(), pins_.end(), element);
      if (place != pins_.end() && *place == element) {
        pins_.erase(place);
        body_.set_pinned(element, false);
      }
    }
  }

  std::span<const ElementId> pins() const override { return pins_; }

  void reset() override {
    body_.reset_positions();
    relaxation_.sleep();
    at_rest_ = is_valid_ = true;
  }

  PassCount move(ElementId element, const Point& target, Trace* trace) override {
    if (body_.pinned(element)) {
      throw Error("element " + std::to_string(element), "it is pinned and may not move",
                  "unpin it, or move another element");
    }
    Scalar next[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      next[k] = static_cast<Scalar>(target[body_.mesh->axes[k]] - body_.origin(element, k));
      if (!std::isfinite(next[k]) || !std::isfinite(next[k] - body_.elements[element].position[k])) {
        throw Error("element " + std::to_string(element), "its target is not a finite number",
                    "give coordinates that fit the precision");
      }
    }
    const PassCount count =
        algorithm_ == Algorithm::exact ? move_exactly(element, next, trace) : move_by_lists(element, next, trace);
    at_rest_ = false;
    return count;
  }

  std::span<const ElementId> moved() const override { return moved_; }

  void wake(std::span<const ElementId> elements) override {
    for (const ElementId element : elements) {
      relaxation_.wake(body_, element);
    }
  }

  void set_relaxation(RelaxationScheme scheme) override { scheme_ = scheme; }

  RelaxationResult relax(double step, std::uint64_t budget, std::optional<ElementId> held) override {
    at_rest_ = false;
    return relaxation_.sweep(body_, scheme_, step, budget, held);
  }

  void sleep() override { relaxation_.sleep(); }

  const Cuts& cuts() const override { return body_.cuts; }
  PositionView positions() const override {
    return {body_.elements.data(), sizeof body_.elements[0],
            std::is_same_v<Scalar, float> ? Precision::single_precision : Precision::double_precision,
            body_.from_rest ? body_.mesh.get() : nullptr};
  }
  void copy_positions(std::span<float> out) const override { copy(out); }
  void copy_positions(std::span<double> out) const override { copy(out); }

  void set_positions(std::span<const double> in) override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      body_.place(static_cast<ElementId>(i / Dimension), i % Dimension, in[i]);
    }
    take_positions();
  }

  KeptPositions keep_positions() const override {
    KeptPositions kept{std::vector<double>(body_.elements.size() * Dimension), body_.from_rest};
    for (std::size_t i = 0; i < kept.held.size(); ++i) {
      kept.held[i] = double(body_.elements[i / Dimension].position[i % Dimension]);
    }
    return kept;
  }

  void restore(const KeptPositions& kept) override {
    const bool now = body_.from_rest;
    body_.from_rest = kept.from_rest;
    for (std::size_t i = 0; i < kept.held.size(); ++i) {
      body_.elements[i / Dimension].position[i % Dimension] = static_cast<Scalar>(kept.held[i]);
    }
    body_.hold_from_rest(now, softness_);
    take_positions();
  }

 private:
  void take_positions() {
    relaxation_.sleep();
    at_rest_ = is_valid_ = false;
  }

  PassCount move_by_lists(ElementId element, const Scalar (&target)[Dimension], Trace* trace) {
    std::copy(std::begin(target), std::end(target), body_.elements[element].position);
    PassCount count;
    if (trace != nullptr) {
      count.checked = propagate_with_list(element, [trace](ElementId e, ElementId sponsor, bool moved) {
        trace->push_back({e, sponsor, moved});
      });
    } else {
      count.checked = propagate_with_list(element, [](ElementId, ElementId, bool) {});
    }
    count.moved = moved_.size();
    is_valid_ = false;
    return count;
  }

  template <class Observe>
  std::uint64_t propagate_with_list(ElementId grabbed, Observe observe) {
    switch (algorithm_) {
      case Algorithm::generalized:
        return propagate(body_, front_, grabbed, moved_, observe);
      case Algorithm::spiral:
        return propagate(body_, spiral_, grabbed, moved_, observe);
      case Algorithm::natural_queue:
        return propagate(body_, natural_queue_, grabbed, moved_, observe);
      case Algorithm::enhanced:
        return propagate(body_, enhanced_, grabbed, moved_, observe);
      case Algorithm::original:
        return directions_.propagate(body_, grabbed, moved_, observe);
      case Algorithm::exact:
        break;
    }
    return 0;
  }

  PassCount move_exactly(ElementId element, const Scalar (&target)[Dimension], Trace* trace) {
    Repair repair(body_);
    if (is_valid_ || repair.is_valid()) {
      is_valid_ = true;
      return count_of(exact_.propagate(body_, pins_, element, target, moved_, trace));
    }
    const auto before = body_.elements;
    repair.run(pins_, element);
    is_valid_ = true;
    PassCount count = count_of(exact_.propagate(body_, pins_, element, target, moved_, trace));
    add_repaired(before, element, count, trace);
    return count;
  }

  PassCount count_of(const typename ExactPropagation<Scalar, Dimension>::Result& result) const {
    return {result.checked, moved_.size(), result.stopped, result.visits};
  }

  /// What the repair moved, and the pass did not, has moved without a sponsor.
  void add_repaired(const std::vector<ElementState<Scalar, Dimension>>& before, ElementId grabbed, PassCount& count,
                    Trace* trace) {
    std::vector<bool> known(before.size());
    known[grabbed] = true;
    for (const ElementId element : moved_) {
      known[element] = true;
    }
    for (ElementId e = 0; e < before.size(); ++e) {
      if (!known[e] && !std::equal(before[e].position, before[e].position + Dimension, body_.elements[e].position)) {
        moved_.push_back(e);
        ++count.checked;
        if (trace != nullptr) {
          trace->push_back({e, no_element, true});
        }
      }
    }
    count.moved = moved_.size();
  }

  template <class Out>
  void copy(std::span<Out> out) const {
    for (ElementId e = 0; e < body_.elements.size(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        out[std::size_t{e} * Dimension + k] = static_cast<Out>(body_.absolute(e, k));
      }
    }
  }

  Body<Scalar, Dimension> body_;
  Algorithm algorithm_;
  Softness softness_;
  std::vector<ElementId> pins_;  // ascending
  FrontList front_;
  SpiralList spiral_;
  NaturalQueueList natural_queue_;
  EnhancedList enhanced_;
  DirectionLists directions_;
  ExactPropagation<Scalar, Dimension> exact_;
  std::vector<ElementId> moved_;
  Relaxation<Scalar, Dimension> relaxation_;
  RelaxationScheme scheme_ = RelaxationScheme::mean;
  // What is known of the links without looking at them: that the object is as it was built, and that they
  // all hold.
  bool at_rest_ = true;
  bool is_valid_ = true;
};

}  // namespace chainmail
