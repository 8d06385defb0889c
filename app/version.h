#pragma once

#include <string>

namespace chainmail::command_line {

/// Returns the name and version of the program, its commit and its build type.
std::string version_in_words();

}  // namespace chainmail::command_line
