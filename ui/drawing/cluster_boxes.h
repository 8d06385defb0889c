#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "drawing/mesh_level.h"
#include "simulate/frame.h"

namespace chainmail {

/// Bounding boxes of a level's clusters in the newest frame. A box is computed when it is asked for, and again only
/// after its cluster changed.
class ClusterBoxes {
 public:
  /// Lowest and highest coordinates on the axes of the mesh.
  struct Box {
    std::array<float, 3> lowest{}, highest{};
  };

  /// Turns to a frame of the level's mesh. It must stay until the last box of it was asked for.
  void follow(const MeshLevelPointer& level, const Frame& frame);
  /// Turns to a frame, and computes boxes ahead for some time. Returns true if all are computed.
  bool prepare(const MeshLevelPointer& level, const Frame& frame, std::chrono::milliseconds time);

  const MeshLevel& level() const { return *level_; }
  const Box& operator[](std::size_t cluster) const;

 private:
  bool isOutdated(std::size_t cluster) const;

  MeshLevelPointer level_;
  const Frame* frame_ = nullptr;
  std::uint64_t series_ = 0;
  std::optional<std::uint64_t> prepared_;  // number of the frame for which all boxes are computed
  mutable std::vector<Box> boxes_;
  mutable std::vector<std::uint64_t> seen_;  // per cluster: number of the frame that its box belongs to
};

}  // namespace chainmail
