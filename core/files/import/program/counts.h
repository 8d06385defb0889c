#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace chainmail::import {

/// What a file says it holds, 0 where it does not.
struct FileCounts {
  std::uint64_t points = 0;
  std::uint64_t elements = 0;  // lines, faces, cells, and whatever else it counts among them
};

/// Looks for the counts of a .msh or .mesh file (`name`): libraries leave out in silence what they do not know.
FileCounts count_in(const std::string& name, const std::filesystem::path& path);

}  // namespace chainmail::import
