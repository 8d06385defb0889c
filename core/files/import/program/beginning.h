#pragma once

#include <filesystem>

namespace chainmail::import {

/// Throws Error if a .msh file does not begin like a mesh. Gmsh runs any other file as a script,
/// which may start programs and write files.
void check_beginning(const std::filesystem::path& path);

}  // namespace chainmail::import
