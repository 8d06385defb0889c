#pragma once

#include <optional>
#include <span>

#include "mesh/mesh.h"

namespace chainmail {

/// A mesh as the arrays of a program, which are copied.
struct MeshArrays {
  std::span<const double> positions = {};      // x, y and z of each element at rest (mesh units)
  std::span<const ElementId> links = {};       // two ids each; the edges of faces and cells are links, too
  std::span<const ElementId> triangles = {};   // three ids each
  std::span<const ElementId> tetrahedra = {};  // four ids each
  std::span<const ElementId> hexahedra = {};   // eight ids each: see MeshParts
  /// Default: the number of axes along which the mesh extends.
  std::optional<int> space_dimension = {};
};

/// Builds a mesh. Throws Error for arrays that are not whole points or groups, a coordinate that is not finite or
/// beyond coordinate_limit, an id without a position, a group that uses an element twice, a face or cell that is there
/// twice, and if there is no link.
MeshPointer make_mesh(const MeshArrays& arrays);

}  // namespace chainmail
