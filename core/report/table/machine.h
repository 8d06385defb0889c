#pragma once

#include <string>

namespace chainmail::report {

/// The machine and the build that measured the times.
struct Machine {
  std::string processor;
  unsigned cores = 0;  // 0: unknown
  std::string compiler;
  std::string build;  // Release, Debug …
};
Machine this_machine();

/// Returns the date and the time in words, such as 2004-05-01 12:30 UTC.
std::string now_in_words();

/// The origin of a report. All texts come from outside, so they must be escaped.
struct Origin {
  Machine machine;
  std::string command_line;
  std::string date;
  std::string version;
};

}  // namespace chainmail::report
