#pragma once

#include <memory>
#include <string>

#include "mesh/progress.h"

namespace chainmail::command_line {

/// Shows on standard error, where that is a terminal, how much of a job is done, as long as this lives.
class Watch {
 public:
  explicit Watch(std::string text);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch();

  /// Of the job.
  Progress progress() { return Progress(job_); }

 private:
  struct Line;

  JobState job_;
  std::unique_ptr<Line> line_;  // none where nobody looks
};

}  // namespace chainmail::command_line
