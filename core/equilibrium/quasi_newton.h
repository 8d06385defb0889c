#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "equilibrium/block_vectors.h"

namespace chainmail {

/// A quasi-Newton method with a preconditioner in place of the first approximation of the inverse (L-BFGS; Nocedal
/// 1980), one step at a time. What it has learned about the curvature stays when the handle moves.
template <int D>
class QuasiNewton {
 public:
  using Vectors = BlockVectors<double, D>;

  void forget() { pairs_.clear(); }

  /// Runs a step from `x`, with the energy and its negative gradient there, which are updated. `evaluate(x, force)`
  /// returns the energy. Returns false if no step lowers the energy, also without what was learned: then rounding hides
  /// the way down.
  template <class Evaluate, class Preconditioner>
  bool step(Evaluate evaluate, Preconditioner& preconditioner, Vectors& x, double& energy, Vectors& force,
            const SharedLoop& shared = {}) {
    return try_step(evaluate, preconditioner, x, energy, force, shared) ||
           try_step(evaluate, preconditioner, x, energy, force, shared);
  }

  /// Estimates the distance from the minimum after the last step: √(twice the energy of the distance).
  double distance() const { return std::sqrt(slope_) * shrunk_; }

 private:
  static constexpr std::size_t max_pairs = 6;
  static constexpr int max_tries = 12;

  struct Pair {
    Vectors step, change;  // of the position, and of the gradient
    double product = 0;    // step · change
  };

  /// Forgets everything if it fails.
  template <class Evaluate, class Preconditioner>
  bool try_step(Evaluate evaluate, Preconditioner& preconditioner, Vectors& x, double& energy, Vectors& force,
                const SharedLoop& shared) {
    find_direction(preconditioner, force, shared);
    const double slope = dot(direction_, force, shared);
    slope_ = std::max(0.0, slope);
    if (!(slope > 0)) {
      forget();
      return false;
    }
    assign(before_, force, shared);
    assign(start_, x, shared);
    double length = 1;
    for (int i = 0; i < max_tries; ++i, length *= 0.5) {
      shared.run(x.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t e = first; e < last; ++e) {
          x[e] = start_[e] + length * direction_[e];
        }
      });
      const double next = evaluate(x, force);
      if (next <= energy - 1e-4 * length * slope + 1e-13 * energy) {
        energy = next;
        learn(length, force, shared);
        const double was = dot(before_, before_, shared);
        shrunk_ = was > 0 ? std::min(1.0, std::sqrt(dot(force, force, shared) / was)) : 0;
        return true;
      }
    }
    x = start_;
    force = before_;
    forget();
    return false;
  }

  template <class Preconditioner>
  void find_direction(Preconditioner& preconditioner, const Vectors& force, const SharedLoop& shared) {
    assign(residual_, force, shared);
    std::vector<double> fractions(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      fractions[i] = dot(pairs_[i].step, residual_, shared) / pairs_[i].product;
      add(residual_, -fractions[i], pairs_[i].change, shared);
    }
    preconditioner.apply(residual_, direction_, shared);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      add(direction_, fractions[i] - dot(pairs_[i].change, direction_, shared) / pairs_[i].product, pairs_[i].step,
          shared);
    }
  }

  void learn(double length, const Vectors& force, const SharedLoop& shared) {
    Pair pair;
    if (pairs_.size() == max_pairs) {
      pair = std::move(pairs_.front());
      pairs_.erase(pairs_.begin());
    }
    pair.step.resize(direction_.size());
    pair.change.resize(direction_.size());
    shared.run(direction_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        pair.step[e] = length * direction_[e];
        pair.change[e] = before_[e] - force[e];
      }
    });
    pair.product = dot(pair.step, pair.change, shared);
    const double size = std::sqrt(dot(pair.step, pair.step, shared) * dot(pair.change, pair.change, shared));
    if (pair.product > 1e-12 * size) {
      pairs_.push_back(std::move(pair));
    }
  }

  std::vector<Pair> pairs_;  // oldest first
  Vectors residual_, direction_, before_, start_;
  double slope_ = 0, shrunk_ = 1;
};

}  // namespace chainmail
