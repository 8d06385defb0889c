#pragma once

#include <string>

#include "report/run/machine.h"

namespace chainmail::command_line {

/// Returns machine, command line, current time and version, for a report.
report::Origin origin_of(const std::string& command_line);

}  // namespace chainmail::command_line
