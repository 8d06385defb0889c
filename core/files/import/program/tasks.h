#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "files/import/handover.h"
#include "mesh/error.h"

/// Tasks of the import program. They call libraries that may crash on a damaged file.
namespace chainmail::import {

/// Ends the task: the program that started this one names the file, and shows both sentences.
[[noreturn]] inline void refuse(const std::string& problem, const std::string& remedy) {
  throw Error("", problem, remedy);
}

/// Reports the share that is done, from 0 to 1.
using Report = std::function<void(double)>;

/// Reads formats 2 and 4 of Gmsh, and Medit, by Gmsh: lines, triangles, quadrangles, tetrahedra and hexahedra; points
/// in the order of their tags. `name` is the ending of the path, by which Gmsh chooses the format.
ImportedMesh read_by_gmsh(const std::filesystem::path& path);

/// Reads VTK's XML of unstructured grids and polygonal data (.vtu, .vtp) by pugixml and zlib. Ids are the file's order.
ImportedMesh read_vtk_xml(const std::filesystem::path& path);

/// Reads NRRD by teem: three axes of numbers.
Volume read_nrrd(const std::filesystem::path& path);

/// Fills a closed surface, in a file as encode_imported writes it, with tetrahedra whose edges are about `size` long
/// (mesh units), by Gmsh. The points of the surface keep their ids.
ImportedMesh fill_surface(const std::filesystem::path& path, double size, const Report& report);

/// Closes holes of a surface, in a file as encode_imported writes it, by CGAL. Its triangles are the surface, its
/// polygons the elements around the holes. Returns its points, then new ones, and the new triangles only. Refuses if no
/// hole can be closed.
ImportedMesh close_surface(const std::filesystem::path& path, const Report& report);

/// Collapses edges of a surface, in a file as encode_imported writes it, by CGAL, until `elements` are left. All points
/// must be corners of its triangles. Those at its borders and non-manifold edges stay. Refuses if it cannot have so
/// few.
ImportedMesh simplify_surface(const std::filesystem::path& path, std::size_t elements, const Report& report);

}  // namespace chainmail::import
