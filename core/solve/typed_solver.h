#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <string>
#include <type_traits>

#include "mesh/error.h"
#include "solve/body_positions.h"
#include "solve/elastic_body.h"
#include "solve/exact_solver.h"
#include "solve/list_algorithm.h"
#include "solve/relaxation.h"
#include "solve/solver.h"

namespace chainmail {

/// The solver of one scalar and one space dimension.
template <class Scalar, int Dimension>
class TypedSolver final : public Solver {
 public:
  TypedSolver(const MeshPointer& mesh, Algorithm algorithm)
      : body_(mesh, info(algorithm).from_rest), algorithm_(info(algorithm)) {}

  void set_algorithm(Algorithm algorithm) override {
    check(algorithm, *body_.mesh);
    if (algorithm != algorithm_.algorithm) {
      list_.reset();
    }
    algorithm_ = info(algorithm);
    forget();
    elastic_.forget();
    if (body_.from_rest != algorithm_.from_rest) {
      body_.hold_from_rest(algorithm_.from_rest, softness_);
      exact_.set_valid(at_rest_);
      if (at_rest_) {
        body_.reset_positions();  // restores digits that absolute positions lost by rounding
      }
    }
  }

  void set_softness(const Softness& softness) override {
    Softness next = softness;
    body_.set_softness(softness);
    softness_ = std::move(next);
    forget();
    exact_.set_valid(at_rest_);
  }

  void set_elastic(const ElasticOptions& options) override { elastic_.set(options); }
  void set_progress(const Progress& progress) override { elastic_.set_progress(progress); }

  void cut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.cut(link);
    }
    forget();
    elastic_.forget();
  }

  void uncut(std::span<const LinkId> links) override {
    for (const LinkId link : links) {
      body_.cuts.uncut(link);
    }
    forget();
    elastic_.forget();
    exact_.set_valid(at_rest_);
  }

  void pin(std::span<const ElementId> elements) override {
    std::vector<ElementId> all;
    const auto added = sorted(elements);
    std::set_union(pins_.begin(), pins_.end(), added.begin(), added.end(), std::back_inserter(all));
    set_pins(std::move(all));
  }

  void unpin(std::span<const ElementId> elements) override {
    std::vector<ElementId> rest;
    const auto removed = sorted(elements);
    std::set_difference(pins_.begin(), pins_.end(), removed.begin(), removed.end(), std::back_inserter(rest));
    set_pins(std::move(rest));
  }

  std::span<const ElementId> pins() const override { return pins_; }

  void reset() override {
    ElementBlocks all(body_.mesh->element_count());
    all.insert_all();
    reset(all);
  }

  void reset(const ElementBlocks& away) override {
    away.for_each_run([this](ElementId first, ElementId end) { put_to_rest(body_, first, end); });
    forget();
    relaxation_.sleep();
    elastic_.reset();
    at_rest_ = true;
    exact_.set_valid(true);
  }

  PassCount move(ElementId element, const Point& target, Trace* trace) override {
    if (body_.pinned(element)) {
      throw Error("element " + std::to_string(element), "it is pinned and may not move",
                  "unpin it, or move another element");
    }
    Scalar next[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      const double to = target[body_.mesh->axes[k]];
      // A move to the position that was read must not move the element, even after rounding.
      const bool stays = body_.from_rest && to == body_.absolute(element, k);
      next[k] = stays ? body_.positions[element][k] : static_cast<Scalar>(to - body_.origin(element, k));
      if (!(std::abs(next[k]) <= limit)) {
        throw Error("element " + std::to_string(element), "its target is out of the range of the precision",
                    "give smaller coordinates, or compute in double");
      }
    }
    try {
      const PassCount count = algorithm_.elastic ? move_elastically(element, next)
                              : algorithm_.list  ? move_by_list(element, next, trace)
                                                 : exact_.move(body_, pins_, element, next, moved_, trace);
      at_rest_ = false;
      return count;
    } catch (const std::bad_alloc&) {
      drop_pass();
      throw;
    }
  }

  const std::string& remark() const override { return elastic_.remark(); }
  std::span<const double> control_points() override {
    if (!algorithm_.has_control_points) {
      return {};
    }
    elastic_.prepare(body_, *algorithm_.elastic, pins_);
    return elastic_.control_points();
  }

  PassCount move_control_point(std::size_t point, const Point& target) override {
    if (point >= control_points().size() / Dimension) {
      throw Error("control point " + std::to_string(point), "there is no such point",
                  "choose free-form deformation, and one of its points");
    }
    double to[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      to[k] = target[body_.mesh->axes[k]];
    }
    const PassCount count = elastic_.move_control_point(body_, point, to, moved_);
    at_rest_ = false;
    exact_.set_valid(false);
    return count;
  }

  std::span<const ElementId> moved() const override { return moved_; }

  void wake(std::span<const ElementId> elements) override {
    for (const ElementId element : elements) {
      relaxation_.wake(body_, element);
    }
  }

  void wake_all() override { relaxation_.wake_all(body_); }

  void set_relaxation(RelaxationScheme scheme) override { scheme_ = scheme; }

  RelaxationResult relax(double step, std::uint64_t budget, std::optional<ElementId> held) override {
    const RelaxationResult result = relaxation_.sweep(body_, scheme_, step, budget, held);
    at_rest_ = at_rest_ && result.largest_step == 0;
    return result;
  }

  std::span<const ElementId> relaxed() const override { return relaxation_.moved(); }

  void sleep() override { relaxation_.sleep(); }

  const Cuts& cuts() const override { return body_.cuts; }
  PositionView positions() const override {
    return {body_.positions.data(), sizeof body_.positions[0],
            std::is_same_v<Scalar, float> ? Precision::single_precision : Precision::double_precision,
            body_.from_rest ? body_.mesh.get() : nullptr};
  }
  void copy_positions(ElementId first, std::span<float> out) const override { copy(first, out); }
  void copy_positions(ElementId first, std::span<double> out) const override { copy(first, out); }

  void set_positions(std::span<const double> in) override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      body_.set_position(static_cast<ElementId>(i / Dimension), i % Dimension, in[i]);
    }
    take_positions();
  }

  Snapshot snapshot(const ElementBlocks& away) const override { return snapshot_of(body_, away); }

  void restore(const Snapshot& snapshot, const ElementBlocks& away) override {
    reset(away);
    if (!snapshot.runs.empty()) {
      restore_snapshot(body_, snapshot);
      take_positions();
    }
  }

  void keep_positions(const ElementBlocks& blocks, const ElementBlocks& away, PositionBlocks& kept) const override {
    save_blocks(body_, blocks, away, kept);
  }

  void restore(const PositionBlocks& kept, const ElementBlocks& blocks) override {
    restore_blocks(body_, kept, blocks);
    forget();
    take_positions();
    at_rest_ = std::none_of(kept.blocks.begin(), kept.blocks.end(), [](const auto& block) { return block != nullptr; });
    exact_.set_valid(at_rest_);
  }

 private:
  /// Largest coordinate, so that sums of a few of them are finite.
  static constexpr Scalar limit = std::numeric_limits<Scalar>::max() / 16;

  static std::vector<ElementId> sorted(std::span<const ElementId> elements) {
    std::vector<ElementId> all(elements.begin(), elements.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  void set_pins(std::vector<ElementId> pins) {
    for (const ElementId pin : pins_) {
      body_.set_pinned(pin, false);
    }
    pins_ = std::move(pins);
    for (const ElementId pin : pins_) {
      body_.set_pinned(pin, true);
    }
    forget();
    elastic_.forget();
  }

  void take_positions() {
    relaxation_.sleep();
    elastic_.start_anew();
    at_rest_ = false;
    exact_.set_valid(false);
  }

  PassCount move_elastically(ElementId element, const Scalar (&target)[Dimension]) {
    exact_.set_valid(false);
    return elastic_.move(body_, *algorithm_.elastic, pins_, element, target, moved_);
  }

  PassCount move_by_list(ElementId element, const Scalar (&target)[Dimension], Trace* trace) {
    if (!list_) {
      list_ = algorithm_.list->make<Scalar, Dimension>();
    }
    std::copy(std::begin(target), std::end(target), body_.positions[element].at);
    const std::span<const Step> steps = list_->propagate(body_, element, moved_);
    if (trace != nullptr) {
      for (const Step& step : steps) {
        trace->push_back({step.element(), step.sponsor, step.has_moved()});
      }
    }
    exact_.set_valid(false);
    return {steps.size(), moved_.size()};
  }

  /// Drops everything that the next pass would reuse from the last one.
  void forget() {
    if (list_) {
      list_->forget();
    }
    exact_.forget();
  }

  /// Called if memory ran out in the middle of a pass: the next pass reuses nothing of it.
  void drop_pass() {
    moved_.clear();
    at_rest_ = false;
    exact_.set_valid(false);
    forget();
    list_.reset();
    exact_ = {};
    exact_.set_valid(false);
    elastic_.forget();
  }

  template <class Out>
  void copy(ElementId first, std::span<Out> out) const {
    for (std::size_t i = 0; i < out.size() / Dimension; ++i) {
      for (int k = 0; k < Dimension; ++k) {
        out[i * Dimension + k] = static_cast<Out>(body_.absolute(first + static_cast<ElementId>(i), k));
      }
    }
  }

  Body<Scalar, Dimension> body_;
  AlgorithmInfo algorithm_;
  Softness softness_;
  std::vector<ElementId> pins_;                          // ascending
  std::unique_ptr<ListMethod<Scalar, Dimension>> list_;  // of the algorithm, made by its first pass
  ExactSolver<Scalar, Dimension> exact_;
  ElasticBody elastic_;
  std::vector<ElementId> moved_;
  Relaxation<Scalar, Dimension> relaxation_;
  RelaxationScheme scheme_ = RelaxationScheme::mean;
  bool at_rest_ = true;  // all elements are known to be at rest
};

}  // namespace chainmail
