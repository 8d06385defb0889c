#pragma once

#include <algorithm>
#include <vector>

#include "simulate/frame.h"

namespace chainmail::test {

/// Stands for a view that draws: it keeps the positions that it received, and takes only newer blocks from a frame.
class FrameReader {
 public:
  /// Returns true if it then has the same positions as the frame, so the stamps of the blocks are right.
  bool take(const Frame& frame) {
    if (frame.mesh != mesh_) {
      mesh_ = frame.mesh;
      positions_ = frame.positions;
    }
    const std::size_t size = Frame::block_elements * static_cast<std::size_t>(mesh_->space_dimension);
    for (std::size_t block = 0; block < frame.changed.size(); ++block) {
      if (frame.changed[block] > number_) {
        const std::size_t first = block * size, end = std::min(first + size, positions_.size());
        std::copy(frame.positions.begin() + static_cast<std::ptrdiff_t>(first),
                  frame.positions.begin() + static_cast<std::ptrdiff_t>(end),
                  positions_.begin() + static_cast<std::ptrdiff_t>(first));
      }
    }
    number_ = frame.number;
    return positions_ == frame.positions && positions_.size() == mesh_->rest.size() &&
           frame.changed.size() == (mesh_->element_count() + Frame::block_elements - 1) / Frame::block_elements &&
           std::all_of(frame.changed.begin(), frame.changed.end(), [&](auto stamp) { return stamp <= number_; });
  }
  std::uint64_t number() const { return number_; }

 private:
  MeshPointer mesh_;
  std::vector<float> positions_;
  std::uint64_t number_ = 0;
};

}  // namespace chainmail::test
