#pragma once

#include <filesystem>

namespace chainmail::command_line {

/// Returns the folder of the samples that come with the programs. It may be missing.
std::filesystem::path samples_folder();

}  // namespace chainmail::command_line
