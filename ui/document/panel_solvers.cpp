#include "document/panel_solvers.h"

#include <QDeadlineTimer>
#include <QThread>
#include <algorithm>
#include <exception>
#include <utility>

#include "common/application.h"
#include "common/jobs.h"
#include "common/text.h"
#include "mesh/error.h"

namespace chainmail {

void PanelSolvers::add(Algorithm algorithm) {
  log_.flush();
  const int panel = count();
  auto solver =
      panel < Contents::minPanels
          ? std::make_unique<SolverThread>(contents_.object->mesh, algorithm, frameAnnouncer(panel), idleAnnouncer())
          : std::make_unique<SolverThread>(*solvers_.front(), algorithm, frameAnnouncer(panel), idleAnnouncer());
  log_.add(*solver);
  solver->record_passes(recordsPasses_);
  frames_[std::size_t(panel)] = &solver->latest_frame();
  solvers_.push_back(std::move(solver));
}

void PanelSolvers::removeLast() {
  log_.remove(*solvers_.back());
  solvers_.pop_back();
}

void PanelSolvers::setAside() {
  log_.flush();
  std::vector<std::unique_ptr<SolverThread>> copies;
  std::vector<SolverThread*> targets;
  for (int panel = 0; panel < count(); ++panel) {
    copies.push_back(std::make_unique<SolverThread>(*solvers_[std::size_t(panel)],
                                                    contents_.algorithms[std::size_t(panel)], frameAnnouncer(panel),
                                                    idleAnnouncer()));
    targets.push_back(copies.back().get());
  }
  CommandLog log(targets, posted_);
  log.history() = log_.history();
  aside_ = std::exchange(solvers_, std::move(copies));
  logAside_ = std::exchange(log_, std::move(log));
  showOthers();
  for (const auto& solver : aside_) {
    solver->pause(true);
  }
}

void PanelSolvers::takeBack() {
  const auto copies = std::exchange(solvers_, std::exchange(aside_, {}));  // end after the frames are no longer theirs
  log_ = std::move(logAside_);
  showOthers();
  for (const auto& solver : solvers_) {
    solver->pause(false);
  }
}

void PanelSolvers::showOthers() {
  for (std::size_t panel = 0; panel < solvers_.size(); ++panel) {
    solvers_[panel]->record_passes(recordsPasses_);
    frames_[panel] = &solvers_[panel]->latest_frame();
    Application::guarded([&] { emit frameReady(int(panel)); });
  }
}

void PanelSolvers::cutSweeps() {
  for (const auto& solver : solvers_) {
    solver->cut_sweeps();
  }
}

// Frames

const Frame* PanelSolvers::frame(int panel) const {
  if (panel >= count()) {
    return nullptr;
  }
  const Frame* instead = instead_[std::size_t(panel)];
  const Frame* frame = instead != nullptr ? instead : frames_[std::size_t(panel)];
  return frame->mesh == contents_.object->mesh ? frame : nullptr;
}

void PanelSolvers::showInstead(int panel, const Frame* frame) {
  if (frame != nullptr || instead_[std::size_t(panel)] != nullptr) {
    instead_[std::size_t(panel)] = frame;
    emit frameReady(panel);
  }
}

void PanelSolvers::receiveFrame(int panel) {
  frameAnnounced_[std::size_t(panel)] = false;
  if (panel >= count()) {
    return;  // the panel was removed in the meantime
  }
  SolverThread& solver = *solvers_[std::size_t(panel)];
  frames_[std::size_t(panel)] = &solver.latest_frame();
  if (const std::string error = solver.take_error(); !error.empty()) {
    emit refused(panel, QString::fromStdString(error));
  }
  emit frameReady(panel);
}

/// Called when a solver has become idle. Sends the newest move, which waits for the slowest solver, as soon as all are
/// idle.
void PanelSolvers::receiveIdle() {
  idleAnnounced_ = false;
  if (log_.waits()) {
    log_.sample();
    if (!log_.waits()) {
      emit sent();
    }
  }
  if (idle()) {
    emit becameIdle();
  }
}

std::function<void()> PanelSolvers::frameAnnouncer(int panel) {
  return [this, panel] {
    announceOnce(frameAnnounced_[std::size_t(panel)], this, [this, panel] { receiveFrame(panel); });
  };
}

std::function<void()> PanelSolvers::idleAnnouncer() {
  return [this] { announceOnce(idleAnnounced_, this, &PanelSolvers::receiveIdle); };
}

// Questions

void PanelSolvers::recordPasses(bool on) {
  recordsPasses_ = on;
  for (const auto& solver : solvers_) {
    solver->record_passes(on);
  }
}

void PanelSolvers::ask(int panel, SolverThread::Question question) {
  log_.flush();
  solvers_[std::size_t(panel)]->ask(std::move(question));
}

std::vector<std::future<Snapshot>> PanelSolvers::snapshots() {
  std::vector<std::future<Snapshot>> result;
  std::vector<SolverThread::Question> questions;
  for (int panel = 0; panel < count(); ++panel) {
    const auto promise = std::make_shared<std::promise<Snapshot>>();
    result.push_back(promise->get_future());
    questions.emplace_back([promise, panel, mesh = contents_.object->mesh](const Simulation& simulation) {
      try {
        if (simulation.mesh_pointer() != mesh) {
          throw Error("panel " + panelName(panel).toStdString(), "its solver could not take over the object",
                      "undo the last step");
        }
        promise->set_value(simulation.snapshot());
      } catch (...) {
        promise->set_exception(std::current_exception());
      }
    });
  }
  log_.ask_all(questions);
  return result;
}

// Idle time

bool PanelSolvers::idle() const {
  return !log_.waits() && std::ranges::all_of(solvers_, [](auto& one) { return one->idle(); });
}

bool PanelSolvers::settled() const {
  for (std::size_t panel = 0; panel < solvers_.size(); ++panel) {
    const SolverThread& solver = *solvers_[panel];
    if (!solver.settled() || frames_[panel]->number != solver.newest_frame()) {
      return false;
    }
  }
  return !log_.waits() && std::ranges::none_of(frameAnnounced_, [](auto& one) { return one.load(); });
}

void PanelSolvers::abandonMoves(std::chrono::milliseconds patience) {
  log_.flush();
  for (const QDeadlineTimer end(patience); !idle() && !end.hasExpired();) {
    QThread::msleep(1);
  }
  for (const auto& solver : solvers_) {
    solver->abandon();
  }
}

void PanelSolvers::goOn() {
  for (const auto& solver : solvers_) {
    solver->go_on();
  }
}

void PanelSolvers::prepare(std::optional<ElementId> element) {
  for (const auto& solver : solvers_) {
    solver->prepare(element);
  }
}

int PanelSolvers::prepared() const {
  const auto of = [](const auto& solver) { return solver->prepared(); };
  return of(*std::ranges::min_element(solvers_, {}, of));
}

}  // namespace chainmail
