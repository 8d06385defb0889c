#include "simulate/command_log.h"

#include <algorithm>

namespace chainmail {

void CommandLog::send(const Command& command) {
  for (SolverThread* solver : solvers_) {
    solver->post(command);
  }
}

void CommandLog::post(const Command& command) {
  if (const auto* move = std::get_if<commands::Drag>(&command)) {
    move_ = *move;
    return;
  }
  if (move_) {
    send(*move_);
    move_.reset();
  }
  send(command);
}

void CommandLog::sample() {
  if (move_ && std::all_of(solvers_.begin(), solvers_.end(), [](const SolverThread* one) { return one->idle(); })) {
    send(*move_);
    move_.reset();
  }
}

}  // namespace chainmail
