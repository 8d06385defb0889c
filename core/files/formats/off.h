#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads OFF as text (Geomview; Rost, Object File Format 1989). It is free-form: words, with comments anywhere. The
/// number of edges may be missing if the counts have a line of their own. Normals, colours and texture coordinates of
/// vertices, and colours of faces, are not read. Throws Error, with the line, and Cancelled.
ImportedMesh read_off(std::string_view text, const std::filesystem::path& path, const Progress& progress);

}  // namespace chainmail
