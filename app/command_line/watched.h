#pragma once

#include <memory>
#include <string>

#include "mesh/progress.h"

namespace chainmail::command_line {

/// Shows the progress of a job on standard error, if that is a terminal, while this object exists.
class Watch {
 public:
  explicit Watch(std::string text);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch();

  /// For the job, which reports here.
  Progress progress() { return Progress(job_); }

 private:
  struct Line;

  JobState job_;
  std::unique_ptr<Line> line_;  // none without a terminal
};

}  // namespace chainmail::command_line
