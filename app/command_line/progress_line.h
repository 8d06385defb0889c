#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "chainmail/job.h"

namespace chainmail::command_line {

/// Returns a share from 0 to 1 as the beginning of a progress line: "42% ".
std::string percent(double share);

/// A line of progress on standard error, if that is a terminal. The destructor clears it.
class ProgressLine {
 public:
  /// Shows nothing until `delay` has passed.
  explicit ProgressLine(std::chrono::milliseconds delay = std::chrono::milliseconds(0));
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

 private:
  bool is_due() const { return std::chrono::steady_clock::now() >= next_; }
  void write(const std::string& text);

  bool is_terminal_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

/// Shows the progress of a job on standard error, if that is a terminal, while this object exists.
class Watch {
 public:
  /// Shows the share that is done, and the text.
  explicit Watch(const std::string& text);
  /// Shows what `line` says about the job; nothing while that is empty.
  explicit Watch(std::function<std::string(const api::Job&)> line);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch();

  const api::Job& job() const { return job_; }

 private:
  struct Line;

  api::Job job_;
  std::unique_ptr<Line> line_;  // none without a terminal
};

}  // namespace chainmail::command_line
