#pragma once

#include <chrono>
#include <string>

#include "report/run/machine.h"

namespace chainmail::command_line {

/// Returns machine, command line, current time and version, for a report.
report::Origin origin_of(const std::string& command_line);

/// A progress line on standard error, if that is a terminal.
class ProgressLine {
 public:
  ProgressLine();
  void show(double fraction, const std::string& text);

 private:
  bool is_terminal_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace chainmail::command_line
