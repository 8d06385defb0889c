#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "chainmail/recorded_pass.h"
#include "mesh/element_blocks.h"
#include "simulate/frame_space.h"
#include "simulate/simulation.h"

namespace chainmail {

/// Stores the last pass of a simulation for another thread. Costs nothing while it is off. While it is on, it copies
/// the positions and the changes of each pass. Without enough memory for that, a pass is not recorded.
class PassRecorder {
 public:
  /// Turns recording on or off. Turning it off drops the record. Call this on the reading thread.
  void set_on(bool on);
  /// Returns the last pass; null if its number is `seen`, before the first pass and while a pass is running. Call this
  /// on the reading thread.
  std::unique_ptr<RecordedPass> last(std::uint64_t seen) const;

  /// Call these on the simulation's thread: begin() and end() around each command, and note_changes() before
  /// Simulation::forget_changes().
  void begin(const Command& command, Simulation& simulation);
  void end(Simulation& simulation);
  void note_changes(const Simulation& simulation);

 private:
  void follow(const Simulation& simulation);
  void copy(const Simulation& simulation, ElementId first, ElementId end);
  void write(const Simulation& simulation);
  void finish(const Simulation& simulation);
  void give_up(Simulation& simulation);

  std::atomic<bool> on_ = false;
  mutable std::mutex mutex_;  // guards the two below
  FrameSpace space_;          // of the recorded mesh
  RecordedPass record_;       // `before` holds the positions at the beginning of the last pass
  bool is_whole_ = false;

  // Used only by the simulation's thread:
  bool runs_ = false;  // between begin and end of a command that may be a pass
  std::uint64_t passes_ = 0;
  std::uint64_t in_drag_ = 0;  // number of passes since the last grab
  Trace trace_;
  ElementBlocks pending_;  // blocks that changed since record_.before was copied
  std::shared_ptr<const PassConditions> conditions_;
};

}  // namespace chainmail
