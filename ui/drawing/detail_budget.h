#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

namespace chainmail {

/// Chooses from measured times how much of an object is drawn while it moves. At rest, everything is drawn.
class DetailBudget {
 public:
  /// The pictures of an object: quick while it moves; complete, with smooth edges and occlusion, at rest.
  enum class Detail { quick, complete };

  /// Takes note of a complete picture that took this long (ms).
  void tookComplete(double milliseconds) { complete_ = milliseconds; }
  /// Takes note of a quick picture with this many links and faces. Small pictures say little about large ones. Slow
  /// pictures count more than fast ones, because a lag is felt more than missing detail.
  void tookQuick(std::size_t shapes, double milliseconds) {
    if (shapes > minShapes / 2) {
      const double affordable = double(shapes) * longestFrame / std::max(milliseconds, 0.1);
      const double weight = affordable < maxShapes_ ? 0.7 : 0.3;
      maxShapes_ = std::clamp(maxShapes_ + weight * (affordable - maxShapes_), double(minShapes), double(maxAtRest));
    }
  }

  /// Number of links and faces that may be drawn while the object moves.
  std::size_t maxShapes() const { return std::size_t(maxShapes_); }
  /// True if complete pictures are fast enough to follow the mouse.
  bool affordsComplete() const { return complete_ && *complete_ < shortFrame; }

  static constexpr std::size_t minShapes = 60'000;  // always drawn
  static constexpr std::size_t maxAtRest = 3'000'000;

 private:
  static constexpr double longestFrame = 33, shortFrame = 12;  // ms

  std::optional<double> complete_;  // duration of the last complete picture (ms)
  double maxShapes_ = 300'000;
};

}  // namespace chainmail
