#include "simulate/command_log.h"

#include <algorithm>

namespace chainmail {

void CommandLog::send(const Command& command) {
  history_.note(command);
  send_to_all(command);
}

void CommandLog::send_to_all(const Command& command) {
  for (SolverThread* solver : solvers_) {
    solver->post(command);
  }
}

void CommandLog::flush() {
  if (waiting_) {
    send(*waiting_);
    waiting_.reset();
  }
}

void CommandLog::post(const Command& command) {
  const bool sampled = std::holds_alternative<commands::Drag>(command) ||
                       std::holds_alternative<commands::SetSoftness>(command) ||
                       std::holds_alternative<commands::SetRelaxation>(command) ||
                       std::holds_alternative<commands::SetElastic>(command) ||
                       std::holds_alternative<commands::MoveControlPoint>(command);
  if (waiting_ && waiting_->index() != command.index()) {
    flush();
  }
  if (sampled) {
    waiting_ = command;
  } else {
    send(command);
  }
}

void CommandLog::post_to(SolverThread& solver, const Command& command) {
  flush();
  solver.post(command);
}

void CommandLog::replay(const Command& command) {
  flush();
  send_to_all(command);
}

void CommandLog::add(SolverThread& solver) {
  flush();
  solvers_.push_back(&solver);
}

void CommandLog::remove(const SolverThread& solver) {
  flush();
  std::erase(solvers_, &solver);
}

void CommandLog::sample() {
  if (std::all_of(solvers_.begin(), solvers_.end(), [](const SolverThread* one) { return one->idle(); })) {
    flush();
  }
}

}  // namespace chainmail
