#pragma once

#include <filesystem>

namespace chainmail {

/// Returns the folder of the running program; empty if the system does not tell it.
std::filesystem::path program_folder();

}  // namespace chainmail
