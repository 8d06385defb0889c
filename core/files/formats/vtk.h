#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads a legacy VTK file, text or binary, up to version 5.1: PolyData and unstructured grids of lines, triangles,
/// polygons, tetrahedra, hexahedra and voxels. Ids are the points' order; what is said of points and cells beyond is
/// passed over. Read by hand: Gmsh leaves out lines beside polygons and what VTK 9 writes. Throws Error, with the line
/// where it is text; and Cancelled.
ImportedMesh read_vtk(std::string_view bytes, const std::filesystem::path& path, const Progress& progress = {});

}  // namespace chainmail
