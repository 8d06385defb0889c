#include "document/pass_player.h"

#include <algorithm>

#include "solver/algorithms.h"

namespace chainmail {
PassPlayer::PassPlayer(std::unique_ptr<RecordedPass> pass, const Statistics& statistics)
    : pass_(std::move(pass)),
      history_(stepCount() <= listedSteps ? waiting_history(*pass_) : WaitingHistory()),
      updatedAt_(pass_->mesh->element_count(), never) {
  for (const ElementId pin : pass_->conditions->pins) {
    updatedAt_[pin] = 0;
  }
  for (const ElementId element : pass_->handle) {
    updatedAt_[element] = 0;
  }
  for (std::uint32_t row = 0; row < pass_->trace.size(); ++row) {
    updatedAt_[pass_->trace[row].element] = row + 1;
  }
  frame_.mesh = pass_->mesh;
  frame_.space = FrameSpace(*pass_->mesh);
  frame_.positions = pass_->before;
  for (float& coordinate : frame_.positions) {
    coordinate /= float(frame_.space.unit());
  }
  frame_.changed.assign(ElementBlocks(pass_->mesh->element_count()).block_count(), 1);
  frame_.statistics = statistics;
  frame_.series = new_series();
  frame_.number = 1;
  for (std::size_t i = 0; i < pass_->handle.size(); ++i) {
    move(pass_->handle[i], pass_->handle_after(i));
  }
  setStep(stepCount());
}

void PassPlayer::setStep(std::size_t step) {
  step = std::min(step, stepCount());
  ++frame_.number;
  for (; step_ < step; ++step_) {
    move(pass_->trace[step_].element, pass_->position_after(step_));
  }
  for (; step_ > step; --step_) {
    const ElementId element = pass_->trace[step_ - 1].element;
    move(element, pass_->position_before(element));
  }
}

void PassPlayer::move(ElementId element, std::span<const float> to) {
  std::ranges::transform(to, frame_.positions.begin() + std::ptrdiff_t(element * to.size()),
                         [unit = float(frame_.space.unit())](float coordinate) { return coordinate / unit; });
  frame_.changed[element / Frame::block_elements] = frame_.number;
}

}  // namespace chainmail
