#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// A picture of a simulation for whoever draws it.
struct Frame {
  MeshPointer mesh;
  /// Current positions, element by element, mesh->space_dimension coordinates each (mesh units).
  std::vector<float> positions;
  Statistics statistics;
  std::uint64_t number = 0;

  /// The positions as they are read in place; valid as long as the frame stays as it is.
  PositionView view() const {
    return {positions.data(), mesh->space_dimension * sizeof(float), Precision::single_precision};
  }
};

/// Hands frames from one writer to one reader without locks: three frames, of which each side owns one
/// and the third changes hands.
class TripleBuffer {
 public:
  /// The writer's own frame, to be filled and then published.
  Frame& back() { return frames_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index; }

  /// The newest published frame; it stays as it is until this is called again.
  const Frame& latest() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) != 0) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    }
    return frames_[front_];
  }

 private:
  static constexpr unsigned index = 3;
  static constexpr unsigned fresh = 4;

  std::array<Frame, 3> frames_;
  unsigned back_ = 0;  // the writer's
  std::atomic<unsigned> middle_ = 1;
  unsigned front_ = 2;  // the reader's
};

}  // namespace chainmail
