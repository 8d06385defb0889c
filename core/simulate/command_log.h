#pragma once

#include <optional>
#include <vector>

#include "simulate/solver_thread.h"
#include "simulate/tape.h"

namespace chainmail {

/// The one log that feeds all solvers: each gets the same commands in the same order.
///
/// Moves of the handle and settings on a slider are sampled: while a solver is busy, the last one not
/// yet sent is replaced by the next of its kind, for all solvers, so that a slow one never falls behind
/// the mouse. All other commands are sent at once, after what waited before them. Belongs to
/// one thread.
class CommandLog {
 public:
  explicit CommandLog(std::vector<SolverThread*> solvers) : solvers_(std::move(solvers)) {}

  void post(const Command& command);
  /// Sends a command to one solver alone, after what waited before it.
  void post_to(SolverThread& solver, const Command& command);
  /// Sends to all a command that is on the tape already, or is to leave no mark there.
  void replay(const Command& command);
  /// Of all that was sent.
  Tape& tape() { return tape_; }
  const Tape& tape() const { return tape_; }
  /// One more, or one less, after what waited before.
  void add(SolverThread& solver);
  void remove(const SolverThread& solver);
  /// Sends what waits; to be called before something is asked of a solver past this log.
  void flush();
  /// Sends the waiting command if every solver is idle; to be called after each post, and each time a solver becomes
  /// idle.
  void sample();
  bool waits() const { return waiting_.has_value(); }

 private:
  void send(const Command& command);
  void send_to_all(const Command& command);

  std::vector<SolverThread*> solvers_;
  std::optional<Command> waiting_;
  Tape tape_;
};

}  // namespace chainmail
