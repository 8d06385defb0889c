#pragma once

#include <QElapsedTimer>
#include <QFrame>
#include <QLabel>
#include <atomic>

#include "docks/size_test/size_test.h"
#include "docks/size_test/size_test_view.h"
#include "report/run/ramp_rule.h"
#include "report/run/scripted_drags.h"
#include "simulate/solver_thread.h"

namespace chainmail {

/// One panel of the size test: a solver, its grid, and the scripted drags.
///
/// The next move starts when the previous one is computed and painted, at most 60 times per second. Every pass is
/// measured, and no panel waits for another.
class SizeTestPanel : public QFrame {
  Q_OBJECT

 public:
  SizeTestPanel(const SizeTestContestant& contestant, const Softness& softness, const MeshPointer& mesh,
                std::shared_ptr<MeshLevels> levels);

  /// Starts these drags, each from the rest positions. The first one is a warm-up and is not measured.
  void begin(const MeshPointer& mesh, std::vector<report::ScriptedDrag> drags);
  /// Ends the drags: the solver gets no more commands.
  void halt() { running_ = false; }
  bool running() const { return running_; }
  /// True when the solver has carried out all commands.
  bool idle() const { return solver_.idle(); }

  const SizeTestContestant& contestant() const { return contestant_; }
  const report::RampPasses& passes() const { return passes_; }
  /// Frames per second, painted in the last second of the drags.
  int painted() const { return painted_; }
  /// Completed share of the moves, from 0 to 1.
  double share() const;
  void say(const QString& state) { state_->setText(state); }

 signals:
  /// Emitted when a move is computed.
  void moved();
  /// Emitted when all drags are complete.
  void ended();
  void failed(const QString& sentence);

 private:
  void arrange();
  void receive();
  void record(const Statistics& statistics);
  void next();

  SizeTestContestant contestant_;
  MeshPointer mesh_;
  std::vector<report::ScriptedDrag> drags_;
  std::size_t drag_ = 0, move_ = 0;  // index of the next drag and move
  bool running_ = false;
  bool moving_ = false;  // a pass is under way
  QElapsedTimer clock_;  // since the drags started
  std::uint64_t passesSeen_ = 0;
  report::RampPasses passes_;
  int painted_ = 0;
  SizeTestView* view_;
  QLabel* state_;
  std::atomic<bool> announced_ = false;  // at most one queued call to receive() at a time
  SolverThread solver_;                  // last, so that the solver ends before the members that its callback uses
};

}  // namespace chainmail
