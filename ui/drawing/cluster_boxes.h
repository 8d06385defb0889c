#pragma once

#include <array>
#include <vector>

#include "drawing/mesh_level.h"
#include "simulate/frame.h"

namespace chainmail {

/// Bounding boxes of a level's clusters in the newest frame. An update computes only the boxes of clusters that
/// changed.
class ClusterBoxes {
 public:
  /// Lowest and highest coordinates on the axes of the mesh.
  struct Box {
    std::array<float, 3> lowest{}, highest{};
  };

  /// Updates the boxes to a frame of the level's mesh.
  void follow(const MeshLevelPointer& level, const Frame& frame);

  const MeshLevel& level() const { return *level_; }
  const Box& operator[](std::size_t cluster) const { return boxes_[cluster]; }

 private:
  bool isOutdated(std::size_t cluster, const Frame& frame) const;

  MeshLevelPointer level_;
  std::uint64_t seen_ = 0;  // number of the frame that the boxes belong to
  std::uint64_t series_ = 0;
  std::vector<Box> boxes_;
};

}  // namespace chainmail
