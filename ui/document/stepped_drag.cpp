#include "document/stepped_drag.h"

#include <utility>

namespace chainmail {

SteppedDrag::SteppedDrag(Document& document) : document_(document) {
  connect(&document, &Document::becameIdle, this, &SteppedDrag::step);
  connect(&document, &Document::frameReady, this, [this](int panel) {
    shown_ = shown_ || panel == 0;
    step();
  });
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, &SteppedDrag::stop);
}

void SteppedDrag::start(ElementId element, const Point& from, const Point& target, int steps) {
  stop();
  element_ = element;
  from_ = from;
  target_ = target;
  steps_ = steps;
  done_ = 0;
  shown_ = false;
  document_.grab(element);  // first, because it may end another drag, and the new undo step would stop this one
  running_ = true;
  emit changed();
}

void SteppedDrag::stop() {
  if (!std::exchange(running_, false)) {
    return;
  }
  if (document_.held() == element_) {
    document_.release();
  }
  emit changed();
}

/// Makes the next step when all solvers have done the last one and the first panel has shown it. So every step is
/// shown, and the frames set the pace.
void SteppedDrag::step() {
  if (!running_) {
    return;
  }
  if (document_.held() != element_) {
    stop();  // something else was grabbed
  } else if (shown_ && document_.idle()) {
    if (done_ == steps_) {
      stop();
      return;
    }
    ++done_;
    shown_ = false;
    document_.drag(done_ == steps_ ? target_ : Point(from_ + (target_ - from_) * done_ / steps_));
    emit changed();
  }
}

}  // namespace chainmail
