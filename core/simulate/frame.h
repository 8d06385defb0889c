#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// The state of a simulation for drawing.
struct Frame {
  static constexpr ElementId block_elements = ElementBlocks::block_elements;

  MeshPointer mesh;
  /// Current positions, element by element, mesh->space_dimension coordinates each (mesh units).
  std::vector<float> positions;
  /// For each block of block_elements elements, in id order: the number of the frame in which a position of the block
  /// last changed. A reader that has shown frame n needs only the blocks with higher numbers. If the mesh has changed,
  /// it needs all blocks.
  std::vector<std::uint64_t> changed;
  /// The control points of free-form deformation, space_dimension coordinates each (mesh units); empty for other
  /// algorithms.
  std::vector<float> control_points;
  Statistics statistics;
  std::uint64_t number = 0;
  /// Id of the series of frames. Frame numbers of different series cannot be compared: a reader needs all blocks after
  /// the series has changed.
  std::uint64_t series = 0;

  /// Returns a view of the positions; valid while the frame does not change.
  PositionView view() const {
    return {positions.data(), mesh->space_dimension * sizeof(float), Precision::single_precision};
  }
};

/// Passes frames from one writer to one reader without locks. Each side owns one of three frames, and they exchange the
/// third.
class TripleBuffer {
 public:
  static constexpr unsigned frame_count = 3;

  /// Returns the writer's own frame. Fill it, then publish it.
  Frame& back() { return frames_[back_]; }
  /// Returns the index of the writer's own frame, below frame_count.
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
  unsigned back_ = 0;  // index of the writer's frame
  std::atomic<unsigned> middle_ = 1;
  unsigned front_ = 2;  // index of the reader's frame
};

}  // namespace chainmail
