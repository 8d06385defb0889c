#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "simulate/frame_space.h"
#include "simulate/simulation.h"

namespace chainmail {

/// The state of a simulation for drawing.
struct Frame {
  static constexpr ElementId block_elements = ElementBlocks::block_elements;

  MeshPointer mesh;
  FrameSpace space;
  /// Current positions, element by element, mesh->space_dimension coordinates each, in `space`.
  std::vector<float> positions;
  /// For each block of block_elements elements, in id order: the number of the frame in which a position of the block
  /// last changed. A reader that has shown frame n needs only the blocks with higher numbers. If the mesh has changed,
  /// it needs all blocks.
  std::vector<std::uint64_t> changed;
  Statistics statistics;
  bool is_at_rest = true;  // all elements are known to be
  std::uint64_t number = 0;
  /// Id of the series of frames. Frame numbers of different series cannot be compared: a reader needs all blocks after
  /// the series has changed.
  std::uint64_t series = 0;

  /// Returns a view of the positions in mesh units; valid while the frame does not change.
  PositionView view() const { return space.view(positions); }
};

/// Returns the id of a new series of frames.
std::uint64_t new_series();

/// Passes frames from one writer to one reader without locks, in two frames: the reader's, and the one that the writer
/// fills. The reader takes the latter once it is filled; until then, the writer may fill it again with something newer.
class FrameExchange {
 public:
  static constexpr unsigned frame_count = 2;

  /// Begins to fill a frame; publish() or give_up() ends it. Meanwhile the reader keeps the one that it has.
  Frame& begin() {
    State before = State::empty;
    while (!state_.compare_exchange_weak(before, State::being_filled, std::memory_order_acquire)) {
      before = before == State::filled ? State::filled : State::empty;  // while the reader takes it, which is short
    }
    return frames_[back_];
  }
  /// Returns the index of the frame that is being filled, below frame_count.
  unsigned index() const { return back_; }
  void publish() { state_.store(State::filled, std::memory_order_release); }
  /// Ends filling without a result: the reader keeps the frame that it has.
  void give_up() { state_.store(State::empty, std::memory_order_release); }

  /// Returns the newest published frame, or the one before while the writer fills the next one. It does not change
  /// until the next call.
  const Frame& latest() {
    State before = State::filled;
    if (state_.compare_exchange_strong(before, State::being_taken, std::memory_order_acquire)) {
      std::swap(back_, front_);
      state_.store(State::empty, std::memory_order_release);
    }
    return frames_[front_];
  }

 private:
  enum class State : unsigned { empty, being_filled, filled, being_taken };

  std::array<Frame, frame_count> frames_;
  std::atomic<State> state_ = State::empty;
  unsigned back_ = 0;   // changed in the state being_taken, read in being_filled
  unsigned front_ = 1;  // the reader's
};

}  // namespace chainmail
