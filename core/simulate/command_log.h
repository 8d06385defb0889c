#pragma once

#include <optional>
#include <vector>

#include "simulate/solver_thread.h"

namespace chainmail {

/// The one log that feeds all solvers: each gets the same commands in the same order.
///
/// Moves of the hand and settings that a slider drags along are sampled: while a solver is busy, the
/// last one not yet sent is replaced by the next of its kind, for all solvers, so that a slow one never
/// falls behind the hand. All other commands are sent at once, after what waited before them. Belongs to
/// one thread.
class CommandLog {
 public:
  explicit CommandLog(std::vector<SolverThread*> solvers) : solvers_(std::move(solvers)) {}

  void post(const Command& command);
  /// Sends a command to one solver alone, after what waited before it.
  void post_to(SolverThread& solver, const Command& command);
  /// Sends the waiting command if every solver is idle; to be called 60 times a second while one waits.
  void sample();
  bool waits() const { return waiting_.has_value(); }

 private:
  void send(const Command& command);
  void flush();

  std::vector<SolverThread*> solvers_;
  std::optional<Command> waiting_;
};

}  // namespace chainmail
