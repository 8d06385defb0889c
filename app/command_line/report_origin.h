#pragma once

#include <string>

#include "report/run/machine.h"

namespace chainmail::command_line {

/// Returns the machine, command line, current time and program version for a report.
report::Origin origin_of(const std::string& command_line);

}  // namespace chainmail::command_line
