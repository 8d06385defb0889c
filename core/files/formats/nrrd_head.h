#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chainmail {

/// The data files that the header of an NRRD file names. The library teem reads the rest of the header.
struct NrrdHead {
  std::vector<std::string> data_files;  // as in the header; empty if the data follow the header
  std::string text;                     // the header, with the names replaced by nrrd_data_name()
};

/// The name under which teem finds data file `i`.
inline std::string nrrd_data_name(std::size_t i) { return "data" + std::to_string(i); }

/// Reads the header in the first limits::nrrd_header_bytes bytes of a file. Throws Error if it has too many lines, or
/// if teem might find another file name in the header.
NrrdHead read_nrrd_head(std::string_view beginning, const std::filesystem::path& path);

}  // namespace chainmail
