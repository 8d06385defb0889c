#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "equilibrium/block_vectors.h"

namespace chainmail {

/// Extrapolates the displacements of the last two frames of a drag to the next one.
template <int D>
class LinearPrediction {
 public:
  using Vectors = BlockVectors<double, D>;

  void forget() { is_known_ = false; }
  /// Takes the displacements at the end of a frame, and by how much the fixed elements move in the next one. Adds to
  /// the displacements a multiple of what the last frame changed, the one that leaves the least of this motion, and
  /// subtracts it from the motion. Returns false if it adds nothing: if it does not know the frame before, or if a
  /// frame had not converged.
  bool predict(Vectors& at, Vectors& motion, const std::vector<std::uint8_t>& fixed, bool has_converged,
               const SharedLoop& shared) {
    const double share = is_known_ && has_converged ? best_share(at, motion, fixed) : 0;
    before_.resize(at.size());
    shared.run(at.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        const auto now = at[e];
        if (share != 0) {
          const auto change = share * (now - before_[e]);
          at[e] += change;
          if (fixed[e] != 0) {
            motion[e] -= change;
          }
        }
        before_[e] = now;
      }
    });
    is_known_ = has_converged;
    return share != 0;
  }
  /// The displacements that predict() took.
  const Vectors& before() const { return before_; }

 private:
  // A handle that turns back goes at most to where it came from.
  static constexpr double least_share = -1, largest_share = 2;

  double best_share(const Vectors& at, const Vectors& motion, const std::vector<std::uint8_t>& fixed) const {
    double along = 0, square = 0;
    for (std::size_t e = 0; e < at.size(); ++e) {
      if (fixed[e] != 0) {
        const auto change = at[e] - before_[e];
        along += change.dot(motion[e]);
        square += change.squaredNorm();
      }
    }
    return square > 0 ? std::clamp(along / square, least_share, largest_share) : 0;
  }

  bool is_known_ = false;
  Vectors before_;  // at the end of the last frame
};

}  // namespace chainmail
