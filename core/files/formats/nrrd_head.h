#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace chainmail {

/// The data file that the header of an NRRD file names. The library teem reads the rest of the header.
struct NrrdHead {
  std::string data_file;  // as in the header; empty if the data follow the header
  std::string text;       // the header, with the name replaced by `data`
};

/// Reads the header in the first limits::nrrd_header_bytes bytes of a file. Throws Error if the data are in several
/// files, or if teem might find another file name in the header.
NrrdHead read_nrrd_head(std::string_view beginning, const std::filesystem::path& path);

}  // namespace chainmail
