#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "elastic/cell_edges.h"
#include "elastic/corotated.h"
#include "elastic/iterated.h"
#include "elastic/xpbd.h"

namespace chainmail {

/// The springs that stand for the material of a problem. Their mean decides on the time step, whatever the constraints.
inline std::vector<WeightedEdge> material_springs(const ElasticProblem& problem, const Simplices& cells) {
  const Lame material = lame_of_dimension(lame(problem.options.material), cells.dimension);
  return springs_of(cells, *problem.mesh, spring_modulus(material.mu, cells.dimension));
}

/// Extended position based dynamics with small steps (Macklin et al. 2016, 2019), for constraints of any kind.
///
/// An iteration is a time step: elements of equal mass go on with their velocities, less damping, and one sweep over
/// the constraints moves them back, with multipliers that begin at 0. Velocities are kept from move to move.
template <int N>
class TimeStepSolver : public IteratedSolver {
 protected:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  /// What the constraints read and write.
  struct Element {
    Vector at;            // from the first element at rest, so that an object far from the origin loses no digits
    double mobility = 1;  // inverse mass: 1, or 0 if the position is prescribed
  };

  /// `springs`: those of the material, for the time step.
  TimeStepSolver(const ElasticProblem& problem, const Simplices& cells, std::span<const WeightedEdge> springs,
                 const XpbdStep& step)
      : IteratedSolver(problem, cells),
        iterations_(problem.options.iterations),
        kept_velocity_(1 - step.damping),
        elements_(problem.mesh->element_count()),
        motions_(elements_.size()),
        length_(mean_length(springs, *problem.mesh)) {
    check_held(cells, *problem.mesh, problem.pins);
    double mean = 0;
    for (const WeightedEdge& spring : springs) {
      mean += spring.weight / double(springs.size());
    }
    square_ = step.springs_over_inertia / mean;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].at = motions_[e].rest = of(problem.mesh->rest, e) - of(problem.mesh->rest, 0);
    }
  }

  /// Moves the elements to meet each constraint once, in turn.
  virtual void sweep() = 0;

  Element& element(ElementId id) { return elements_[id]; }
  const Element& element(ElementId id) const { return elements_[id]; }
  /// The square of the time step, over the mass of an element.
  double square() const { return square_; }

 private:
  // The object is at rest if a time step moves no element by more than this (mean edge lengths).
  static constexpr double at_rest_below = 1e-10;
  // It diverges if a time step moves one by this.
  static constexpr double diverging_move = 100;

  struct Motion {
    Vector rest, before = Vector::Zero(), velocity = Vector::Zero();  // velocity: way in a time step
  };

  static Eigen::Map<const Vector> of(std::span<const double> all, std::size_t element) {
    return Eigen::Map<const Vector>(all.data() + element * N);
  }

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& /*progress*/) override {
    for (Element& element : elements_) {
      element.mobility = 1;
    }
    for (const ElementId element : prescribed) {
      elements_[element].mobility = 0;
    }
  }

  /// Makes a time step. Returns the longest way of an element; infinity if it is not a number.
  double step() {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      motions_[e].before = elements_[e].at;
      elements_[e].at += elements_[e].mobility * kept_velocity_ * motions_[e].velocity;
    }
    sweep();
    double longest = 0;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      motions_[e].velocity = elements_[e].at - motions_[e].before;
      const double way = motions_[e].velocity.norm();
      longest = way <= longest ? longest : way;  // also if it is not a number
    }
    return std::isfinite(longest) ? longest : std::numeric_limits<double>::infinity();
  }

  std::string relax(std::vector<double>& displacements, const Progress& progress) override {
    begin_at(displacements);
    double longest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < iterations_ && longest > at_rest_below * length_; ++i) {
      progress.report(double(i) / iterations_);
      longest = step();
      if (longest > diverging_move * length_) {
        stop();
        last_ = displacements;
        return "it diverged; the elements stay, but for the handle";
      }
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      if (elements_[e].mobility != 0) {
        Eigen::Map<Vector>(displacements.data() + e * N) = elements_[e].at - motions_[e].rest;
      }
    }
    last_ = displacements;
    return longest > at_rest_below * length_ ? not_converged(iterations_, longest / length_) : std::string();
  }

  void begin_at(const std::vector<double>& displacements) {
    if (!is_where_it_was(displacements)) {
      stop();
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].at = motions_[e].rest + of(displacements, e);
    }
  }
  void stop() {
    for (Motion& motion : motions_) {
      motion.velocity.setZero();
    }
  }

  /// True if the velocities are those at these displacements. Those of prescribed elements may differ.
  bool is_where_it_was(const std::vector<double>& displacements) const {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (elements_[i / N].mobility != 0 && displacements[i] != last_[i]) {
        return false;
      }
    }
    return true;
  }

  std::uint32_t iterations_;
  double kept_velocity_;  // share of the velocity that damping leaves
  double square_ = 0;
  std::vector<Element> elements_;
  std::vector<Motion> motions_;
  double length_ = 1;         // mean of the edges, the unit of moves (mesh units)
  std::vector<double> last_;  // displacements after the last time step
};

}  // namespace chainmail
