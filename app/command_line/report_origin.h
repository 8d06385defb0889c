#pragma once

#include <chrono>
#include <string>

#include "report/run/machine.h"

namespace chainmail::command_line {

/// What a report says of its own making, now.
report::Origin origin_of(const std::string& command_line);

/// A line on standard error, where that is a terminal.
class ProgressLine {
 public:
  ProgressLine();
  void show(double fraction, const std::string& text);

 private:
  bool is_terminal_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace chainmail::command_line
