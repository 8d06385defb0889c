#pragma once

#include <array>
#include <vector>

#include "drawing/mesh_level.h"
#include "simulate/frame.h"

namespace chainmail {

/// Bounds of what a level's cells hold in the newest frame, kept up to date for what changed alone.
class CellBoxes {
 public:
  /// Lowest and highest of the coordinates that the scene carries.
  struct Box {
    std::array<float, 3> lowest{}, highest{};
  };

  /// Takes a frame of the level's mesh over.
  void follow(const MeshLevelPointer& level, const Frame& frame);

  const MeshLevel& level() const { return *level_; }
  const Box& operator[](std::size_t cell) const { return boxes_[cell]; }

 private:
  bool isOutdated(std::size_t cell, const Frame& frame) const;

  MeshLevelPointer level_;
  std::uint64_t seen_ = 0;  // the number of the frame that the boxes are of
  std::uint64_t series_ = 0;
  std::vector<Box> boxes_;
};

}  // namespace chainmail
