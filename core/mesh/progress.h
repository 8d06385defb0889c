#pragma once

#include <atomic>
#include <cstddef>
#include <exception>

namespace chainmail {

/// Thrown to leave a cancelled job. It is not an Error: nothing is wrong, and the result is not wanted.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// State shared by the thread that runs a job and the thread that waits for it.
struct JobState {
  std::atomic<double> share = 0;  // done, from 0 to 1
  std::atomic<bool> cancelled = false;
};

/// Progress of a job or of a part of it: receives the share done, and throws if the job is cancelled. The default does
/// nothing.
class Progress {
 public:
  Progress() = default;
  explicit Progress(JobState& job) : job_(&job) {}

  /// Reports the share of this part that is done, from 0 to 1. Throws Cancelled if the job was cancelled.
  void report(double share) const {
    if (job_ == nullptr) {
      return;
    }
    if (job_->cancelled.load(std::memory_order_relaxed)) {
      throw Cancelled();
    }
    job_->share.store(from_ + share * (to_ - from_), std::memory_order_relaxed);
  }

  /// Reports a share. Cheap enough for each iteration of a loop: it acts once per few thousand calls.
  void report(std::size_t done, std::size_t of) const {
    if (done % stride == 0) {
      report(double(done) / double(of));
    }
  }

  /// Returns the progress of a part, between two shares of this one.
  Progress part(double from, double to) const {
    Progress part = *this;
    part.from_ = from_ + from * (to_ - from_);
    part.to_ = from_ + to * (to_ - from_);
    return part;
  }

 private:
  static constexpr std::size_t stride = 4096;  // takes well below 1 ms in every loop

  JobState* job_ = nullptr;
  double from_ = 0, to_ = 1;
};

}  // namespace chainmail
