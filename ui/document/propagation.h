#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include "chainmail/recorded_pass.h"
#include "document/document.h"
#include "simulate/frame.h"

namespace chainmail {

/// A recorded pass at one of its steps: the object and the waiting list at that step.
class PassPlayer {
 public:
  static constexpr std::uint32_t never = no_element;
  /// Largest number of steps for which the waiting list is computed, which takes 0.3 s. A longer pass would block the
  /// window.
  static constexpr std::size_t listedSteps = 300'000;

  /// Takes a recorded pass; the current step is its last one.
  explicit PassPlayer(std::unique_ptr<RecordedPass> pass, const Statistics& statistics);

  const RecordedPass& pass() const { return *pass_; }
  const WaitingHistory& history() const { return history_; }
  std::size_t stepCount() const { return pass_->step_count(); }
  std::size_t step() const { return step_; }
  /// Goes to a step. The time is proportional to the number of steps between the current one and `step`.
  void setStep(std::size_t step);

  /// The object at this step, as a frame for a panel.
  const Frame& frame() const { return frame_; }
  /// The step that updated an element: 0 for the handle and pinned elements, 1 and more for the others, or never.
  std::uint32_t updatedAt(ElementId element) const { return updatedAt_[element]; }

 private:
  void move(ElementId element, std::span<const float> to);

  std::unique_ptr<RecordedPass> pass_;
  WaitingHistory history_;
  std::vector<std::uint32_t> updatedAt_;
  Frame frame_;
  std::size_t step_ = 0;
};

/// Shows the last pass of every panel step by step.
///
/// While it is open, the solvers record their passes. It follows the newest passes until the user goes to a step. Then
/// it keeps that pass, and the panels show the object at this step. A drag or a change of the object makes it follow
/// again.
class Propagation : public QObject {
  Q_OBJECT

 public:
  explicit Propagation(Document& document);
  ~Propagation() override;

  void setOpen(bool open);
  bool isOpen() const { return open_; }
  /// Shows the passes over the objects, or hides them and keeps them: while the dock is behind another one.
  void setShown(bool shown);
  bool isShown() const { return open_ && shown_; }
  /// While held, propagation stays as it is although its dock is hidden.
  void setHeld(bool held) { held_ = held; }
  bool showsNewest() const { return showsNewest_; }
  void setShowsNewest(bool newest);

  /// Returns the pass of a panel; null while there is none of the current object.
  const PassPlayer* player(int panel) const { return players_[std::size_t(panel)].get(); }
  bool hasPass() const;
  /// Number of steps of the longest pass.
  std::size_t stepCount() const;

  /// True if all panels go to the same step, each at most to the end of its pass; false if only the chosen panel does.
  bool together() const { return together_; }
  void setTogether(bool together);
  int chosen() const { return chosen_; }
  void choose(int panel);
  /// Stops following and goes to a step, in this panel or, if together(), in all panels.
  void setStep(int panel, std::size_t step);
  /// Moves by `steps`, from the step of the chosen panel or, if together(), from the furthest step of all panels.
  void stepBy(std::ptrdiff_t steps);
  void goTo(std::size_t step) { setStep(chosen_, step); }

  bool plays() const { return clock_.isActive(); }
  void setPlays(bool plays);
  /// Sets the speed in steps per second.
  void setSpeed(double speed) { speed_ = speed; }
  double speed() const { return speed_; }

 signals:
  /// The passes, the step or a setting has changed.
  void changed();

 private:
  void awaitPass();
  bool lacksPass() const;
  bool tooLargeNow() const;
  void takePasses();
  void letGo();
  void forget();
  void show(int panel);
  bool atEnd() const;
  std::size_t position() const;
  void playOn();

  Document& document_;
  std::vector<std::unique_ptr<PassPlayer>> players_;
  bool open_ = false;
  bool shown_ = false;
  bool held_ = false;
  bool showsNewest_ = true;
  bool together_ = true;
  int chosen_ = 0;
  QTimer fetch_;  // limits how often passes are fetched
  QTimer clock_;  // runs during slow motion
  QElapsedTimer sinceStep_;
  double speed_ = 5;  // steps per second
  double due_ = 0;    // steps still to make, with a fraction
};

}  // namespace chainmail
