#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace chainmail {

/// Thrown to leave a cancelled job. It is not an Error: nothing is wrong, and the result is not wanted.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// Progress of long work or of a part of it: the share that is done, a text, and cancel. A cheap value: copies and
/// parts refer to the same state, so the thread that works has one, and the thread that waits has another. The default
/// one does nothing, and nobody can cancel it.
class Progress {
 public:
  /// Receives the share and the text after each change, on the thread that works.
  using Watcher = std::function<void(double share, const std::string& text)>;

  Progress() = default;
  /// Returns the progress of new work.
  static Progress watched(Watcher watcher = {}) {
    Progress progress;
    progress.state_ = std::make_shared<State>();
    progress.state_->watcher = std::move(watcher);
    return progress;
  }

  // For the thread that works.

  /// Reports the share of this part that is done, from 0 to 1. Throws Cancelled if the work was cancelled.
  void report(double share) const {
    if (cancelled()) {
      throw Cancelled();
    }
    show(share);
  }

  /// Reports a share. Cheap enough for each iteration of a loop: it acts once per few thousand calls.
  void report(std::size_t done, std::size_t of) const {
    if (done % stride == 0) {
      report(double(done) / double(of));
    }
  }

  /// Reports a share without an exception, for work that asks cancelled() and returns what is finished.
  void show(double share) const {
    if (state_ == nullptr || is_quiet_) {
      return;
    }
    state_->share.store(from_ + share * (to_ - from_), std::memory_order_relaxed);
    if (state_->watcher) {
      state_->watcher(this->share(), text());
    }
  }

  /// Sets the text. Watchers receive it with the next share.
  void say(std::string text) const {
    if (state_ != nullptr && !is_quiet_) {
      const std::scoped_lock lock(state_->mutex);
      state_->text = std::move(text);
    }
  }

  /// Returns the progress of a part, between two shares of this one.
  Progress part(double from, double to) const {
    Progress part = *this;
    part.from_ = from_ + from * (to_ - from_);
    part.to_ = from_ + to * (to_ - from_);
    return part;
  }

  /// Returns a progress that only passes on that the work was cancelled: its shares are too small to be shown.
  Progress quiet() const {
    Progress quiet = *this;
    quiet.is_quiet_ = true;
    return quiet;
  }

  /// Returns the progress of work that is also cancelled when it takes longer.
  Progress until(std::chrono::steady_clock::time_point end) const {
    Progress limited = *this;
    limited.end_ = end;
    return limited;
  }
  /// True after the end of `until`.
  bool is_too_late() const { return end_ && std::chrono::steady_clock::now() > *end_; }

  bool cancelled() const {
    return (state_ != nullptr && state_->cancelled.load(std::memory_order_relaxed)) || is_too_late();
  }

  // For the thread that waits.

  /// Cancels the work, or takes that back.
  void cancel(bool wanted = true) const {
    if (state_ != nullptr) {
      state_->cancelled.store(wanted);
    }
  }
  /// The share of the whole work that is done, from 0 to 1.
  double share() const { return state_ != nullptr ? state_->share.load() : 0; }
  std::string text() const {
    if (state_ == nullptr) {
      return {};
    }
    const std::scoped_lock lock(state_->mutex);
    return state_->text;
  }

 private:
  static constexpr std::size_t stride = 4096;  // takes well below 1 ms in every loop

  struct State {
    std::atomic<double> share = 0;
    std::atomic<bool> cancelled = false;
    std::mutex mutex;  // guards the text
    std::string text;
    Watcher watcher;
  };

  std::shared_ptr<State> state_;
  std::optional<std::chrono::steady_clock::time_point> end_;
  double from_ = 0, to_ = 1;
  bool is_quiet_ = false;
};

}  // namespace chainmail
