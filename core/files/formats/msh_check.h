#pragma once

#include <filesystem>
#include <string_view>

namespace chainmail {

/// Finds what is wrong with a .msh file that Gmsh refuses: Gmsh does not say where. Looks at the nodes and elements of
/// versions 2 and 4.1 in ASCII, and at nothing else. Throws Error at the first line that is wrong.
void check_msh(std::string_view text, const std::filesystem::path& path);

}  // namespace chainmail
