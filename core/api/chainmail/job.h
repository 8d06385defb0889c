#pragma once

#include <memory>

namespace chainmail::api {

struct Access;

/// The progress of long work. Copies share one state, so one thread may run the work while another one reads the share
/// that is done, or cancels it. All functions are safe to call from any thread.
class Job {
 public:
  /// Makes a job that has not begun.
  Job();

  /// Returns the share of the work that is done, from 0 to 1.
  double share() const;
  /// Asks the work to stop: it throws Cancelled within about 100 ms. A job that is cancelled stays cancelled.
  void cancel() const;
  /// True if cancel() was called.
  bool is_cancelled() const;

 private:
  friend struct Access;
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace chainmail::api
