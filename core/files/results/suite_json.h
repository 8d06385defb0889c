#pragma once

#include <filesystem>
#include <ostream>

#include "report/run/suite.h"

namespace chainmail {

/// Writes the results of a suite as JSON. A figure that does not exist is missing.
void write_json(std::ostream& out, const report::Suite& suite);

/// Reads what write_json has written. Throws Error.
report::Suite read_suite(const std::filesystem::path& path);

}  // namespace chainmail
