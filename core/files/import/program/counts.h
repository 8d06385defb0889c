#pragma once

#include <cstdint>
#include <filesystem>

namespace chainmail::import {

/// The counts that a file states, or 0.
struct FileCounts {
  std::uint64_t points = 0;
  std::uint64_t elements = 0;  // lines, faces, cells and anything else that it counts with them
};

/// Finds the counts of a .msh file, because libraries silently skip what they do not know.
FileCounts count_in(const std::filesystem::path& path);

}  // namespace chainmail::import
