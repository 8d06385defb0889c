#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// A picture of a simulation for whoever draws it.
struct Frame {
  static constexpr ElementId block_elements = ElementBlocks::block_elements;

  MeshPointer mesh;
  /// Current positions, element by element, mesh->space_dimension coordinates each (mesh units).
  std::vector<float> positions;
  /// One a block of block_elements elements, in id order: the number of the frame in which a position of the block
  /// last changed. Whoever has shown frame n needs the blocks above n alone; of another mesh, all of them.
  std::vector<std::uint64_t> changed;
  /// The control points of free-form deformation, space_dimension coordinates each (mesh units); none by others.
  std::vector<float> control_points;
  Statistics statistics;
  std::uint64_t number = 0;
  /// Numbers of frames of another series say nothing of this one's: whoever has shown one needs all blocks.
  std::uint64_t series = 0;

  /// The positions as they are read in place; valid as long as the frame stays as it is.
  PositionView view() const {
    return {positions.data(), mesh->space_dimension * sizeof(float), Precision::single_precision};
  }
};

/// Hands frames from one writer to one reader without locks: three frames, of which each side owns one
/// and the third changes hands.
class TripleBuffer {
 public:
  static constexpr unsigned frame_count = 3;

  /// The writer's own frame, to be filled and then published.
  Frame& back() { return frames_[back_]; }
  /// Which of the frames that is, below frame_count.
  unsigned back_index() const { return back_; }
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

  std::array<Frame, frame_count> frames_;
  unsigned back_ = 0;  // the writer's
  std::atomic<unsigned> middle_ = 1;
  unsigned front_ = 2;  // the reader's
};

}  // namespace chainmail
