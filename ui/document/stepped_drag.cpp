#include "document/stepped_drag.h"

#include <algorithm>
#include <utility>

namespace chainmail {

SteppedDrag::SteppedDrag(Document& document) : document_(document) {
  connect(&document.solvers(), &PanelSolvers::becameIdle, this, &SteppedDrag::step);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, [this](int panel) {
    shown_ = shown_ || panel == 0;
    step();
  });
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, &SteppedDrag::stop);
}

void SteppedDrag::start(ElementId element, const Point& from, const Point& target, int steps) {
  begin({element}, steps);
  from_ = from;
  target_ = target;
  relative_ = false;
}

void SteppedDrag::start(const std::vector<ElementId>& elements, const Point& by, const Rotation& rotation, int steps) {
  begin(elements, steps);
  by_ = by;
  rotation_ = rotation;
  relative_ = true;
}

void SteppedDrag::begin(const std::vector<ElementId>& elements, int steps) {
  stop();
  steps_ = steps;
  done_ = 0;
  shown_ = false;
  // First, because it may end another drag, and the new undo step would stop this one.
  document_.handle().grab(elements);
  held_.assign(document_.handle().held().begin(), document_.handle().held().end());
  running_ = true;
  emit changed();
}

bool SteppedDrag::holds() const { return !held_.empty() && std::ranges::equal(document_.handle().held(), held_); }

void SteppedDrag::stop() {
  if (!std::exchange(running_, false)) {
    return;
  }
  if (holds()) {
    document_.handle().release();
  }
  emit changed();
}

/// Makes the next step when all solvers have done the last one and the first panel has shown it. So every step is
/// shown, and the frames set the pace.
void SteppedDrag::step() {
  if (!running_) {
    return;
  }
  if (!holds()) {
    stop();  // something else was grabbed
  } else if (shown_ && document_.solvers().idle()) {
    if (done_ == steps_) {
      stop();
      return;
    }
    ++done_;
    shown_ = false;
    drag();
    emit changed();
  }
}

void SteppedDrag::drag() {
  const bool last = done_ == steps_;
  if (relative_) {
    const double share = double(done_) / steps_;
    document_.handle().dragBy(last ? by_ : Point(by_ * share),
                              last ? rotation_ : Rotation{rotation_.axis, rotation_.degrees * share});
  } else {
    document_.handle().drag(last ? target_ : Point(from_ + (target_ - from_) * done_ / steps_));
  }
}

}  // namespace chainmail
