#include "document/steady_hand.h"

namespace chainmail {
namespace {

// Moves of the hand are sampled, and kept, 60 times a second: none of these is to be lost.
constexpr int intervalMilliseconds = 18;

}  // namespace

SteadyHand::SteadyHand(Document& document) : document_(document) {
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.setInterval(intervalMilliseconds);
  connect(&timer_, &QTimer::timeout, this, &SteadyHand::step);
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, &SteadyHand::stop);
}

void SteadyHand::carry(ElementId element, const Point& from, const Point& target, int steps) {
  stop();
  element_ = element;
  from_ = from;
  target_ = target;
  steps_ = steps;
  done_ = 0;
  document_.grab(element);
  timer_.start();
  emit changed();
}

void SteadyHand::stop() {
  if (!running()) {
    return;
  }
  timer_.stop();
  if (document_.held() == element_) {
    document_.release();
  }
  emit changed();
}

void SteadyHand::step() {
  if (document_.held() != element_) {
    stop();  // another hand has taken over
  } else if (document_.idle()) {
    if (done_ == steps_) {
      stop();
      return;
    }
    ++done_;
    document_.drag(done_ == steps_ ? target_ : Point(from_ + (target_ - from_) * done_ / steps_));
    emit changed();
  }
}

}  // namespace chainmail
