#pragma once

#include <memory>
#include <string>
#include <vector>

#include "elastic/elastic.h"
#include "solve/trace.h"

namespace chainmail {

/// Moves a body with a method of elasticity. Its preparation is kept until cells, pins or the material change.
class ElasticBody {
 public:
  void set(const ElasticOptions& options) {
    problem_.options = options;
    forget();
  }
  void set_progress(const Progress& progress) { progress_ = progress; }
  void forget() { solver_.reset(); }
  void reset() {
    held_ = no_element;
    if (solver_) {
      solver_->reset();
    }
  }
  /// Call this if the elements are not where the last pass left them.
  void start_anew() { anew_ = true; }

  const std::string& remark() const { return solver_ ? solver_->remark() : none_; }
  std::span<const double> control_points() const {
    return solver_ ? solver_->control_points() : std::span<const double>();
  }

  /// Runs a pass: the static answer with an element at its target.
  template <class Body>
  PassCount move(Body& body, ElasticMethod method, std::span<const ElementId> pins, ElementId element,
                 const typename Body::Scalar (&target)[Body::Dimension], std::vector<ElementId>& moved) {
    prepare(body, method, pins);
    if (held_ != element) {
      held_ = no_element;
      solver_->hold(element, progress_);
      held_ = element;
    }
    double displacement[Body::Dimension];
    for (int k = 0; k < Body::Dimension; ++k) {
      displacement[k] = double(target[k]) - body.mesh->rest[std::size_t{element} * Body::Dimension + k];
    }
    solver_->move(displacement, progress_);
    return take_answer(body, element, moved);
  }

  /// Moves a control point. The body must have been prepared for a method with control points.
  template <class Body>
  PassCount move_control_point(Body& body, std::size_t point, const double (&target)[Body::Dimension],
                               std::vector<ElementId>& moved) {
    solver_->move_control_point(point, target);
    return take_answer(body, no_element, moved);
  }

  /// Prepares the method, unless it is prepared.
  template <class Body>
  void prepare(const Body& body, ElasticMethod method, std::span<const ElementId> pins) {
    pinned_.clear();
    for (const ElementId pin : pins) {
      append_displacement(body, pin, pinned_);
    }
    if (!solver_ || method_ != method || pinned_ != problem_.pinned) {
      solver_.reset();
      problem_.mesh = body.mesh;
      problem_.cuts = body.cuts;
      problem_.pins.assign(pins.begin(), pins.end());
      problem_.pinned = pinned_;
      solver_ = make_elastic(method, problem_, progress_);
      method_ = method;
      held_ = no_element;
      anew_ = true;
    }
    if (anew_) {
      std::vector<double> displacements;
      for (ElementId e = 0; e < body.mesh->element_count(); ++e) {
        append_displacement(body, e, displacements);
      }
      solver_->start_from(displacements);
      anew_ = false;
    }
  }

 private:
  template <class Body>
  static void append_displacement(const Body& body, ElementId element, std::vector<double>& to) {
    for (int k = 0; k < Body::Dimension; ++k) {
      to.push_back(body.absolute(element, k) - body.mesh->rest[std::size_t{element} * Body::Dimension + k]);
    }
  }

  /// Sets the position of every element, and collects those that moved.
  template <class Body>
  PassCount take_answer(Body& body, ElementId grabbed, std::vector<ElementId>& moved) {
    const std::vector<double>& answer = solver_->displacements();
    moved.clear();
    for (ElementId e = 0; e < body.mesh->element_count(); ++e) {
      const auto before = body.positions[e];
      for (int k = 0; k < Body::Dimension && !body.pinned(e); ++k) {
        const std::size_t at = std::size_t{e} * Body::Dimension + k;
        body.set_position(e, k, body.mesh->rest[at] + answer[at]);
      }
      if (e != grabbed && body.positions[e] != before) {
        moved.push_back(e);
      }
    }
    return {body.mesh->element_count(), moved.size()};
  }

  ElasticProblem problem_;
  std::vector<double> pinned_;  // current displacements of the pins
  ElasticMethod method_ = ElasticMethod::linear_fem;
  std::unique_ptr<ElasticSolver> solver_;
  ElementId held_ = no_element;
  Progress progress_;
  bool anew_ = false;  // the elements are not where the solver left them
  std::string none_;
};

}  // namespace chainmail
