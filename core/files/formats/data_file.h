#pragma once

#include <filesystem>
#include <string>

namespace chainmail {

/// Returns the data file that the header of a volume (.mhd, .nhdr) names. Throws Error if it is outside the folder of
/// the header (symbolic links are resolved), unless `outside` is true: a header from an unknown source could name any
/// file.
std::filesystem::path data_file(const std::filesystem::path& header, const std::string& name, bool outside);

}  // namespace chainmail
