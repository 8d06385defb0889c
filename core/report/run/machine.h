#pragma once

#include <string>

namespace chainmail::report {

/// Where times were measured: without it they say nothing.
struct Machine {
  std::string processor;
  unsigned cores = 0;  // 0: not known
  std::string compiler;
  std::string build;  // Release, Debug …
};
Machine this_machine();

/// What a report says of its own making; all of it comes from outside.
struct Origin {
  Machine machine;
  std::string command_line;
  std::string date;
  std::string version;
};

}  // namespace chainmail::report
