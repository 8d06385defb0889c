#pragma once

#include <QElapsedTimer>
#include <deque>

namespace chainmail {

/// Counts the frames that a view painted and that reached the screen. Qt reports a swap to every view when any part of
/// the window is repainted, so a swap only counts after the view's own paint.
class FrameMeter {
 public:
  FrameMeter() { clock_.start(); }

  void painted() { pending_ = true; }
  void swapped() {
    if (pending_) {
      pending_ = false;
      times_.push_back(clock_.elapsed());
    }
  }
  /// Returns the number of frames painted in the last second.
  int framesPerSecond() {
    while (!times_.empty() && times_.front() < clock_.elapsed() - 1000) {
      times_.pop_front();
    }
    return int(times_.size());
  }

 private:
  QElapsedTimer clock_;
  std::deque<qint64> times_;  // ms
  bool pending_ = false;
};

}  // namespace chainmail
