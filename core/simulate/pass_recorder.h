#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "mesh/element_blocks.h"
#include "simulate/simulation.h"
#include "solve/recorded_pass.h"

namespace chainmail {

/// Keeps the last pass of a simulation for whoever wants to look at it, by another thread. Switched off, it costs
/// nothing; switched on, what a pass changed, and a copy of the positions in advance.
class PassRecorder {
 public:
  /// For the thread that looks. What was recorded is forgotten when it is switched off.
  void set_on(bool on);
  /// The last pass, unless that is the one with this number; none as long as there is none, and while one is under
  /// way.
  std::unique_ptr<RecordedPass> last(std::uint64_t seen) const;

  /// For the thread of the simulation, about each command and before the changes of positions are forgotten.
  void begin(const Command& command, Simulation& simulation);
  void end(Simulation& simulation);
  void note_changes(const Simulation& simulation);

 private:
  void follow(const Simulation& simulation);
  void copy(const Simulation& simulation, ElementId first, ElementId end);
  void write(const Simulation& simulation);

  std::atomic<bool> on_ = false;
  mutable std::mutex mutex_;  // guards the two below
  RecordedPass record_;       // before: where all stood when the last pass began
  bool is_whole_ = false;

  // Of the thread of the simulation alone:
  bool runs_ = false;  // between begin and end of a command that may be a pass
  std::uint64_t passes_ = 0;
  Trace trace_;
  ElementBlocks pending_;  // changed since record_.before was taken
  std::shared_ptr<const PassConditions> conditions_;
};

}  // namespace chainmail
