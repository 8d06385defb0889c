#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/move_history.h"
#include "simulate/solver_thread.h"

namespace chainmail {

/// Sends commands to all solvers: each receives the same commands in the same order.
/// Moves of the handle, and settings that change while a slider is dragged, are sampled. While a solver is busy, the
/// newest command of this kind waits and replaces the one that waited before, for all solvers. So a slow solver never
/// lags behind. All other commands are sent at once, after any waiting command. Only one thread may use this object.
class CommandLog {
 public:
  /// `posted` is called after each command that was posted.
  explicit CommandLog(std::vector<SolverThread*> solvers, std::function<void(const Command&)> posted = {})
      : solvers_(std::move(solvers)), posted_(std::move(posted)) {}

  /// Sends a command to all solvers and records it, or lets it wait.
  void post(const Command& command);
  /// Sends a command to one solver only, after any waiting command.
  void post_to(SolverThread& solver, const Command& command);
  /// Sends a command to all solvers without recording it: it is already recorded, or must not be.
  void replay(const Command& command);
  /// Ends the repetition of recorded relaxation: all solvers use the last setting again. Call this before a replay
  /// begins again.
  void end_replay();
  /// Returns the recorded commands.
  MoveHistory& history() { return history_; }
  const MoveHistory& history() const { return history_; }
  /// Adds or removes a solver, after any waiting command.
  void add(SolverThread& solver);
  void remove(const SolverThread& solver);
  /// Records what relaxation has done since the last command, and calls questions[i] on the thread of solver i in that
  /// state: see SolverThread::ask.
  void ask_all(const std::vector<SolverThread::Question>& questions);
  /// Sends the waiting command. Call this before you use a solver directly.
  void flush();
  /// Sends the waiting command if every solver is idle. Call this each time a solver becomes idle.
  void sample();
  bool waits() const { return waiting_.has_value(); }

 private:
  bool solvers_are_idle() const;
  void send(const Command& command);
  void send_to_all(const Command& command, const std::shared_ptr<commands::SliceCounts>& counts);
  std::shared_ptr<commands::SliceCounts> new_counts() const;
  std::shared_ptr<commands::SliceCounts> record_relaxation();
  void follow(const Command& command);
  void end_repetition();

  std::vector<SolverThread*> solvers_;
  std::function<void(const Command&)> posted_;
  std::optional<Command> waiting_;
  MoveHistory history_;
  commands::SetRelaxation relaxation_;  // as sent last
  bool repeats_ = false;                // the solvers repeat recorded relaxation, and do so as long as a replay goes on
  commands::Relaxed::Start start_ = commands::Relaxed::Start::goes_on;  // what happened since the last note
};

}  // namespace chainmail
