#pragma once

#include <filesystem>
#include <string>

namespace chainmail::import {

/// Throws Error if a .msh or .mesh file (`name`) does not begin like a mesh. Gmsh runs any other file as a script,
/// which may start programs and write files.
void check_beginning(const std::string& name, const std::filesystem::path& path);

}  // namespace chainmail::import
