#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulate/frame.h"

namespace chainmail {

/// Fills frames from a simulation and publishes them. Each frame copies only the blocks that changed
/// since it was last filled.
class FrameWriter {
 public:
  explicit FrameWriter(FrameExchange& frames) : frames_(frames) {}

  /// Publishes a frame of the current state. The simulation must be the same in every call. If memory runs out, no
  /// frame is published, and a later call tries it again.
  void publish(Simulation& simulation);
  /// Number of the last frame.
  std::uint64_t number() const { return number_; }

 private:
  void note_changes(Simulation& simulation);
  void fill(Frame& frame, ElementBlocks& pending, Simulation& simulation);

  FrameExchange& frames_;
  const std::uint64_t series_ = new_series();
  std::uint64_t number_ = 0;
  // State of the newest frame:
  MeshPointer mesh_;
  std::vector<std::uint64_t> changed_;
  /// For each of the two frames, the blocks of this mesh that changed since it was last filled.
  std::array<ElementBlocks, FrameExchange::frame_count> pending_;
};

}  // namespace chainmail
