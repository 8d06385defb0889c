#pragma once

#include <atomic>
#include <cstddef>
#include <exception>

namespace chainmail {

/// Leaves a job that was cancelled. No Error: nothing is wrong, and nobody wants the result.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// What the thread that does a job and the one that waits for it share.
struct JobState {
  std::atomic<double> share = 0;  // done, from 0 to 1
  std::atomic<bool> cancelled = false;
};

/// Where a job, or a part of it, says how far it has come and learns that it is no longer wanted. By default nobody
/// watches.
class Progress {
 public:
  Progress() = default;
  explicit Progress(JobState& job) : job_(&job) {}

  /// The share of this part that is done, from 0 to 1. Throws Cancelled where the job was.
  void report(double share) const {
    if (job_ == nullptr) {
      return;
    }
    if (job_->cancelled.load(std::memory_order_relaxed)) {
      throw Cancelled();
    }
    job_->share.store(from_ + share * (to_ - from_), std::memory_order_relaxed);
  }

  /// The same, cheap enough for each turn of a loop: it looks once in a few thousand.
  void report(std::size_t done, std::size_t of) const {
    if (done % stride == 0) {
      report(double(done) / double(of));
    }
  }

  /// What lies between two shares of this part.
  Progress part(double from, double to) const {
    Progress part = *this;
    part.from_ = from_ + from * (to_ - from_);
    part.to_ = from_ + to * (to_ - from_);
    return part;
  }

 private:
  static constexpr std::size_t stride = 4096;  // well below a millisecond of anything done here

  JobState* job_ = nullptr;
  double from_ = 0, to_ = 1;
};

}  // namespace chainmail
