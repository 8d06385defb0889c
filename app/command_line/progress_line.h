#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

#include "mesh/progress.h"

namespace chainmail::command_line {

/// Shows how far long work is, and about how long it still takes: on a terminal, one line that is rewritten; elsewhere,
/// a line after 10 s and then one per minute. Short work shows nothing. The destructor clears the line of a terminal.
class ProgressLine {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `start` is when the work begins.
  ProgressLine(std::ostream& out, bool is_terminal, Time start);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// When the next line is due.
  Time next() const { return next_; }
  /// Shows the share and the text of the work. Work that reports no share shows only its text: how long it takes is not
  /// known.
  void show(const Progress& job, Time now);

 private:
  std::ostream& out_;
  bool is_terminal_;
  bool is_shown_ = false;
  Time start_, next_;
};

/// Shows the progress of work on standard error while this object exists. Only one at a time.
class Watch {
 public:
  /// The text is shown until the work sets another.
  explicit Watch(std::string text);

  const Progress& progress() const { return job_; }

 private:
  void show(const std::stop_token& stop);

  Progress job_ = Progress::watched();
  ProgressLine line_;
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace chainmail::command_line
