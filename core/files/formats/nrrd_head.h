#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace chainmail {

/// What the header of an NRRD file says of where its data are. The rest of it is teem's to read.
struct NrrdHead {
  std::string data_file;  // as the header names it; empty: the data follow the header
  std::string text;       // the header, with `data` in place of the name
};

/// How much of a file is looked at (bytes): a header may hold long comments.
inline constexpr std::size_t longest_nrrd_head = std::size_t{1} << 20;

/// Reads the header at the beginning of a file: all of the file, or longest_nrrd_head bytes. Throws Error where the
/// data are in several files, or the header is so odd that teem might see another name in it.
NrrdHead read_nrrd_head(std::string_view beginning, const std::filesystem::path& path);

}  // namespace chainmail
