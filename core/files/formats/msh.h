#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string_view>

#include "files/formats/divided_cells.h"
#include "files/formats/mesh_state.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Gmsh's numbers of the types of elements that have a counterpart here (Geuzaine and Remacle 2009).
enum MshNumber { msh_line = 1, msh_triangle, msh_quadrangle, msh_tetrahedron, msh_hexahedron, msh_point = 15 };

/// A type of element of Gmsh.
struct MshType {
  int number;
  std::size_t corners;                 // with the middles
  std::optional<DividedKind> divided;  // of types that have no counterpart here
};

/// Returns the type with this number, or null if it is of higher order or uncommon.
const MshType* msh_type(int number);

/// Finds what is wrong with a .msh file that Gmsh refuses: Gmsh does not say where. Looks at the nodes and elements of
/// versions 2 and 4.1 in ASCII, and at nothing else. Throws Error at the first line that is wrong.
void check_msh(std::string_view text, const std::filesystem::path& path);

/// Writes .msh of Gmsh, version 4.1 in ASCII: one node per element, with tag id + 1; the triangles, quadrangles,
/// tetrahedra and hexahedra without a cut link; the other uncut links as lines. Each dimension is one discrete entity.
/// The format has no faces of five or more corners: their links are written as lines.
void write_msh(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail
