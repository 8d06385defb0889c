#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "simulate/command.h"

namespace chainmail {

/// Keeps what the hand did last: the element it took, and where it went.
///
/// Of moves closer than a frame the later one stays, as for the solvers; the last one always does.
class DragRecorder {
 public:
  void grab(ElementId element) { recording_ = {commands::Grab{element}}; }

  void drag(const Point& target) {
    const auto now = Clock::now();
    if (recording_.size() > 1 && now - kept_ < std::chrono::milliseconds(16)) {
      recording_.back() = commands::Drag{target};
    } else if (!recording_.empty()) {
      recording_.emplace_back(commands::Drag{target});
      kept_ = now;
    }
  }

  std::optional<ElementId> held() const {
    return recording_.empty() ? std::nullopt : std::optional(std::get<commands::Grab>(recording_.front()).element);
  }

  /// Whether there is a new last drag: a press without a move is none.
  bool release() {
    const bool moved = recording_.size() > 1;
    if (moved) {
      last_ = std::exchange(recording_, {});
    }
    recording_.clear();
    return moved;
  }

  void forget() {
    recording_.clear();
    last_.clear();
  }

  /// A grab and drags, the hand still holding; empty where there is none.
  const std::vector<Command>& last() const { return last_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<Command> recording_, last_;
  Clock::time_point kept_;
};

}  // namespace chainmail
