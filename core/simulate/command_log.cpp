#include "simulate/command_log.h"

#include <algorithm>
#include <utility>

namespace chainmail {
namespace {

using Start = commands::Relaxed::Start;

}  // namespace

/// Records what relaxation did before a command, if that can matter to it. While it sleeps after undo, it does nothing,
/// which only a command that makes it go on must know.
void CommandLog::send(const Command& command) {
  using namespace commands;
  if (!is_one_of<KeepState, DropState>(command)) {
    end_repetition();
  }
  const bool is_setting = is_one_of<SetAlgorithm, SetElastic, DropState>(command);
  const bool moves_nothing = is_one_of<KeepState, SetRelaxation>(command);
  std::shared_ptr<SliceCounts> counts;
  if (relaxation_.on && !is_setting && !(start_ == Start::asleep && moves_nothing)) {
    // What was done before the object returns to another state is noted for nobody.
    counts = is_one_of<RestoreState, ReplaceMesh>(command) ? new_counts() : record_relaxation();
  }
  send_to_all(command, counts);
  history_.note(command);
  follow(command);
}

void CommandLog::end_repetition() {
  if (std::exchange(repeats_, false)) {
    send_to_all(relaxation_, nullptr);
  }
}

void CommandLog::follow(const Command& command) {
  if (const auto* set = std::get_if<commands::SetRelaxation>(&command)) {
    const bool begins = set->on && (!relaxation_.on || set->scheme != relaxation_.scheme ||
                                    set->local != relaxation_.local || set->anew);
    start_ = begins ? Start::awake : start_;
    relaxation_ = *set;
  } else if (is_one_of<commands::RestoreState, commands::ReplaceMesh>(command)) {
    start_ = Start::asleep;
  }
}

std::shared_ptr<commands::SliceCounts> CommandLog::new_counts() const {
  return std::make_shared<commands::SliceCounts>(solvers_.size());
}

std::shared_ptr<commands::SliceCounts> CommandLog::record_relaxation() {
  auto counts = new_counts();
  history_.note(commands::Relaxed{relaxation_.scheme, relaxation_.step, std::exchange(start_, Start::goes_on), counts,
                                  0, relaxation_.local});
  return counts;
}

void CommandLog::ask_all(const std::vector<SolverThread::Question>& questions) {
  flush();
  const auto counts = relaxation_.on && start_ != Start::asleep ? record_relaxation() : nullptr;
  for (std::size_t i = 0; i < solvers_.size(); ++i) {
    solvers_[i]->ask(questions[i], {counts, i});
  }
}

/// What relaxation did differs between the solvers. `counts`, if any, are noted before.
void CommandLog::send_to_all(const Command& command, const std::shared_ptr<commands::SliceCounts>& counts) {
  for (std::size_t i = 0; i < solvers_.size(); ++i) {
    Command own = command;
    if (auto* relaxed = std::get_if<commands::Relaxed>(&own)) {
      relaxed->panel = i;
    }
    try {
      solvers_[i]->post(std::move(own), {counts, i});
    } catch (...) {
      for (; counts && i < solvers_.size(); ++i) {
        counts->note(i, Algorithm::natural_queue, 0);  // or readers would wait for ever
      }
      throw;
    }
  }
}

void CommandLog::flush() {
  if (waiting_) {
    send(*waiting_);
    waiting_.reset();
  }
}

void CommandLog::post(const Command& command) {
  using namespace commands;
  if (waiting_ && waiting_->index() != command.index()) {
    flush();
  }
  const bool is_sampled = is_one_of<Drag, SetSoftness, SetRelaxation, SetElastic>(command);
  if (is_sampled) {
    waiting_ = command;  // also if the solvers are idle: if it cannot be sent now, it is sent later
  }
  if (!is_sampled || solvers_are_idle()) {
    send(command);
    waiting_.reset();
  }
  if (posted_) {
    posted_(command);
  }
}

void CommandLog::post_to(SolverThread& solver, const Command& command) {
  flush();
  solver.post(command);
}

void CommandLog::replay(const Command& command) {
  flush();
  repeats_ = repeats_ || is_one_of<commands::Relaxed>(command);
  send_to_all(command, relaxation_.on ? new_counts() : nullptr);
  follow(command);
}

void CommandLog::end_replay() {
  flush();
  end_repetition();
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
  if (solvers_are_idle()) {
    flush();
  }
}

bool CommandLog::solvers_are_idle() const { return std::ranges::all_of(solvers_, &SolverThread::idle); }

}  // namespace chainmail
