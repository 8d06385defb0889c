#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chainmail {

/// Returns the data file that the header of a volume (.mhd, .nhdr) names. Throws Error if it is outside the folder of
/// the header (symbolic links are resolved), unless `outside` is true: a header from an unknown source could name any
/// file.
std::filesystem::path data_file(const std::filesystem::path& header, const std::string& name, bool outside);

/// The data files that a header names.
struct DataNames {
  std::vector<std::string> names;
  bool are_parts = false;           // true if each has a part of the volume
  std::string_view dimension = {};  // of a part, if it is stated
};

/// Reads the value of the field that names the data: one file; a pattern with a number, such as `s%03d.raw 1 20 1`; or
/// LIST, then the lines that follow are names. Without numbers, those of a pattern run from 1 to `count`. There are no
/// names if the value is wrong, or for more than `most`.
DataNames data_names(std::string_view value, std::string_view lines_behind, std::uint64_t count, std::uint64_t most);

}  // namespace chainmail
