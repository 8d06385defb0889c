#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "files/formats/imported.h"

/// What runs in the import program: other people's libraries, which may crash on a damaged file.
namespace chainmail::import {

/// Says how much is done, from 0 to 1.
using Report = std::function<void(double)>;

/// OFF, PLY and STL by CGAL. `name` is of the three. Points in the file's order; those of STL, which has none, in the
/// order in which they are first met, equal ones being one.
ImportedMesh read_polygons(const std::string& name, const std::filesystem::path& path);

/// Gmsh's own format 2 and 4, and Medit's, by Gmsh: lines, triangles, quadrangles, tetrahedra and hexahedra,
/// points in the order of their tags. `name` is what the path must end in for Gmsh to read it as such.
ImportedMesh read_by_gmsh(const std::string& name, const std::filesystem::path& path);

/// NRRD by teem: three axes of numbers.
Volume read_nrrd(const std::filesystem::path& path);

/// Fills a closed surface, in a file as encode_imported writes it, with tetrahedra whose edges are about `size` long
/// (mesh units), by Gmsh. The surface's points keep their ids.
ImportedMesh fill_surface(const std::filesystem::path& path, double size, const Report& report);

}  // namespace chainmail::import
