#pragma once

#include <QObject>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "document/change.h"
#include "simulate/command_log.h"
#include "simulate/solver_thread.h"

namespace chainmail {

/// One solver per panel, each on a thread of its own: commands go there through one log, frames come back.
class PanelSolvers : public QObject {
  Q_OBJECT

 public:
  /// `posted` is called after each command that is posted to the log.
  PanelSolvers(const Contents& contents, std::function<void(const Command&)> posted)
      : contents_(contents), posted_(std::move(posted)) {}

  /// Number of solvers.
  int count() const { return int(solvers_.size()); }
  /// Adds a solver that runs `algorithm`. The first ones begin with the object at rest; a later one copies the first
  /// solver, with its states for undo. Throws if there is no memory or no thread; nothing has changed then.
  void add(Algorithm algorithm);
  void removeLast();
  /// Replaces all solvers, which pause, by copies with a copy of the log. takeBack() drops these. Throws as add() does.
  void setAside();
  void takeBack();
  /// Sends commands to all solvers, and records them.
  CommandLog& log() { return log_; }
  const CommandLog& log() const { return log_; }
  /// Sends a command to one solver only.
  void post(int panel, const Command& command) { log_.post_to(*solvers_[std::size_t(panel)], command); }
  /// Stops sweeps of relaxation, which may run for hours.
  void cutSweeps();

  /// The frame that a panel shows, valid until the next frameReady; null while the panel has none of the current
  /// object.
  const Frame* frame(int panel) const;
  /// The statistics of a panel's newest frame, also while the panel shows another one. Valid if frame() is not null.
  const Statistics& statistics(int panel) const { return frames_[std::size_t(panel)]->statistics; }
  /// Shows `frame` instead of the panel's newest one; null shows the newest one again. The frame must stay alive until
  /// then. Call this again after each change of the frame.
  void showInstead(int panel, const Frame* frame);
  /// Turns pass recording on or off, for all solvers.
  void recordPasses(bool on);
  /// Returns a panel's last pass; null if its number is `seen`, before the first pass, and while a pass is running.
  std::unique_ptr<RecordedPass> lastPass(int panel, std::uint64_t seen) const {
    return solvers_[std::size_t(panel)]->last_pass(seen);
  }
  /// Calls `question` on the thread of a panel's solver, after all commands posted before. `question` must not block.
  void ask(int panel, SolverThread::Question question);
  /// Returns the positions of each panel's elements after all commands posted before, and records what relaxation has
  /// done until then.
  std::vector<std::future<Snapshot>> snapshots();

  /// True while all solvers have carried out all posted commands.
  bool idle() const;
  /// True while a solver has carried out all commands that were sent to it.
  bool idle(int panel) const { return solvers_[std::size_t(panel)]->idle(); }
  /// Share of a solver's long work that is done, if it reports any; from 0 to 1.
  double share(int panel) const { return solvers_[std::size_t(panel)]->share(); }
  /// True while idle() and all frames are up to date. While relaxation runs, this is true only for short moments.
  bool settled() const;
  /// Call this when the window closes. Waits up to `patience` for posted moves, then skips the rest.
  void abandonMoves(std::chrono::milliseconds patience = {});
  /// Call this if the window stays open after all.
  void goOn();
  /// Names the element that the next press would grab, if any, so that all solvers prepare its drag in idle time.
  void prepare(std::optional<ElementId> element);
  /// Number of preparations that every solver has ended.
  int prepared() const;

 signals:
  void frameReady(int panel);
  /// All solvers have carried out all posted commands.
  void becameIdle();
  /// The log has sent the command that waited.
  void sent();
  /// A solver refused a command; `sentence` gives the reason.
  void refused(int panel, const QString& sentence);

 private:
  void showOthers();
  void receiveFrame(int panel);
  void receiveIdle();
  std::function<void()> frameAnnouncer(int panel);
  std::function<void()> idleAnnouncer();

  const Contents& contents_;
  std::function<void(const Command&)> posted_;
  // True while an announcement of a solver thread (new frame, idle) waits in the event queue. Prevents a second one.
  std::array<std::atomic<bool>, Contents::maxPanels> frameAnnounced_{};
  std::atomic<bool> idleAnnounced_ = false;
  std::vector<std::unique_ptr<SolverThread>> solvers_;
  std::array<const Frame*, Contents::maxPanels> frames_{};
  std::array<const Frame*, Contents::maxPanels> instead_{};  // null if the panel shows its own frame
  bool recordsPasses_ = false;
  CommandLog log_{{}, posted_};
  std::vector<std::unique_ptr<SolverThread>> aside_;  // see setAside()
  CommandLog logAside_{{}};
};

}  // namespace chainmail
