#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "mesh/progress.h"

namespace chainmail::command_line {

/// Returns a share from 0 to 1 as the beginning of a progress line: "42% ".
std::string percent(double share);

/// A line of progress on standard error, if that is a terminal. The destructor clears it.
class ProgressLine {
 public:
  /// Shows nothing until `delay` has passed: short work shows nothing.
  explicit ProgressLine(std::chrono::milliseconds delay = std::chrono::milliseconds(300));
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// Shows `text()`, at most five times per second.
  template <typename Text>
  void show(const Text& text) {
    if (is_terminal_ && is_due()) {
      write(text());
    }
  }
  bool is_terminal() const { return is_terminal_; }

 private:
  bool is_due() const { return std::chrono::steady_clock::now() >= next_; }
  void write(const std::string& text);

  bool is_terminal_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

/// Shows the share of a job that is done, and a text, while this object exists.
class Watch {
 public:
  explicit Watch(std::string text);

  const Progress& progress() const { return job_; }

 private:
  void show(const std::stop_token& stop);

  Progress job_ = Progress::watched();
  ProgressLine line_;
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::jthread thread_;  // last member, because it uses the others; none without a terminal
};

}  // namespace chainmail::command_line
