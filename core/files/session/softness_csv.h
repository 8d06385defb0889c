#pragma once

#include <filesystem>
#include <map>
#include <string_view>

#include "mesh/mesh.h"
#include "solve/softness.h"

namespace chainmail {

/// Reads the softness of single links: CSV rows `a,b,compression,stretch,shear` with the ids of a link's
/// ends in either order. A first line of exactly these names is skipped, as are blank lines and what stands
/// behind a `#`. `path` appears in errors; `text` is what the file holds. Throws Error, with the line, for a
/// row that is not well formed, a link that is not there or comes twice, and softness out of range.
std::map<LinkId, LinkSoftness> read_softness(std::string_view text, const std::filesystem::path& path,
                                             const Mesh& mesh);

/// The same from a file.
std::map<LinkId, LinkSoftness> read_softness(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace chainmail
