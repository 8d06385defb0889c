#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// A text and where it comes from, for errors.
struct NamedText {
  std::string_view text;
  const std::filesystem::path& path;
};

/// Reads TetGen's pair of files (Si 2015): points, numbered from 0 or 1, and the tetrahedra that join them. Ids are the
/// points' order. Throws Error with the file and line.
ImportedMesh read_tetgen(const NamedText& nodes, const NamedText& elements, const Progress& progress = {});

}  // namespace chainmail
