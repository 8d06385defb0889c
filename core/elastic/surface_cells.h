#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// The triangles of a surface in space, cut or not, and the hinges between them: faces, the triangles of polygons, or
/// the squares of a lattice without faces, whose diagonals alternate as in build_simplices. Flat triangles are left
/// out.
struct SurfaceCells {
  using Triangle = std::array<ElementId, 3>;
  /// An edge of two triangles. Where more meet, the first has a hinge with each of the others.
  struct Hinge {
    /// The ends of the edge, in the direction in which the first triangle runs; then the opposite corners of the two.
    std::array<ElementId, 4> corners;
    std::array<std::uint32_t, 2> triangle;
    std::array<std::uint8_t, 2> side;  // of each triangle: side k runs from its corner k to the next
    bool agrees;                       // true if the second triangle has the orientation of the first
  };

  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> first_link;  // of each triangle, and the end: places in `links`
  std::vector<LinkId> links;              // that a triangle needs: without one of these, it is gone
  std::vector<Hinge> hinges;

  std::span<const LinkId> links_of(std::uint32_t triangle) const {
    return std::span(links).subspan(first_link[triangle], first_link[triangle + 1] - first_link[triangle]);
  }
};

/// True if a mesh in space has faces or is a lattice of one layer, and has no cells.
bool is_surface_in_space(const Mesh& mesh);
/// True if relaxation to the material applies: the mesh has cells of its space's dimension, or is a surface in space.
bool has_material(const Mesh& mesh);
/// Throws Cancelled.
SurfaceCells build_surface_cells(const Mesh& mesh, const Progress& progress = {});

}  // namespace chainmail
