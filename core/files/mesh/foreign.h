#pragma once

#include <filesystem>
#include <string_view>

namespace chainmail {

/// Throws Error if a file is something else than a mesh that people often have in its place, such as an archive or a
/// web page; the error names it. `beginning` is the beginning of the file.
void refuse_foreign(std::string_view beginning, const std::filesystem::path& path);

}  // namespace chainmail
