#pragma once

#include <memory>

#include "chainmail/waiting_history.h"
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

}  // namespace chainmail
