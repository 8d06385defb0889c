#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads Medit's text format (Frey 2001) of two or three dimensions: vertices, edges, triangles, quadrilaterals,
/// tetrahedra and hexahedra. Ids follow the order of the vertices. Reference numbers, and other lists of numbers such
/// as Corners or Normals, are skipped. This reader uses no library: Gmsh needs the keywords on lines of their own, and
/// leaves unused vertices out. Throws Error, with the line; and Cancelled.
ImportedMesh read_medit(std::string_view text, const std::filesystem::path& path, const Progress& progress = {});

}  // namespace chainmail
