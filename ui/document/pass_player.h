#pragma once

#include <memory>

#include "simulate/frame.h"
#include "solve/waiting_history.h"

namespace chainmail {

/// A panel's last pass, held at one of its steps: the object as it stood, and what waited.
class PassPlayer {
 public:
  static constexpr std::uint32_t never = no_element;
  /// Of a longer pass no waiting list is worked out, which would hold the window up (0.3 s for as many steps).
  static constexpr std::size_t listedSteps = 300'000;

  /// Takes a pass, at its end.
  explicit PassPlayer(std::unique_ptr<RecordedPass> pass, const Statistics& statistics);

  const RecordedPass& pass() const { return *pass_; }
  const WaitingHistory& history() const { return history_; }
  std::size_t stepCount() const { return pass_->step_count(); }
  std::size_t step() const { return step_; }
  /// Time: the number of steps between.
  void setStep(std::size_t step);

  /// The object at this step, as a frame that a panel can show.
  const Frame& frame() const { return frame_; }
  /// The step at which an element was updated: 0 the grabbed one and those pinned, from 1 on the others, or never.
  std::uint32_t updatedAt(ElementId element) const { return updatedAt_[element]; }

 private:
  void place(ElementId element, std::span<const float> at);

  std::unique_ptr<RecordedPass> pass_;
  WaitingHistory history_;
  std::vector<std::uint32_t> updatedAt_;
  Frame frame_;
  std::size_t step_ = 0;
};

}  // namespace chainmail
