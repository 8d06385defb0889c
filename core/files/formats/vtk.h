#pragma once

#include <filesystem>
#include <string_view>

#include "files/formats/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads a legacy VTK file, text or binary, up to version 5.1: PolyData, unstructured grids of lines, faces, strips,
/// tetrahedra, hexahedra, voxels, prisms and pyramids, structured and rectilinear grids, and structured points. Ids
/// follow the order of the points. Fields of points and cells are skipped. This reader does not use Gmsh, which skips
/// lines next to polygons and cannot read the format of VTK 9. Throws Error, with the line if the file is text; and
/// Cancelled.
ImportedMesh read_vtk(std::string_view bytes, const std::filesystem::path& path, const Progress& progress = {});

}  // namespace chainmail
