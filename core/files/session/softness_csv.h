#pragma once

#include <filesystem>
#include <string_view>

#include "body/softness.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Reads the softness of single links: CSV rows `a,b,compression,stretch,shear` with the ids of the ends of a link in
/// either order, or with a column for each number of softness_numbers; without them, these have their defaults. A
/// first line with exactly these names, blank lines and comments after `#` are skipped. `path` appears
/// in errors. Throws Error, with the line, for a malformed row, a link that does not exist or appears twice, and
/// softness out of range.
OwnSoftness read_softness(std::string_view text, const std::filesystem::path& path, const Mesh& mesh);

/// Reads the softness of single links from a file.
OwnSoftness read_softness(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace chainmail
