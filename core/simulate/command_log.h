#pragma once

#include <optional>
#include <vector>

#include "simulate/solver_thread.h"

namespace chainmail {

/// The one log that feeds all solvers: each gets the same commands in the same order.
///
/// Moves of the hand are sampled: while a solver is busy, the last unsent move is replaced, for all of
/// them, so that a slow one never falls behind the hand. All other commands are sent at once, after the
/// move that came before them. Belongs to one thread.
class CommandLog {
 public:
  explicit CommandLog(std::vector<SolverThread*> solvers) : solvers_(std::move(solvers)) {}

  void post(const Command& command);
  /// Sends the waiting move if every solver is idle; to be called 60 times a second while one waits.
  void sample();
  bool move_waits() const { return move_.has_value(); }

 private:
  void send(const Command& command);

  std::vector<SolverThread*> solvers_;
  std::optional<commands::Drag> move_;
};

}  // namespace chainmail
