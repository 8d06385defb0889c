#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/formats/space.h"

namespace chainmail {

/// What stands in an OBJ file, checked line by line.
struct ObjText {
  std::vector<Point> vertices;
  /// The file's faces and lines alone, for tinyobjloader, which may take them piece by piece: no index in them counts
  /// back from its place.
  std::string faces_and_lines;
  std::optional<Stated<int>> space;
};

/// Checks what tinyobjloader would pass over in silence (it reads a word that is no number as 0), and
/// reads the coordinates, which it does not round to the nearest double. Throws Error with the line.
ObjText scan_obj(std::string_view text, const std::filesystem::path& path, const Progress& progress);

}  // namespace chainmail
