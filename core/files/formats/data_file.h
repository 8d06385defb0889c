#pragma once

#include <filesystem>
#include <string>

namespace chainmail {

/// The file that the header of a volume names as its data (.mhd, .nhdr), which is in the header's folder or beneath it,
/// after links are followed. Throws Error where it is elsewhere, unless `outside` allows that: a header from somebody
/// else could name any file.
std::filesystem::path data_file(const std::filesystem::path& header, const std::string& name, bool outside);

}  // namespace chainmail
