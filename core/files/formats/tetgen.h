#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "files/text/regular_file.h"
#include "mesh/progress.h"

namespace chainmail {

/// A text and the path of its file, for errors.
struct NamedText {
  std::string_view text;
  const std::filesystem::path& path;
};

/// Reads TetGen's pair of files (Si 2015): points, numbered from 0 or 1, and the tetrahedra that connect them. Ids
/// follow the order of the points. Throws Error with the file and line, and Cancelled.
ImportedMesh read_tetgen(const NamedText& nodes, const NamedText& elements, const Progress& progress = {});

/// Reads the pair that one of the two files belongs to: both have the same name, up to the ending. Throws Error if the
/// other file is missing.
ImportedMesh read_tetgen(RegularFile one, const Progress& progress);

}  // namespace chainmail
