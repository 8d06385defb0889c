#pragma once

#include <algorithm>
#include <array>
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

  // In float, which is half as much to read: the product is that of the rounded vectors.
  struct Pair {
    BlockVectors<float, D> step, change;  // of the position, and of the gradient
    double product = 0;                   // step · change
  };

  /// Forgets everything if it fails.
  template <class Evaluate, class Preconditioner>
  bool try_step(Evaluate evaluate, Preconditioner& preconditioner, Vectors& x, double& energy, Vectors& force,
                const SharedLoop& shared) {
    const double slope = find_direction(preconditioner, force, shared);
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

  /// Returns the slope of the energy along the direction, which is down if it is above 0.
  template <class Preconditioner>
  double find_direction(Preconditioner& preconditioner, const Vectors& force, const SharedLoop& shared) {
    assign(residual_, force, shared);
    const std::size_t count = pairs_.size();
    std::array<double, max_pairs> fractions{};
    double along = count > 0 ? dot(pairs_.back().step, residual_, shared) : 0;
    for (std::size_t i = count; i-- > 0;) {
      fractions[i] = along / pairs_[i].product;
      along = add_and_dot(residual_, -fractions[i], pairs_[i].change, pairs_[i > 0 ? i - 1 : 0].step, shared);
    }
    preconditioner.apply(residual_, direction_, shared);
    along = count > 0 ? dot(pairs_.front().change, direction_, shared) : dot(direction_, force, shared);
    for (std::size_t i = 0; i < count; ++i) {
      const double fraction = fractions[i] - along / pairs_[i].product;
      along = i + 1 < count ? add_and_dot(direction_, fraction, pairs_[i].step, pairs_[i + 1].change, shared)
                            : add_and_dot(direction_, fraction, pairs_[i].step, force, shared);
    }
    return along;
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
        pair.step[e] = rounded<float>(length * direction_[e]);
        pair.change[e] = rounded<float>(before_[e] - force[e]);
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
