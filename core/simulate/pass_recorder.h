#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "mesh/element_blocks.h"
#include "simulate/simulation.h"
#include "solve/recorded_pass.h"

namespace chainmail {

/// Keeps the last pass of a simulation for another thread. Costs nothing while it is off; while it is on, a copy of the
/// positions, and of what each pass changed.
class PassRecorder {
 public:
  /// Turns recording on or off. Off drops the record. For the reading thread.
  void set_on(bool on);
  /// Returns the last pass, unless its number is `seen`; none before the first pass and while a pass is running.
  std::unique_ptr<RecordedPass> last(std::uint64_t seen) const;

  /// For the thread of the simulation: call these around each command, and before changes of positions are forgotten.
  void begin(const Command& command, Simulation& simulation);
  void end(Simulation& simulation);
  void note_changes(const Simulation& simulation);

 private:
  void follow(const Simulation& simulation);
  void copy(const Simulation& simulation, ElementId first, ElementId end);
  void write(const Simulation& simulation);

  std::atomic<bool> on_ = false;
  mutable std::mutex mutex_;  // guards the two below
  RecordedPass record_;       // `before` holds the positions at the beginning of the last pass
  bool is_whole_ = false;

  // Used by the thread of the simulation only:
  bool runs_ = false;  // between begin and end of a command that may be a pass
  std::uint64_t passes_ = 0;
  Trace trace_;
  ElementBlocks pending_;  // changed since record_.before was taken
  std::shared_ptr<const PassConditions> conditions_;
};

}  // namespace chainmail
