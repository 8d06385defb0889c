#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// State of a simulation for drawing.
struct Frame {
  static constexpr ElementId block_elements = ElementBlocks::block_elements;

  MeshPointer mesh;
  /// Current positions, element by element, mesh->space_dimension coordinates each (mesh units).
  std::vector<float> positions;
  /// For each block of block_elements elements, in id order: the number of the frame in which a position of the block
  /// last changed. A reader that has shown frame n needs only the blocks with higher numbers; for another mesh, all of
  /// them.
  std::vector<std::uint64_t> changed;
  /// The control points of free-form deformation, space_dimension coordinates each (mesh units); empty for other
  /// algorithms.
  std::vector<float> control_points;
  Statistics statistics;
  std::uint64_t number = 0;
  /// Id of the series of frames. After a change of series a reader needs all blocks: frame numbers of different series
  /// are not comparable.
  std::uint64_t series = 0;

  /// The positions without a copy; valid while the frame does not change.
  PositionView view() const {
    return {positions.data(), mesh->space_dimension * sizeof(float), Precision::single_precision};
  }
};

/// Passes frames from one writer to one reader without locks: each side owns one of three frames, and the third is
/// exchanged.
class TripleBuffer {
 public:
  static constexpr unsigned frame_count = 3;

  /// The writer's own frame, to be filled and then published.
  Frame& back() { return frames_[back_]; }
  /// Index of that frame, below frame_count.
  unsigned back_index() const { return back_; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index; }

  /// Returns the newest published frame. It does not change until the next call.
  const Frame& latest() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) != 0) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    }
    return frames_[front_];
  }

 private:
  static constexpr unsigned index = 3;
  static constexpr unsigned fresh = 4;

  std::array<Frame, frame_count> frames_;
  unsigned back_ = 0;  // the writer's
  std::atomic<unsigned> middle_ = 1;
  unsigned front_ = 2;  // the reader's
};

}  // namespace chainmail
