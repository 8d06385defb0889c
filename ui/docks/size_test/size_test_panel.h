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

/// One side of the size test: a solver of its own, the grid it moves, and the scripted hand.
///
/// The hand makes its next move when the last one has been answered and can be seen, at most 60 a second: every pass
/// is measured, and no panel waits for another.
class SizeTestPanel : public QFrame {
  Q_OBJECT

 public:
  SizeTestPanel(const SizeTestContestant& contestant, const LinkSoftness& softness, const MeshPointer& mesh,
                std::shared_ptr<MeshLevels> levels);

  /// Makes these drags, from rest each; the first one warms up and is not measured.
  void begin(const MeshPointer& mesh, std::vector<report::ScriptedDrag> drags);
  /// The hand lets go: nothing more is asked of the solver.
  void halt() { running_ = false; }
  bool running() const { return running_; }
  /// Whether the solver has done all that was asked of it.
  bool idle() const { return solver_.idle(); }

  const SizeTestContestant& contestant() const { return contestant_; }
  const report::RampPasses& passes() const { return passes_; }
  /// Frames painted in the last second of the drags.
  int painted() const { return painted_; }
  /// How many of the moves are made, from 0 to 1.
  double share() const;
  void say(const QString& state) { state_->setText(state); }

 signals:
  /// A move was answered.
  void moved();
  /// All drags are made.
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
  std::size_t drag_ = 0, move_ = 0;  // the one to come
  bool running_ = false;
  bool moving_ = false;  // a pass was asked for
  QElapsedTimer clock_;  // since the drags began
  std::uint64_t passesSeen_ = 0;
  report::RampPasses passes_;
  int painted_ = 0;
  SizeTestView* view_;
  QLabel* state_;
  std::atomic<bool> announced_ = false;  // frames are announced at most once until they are received
  SolverThread solver_;                  // last: it ends before what it announces to
};

}  // namespace chainmail
