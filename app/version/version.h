#pragma once

#include <string>

namespace chainmail {

/// Returns the name of a program with the version, the commit and the build type.
std::string version_in_words(const std::string& program);

}  // namespace chainmail
