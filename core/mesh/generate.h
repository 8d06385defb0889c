#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mesh/mesh.h"

namespace chainmail {

enum class MeshKind { line, grid, cloth, block, tetra };

/// How a kind of mesh is called, how many sizes it takes, and what it is.
struct MeshKindInfo {
  MeshKind kind;
  std::string_view name;
  int sizes;
  std::string_view help;
};

/// Every kind, in the order in which they are offered.
std::span<const MeshKindInfo> mesh_kinds();

/// A generated mesh: `size` elements along x, y and z, `spacing` apart (mesh units).
struct MeshRecipe {
  MeshKind kind = MeshKind::grid;
  std::array<std::uint32_t, 3> size{16, 16, 1};
  double spacing = 1;
  std::optional<int> space_dimension = {};
};

/// Builds a mesh; its elements are numbered along x, then y, then z.
///
/// cloth splits each square by the diagonal from its first element; tetra splits each cube into the
/// six tetrahedra about its main diagonal (Freudenthal 1942). Throws Error for a size of 0, for more
/// than element_limit elements (before any memory is taken), and for a spacing that is not positive
/// or takes a coordinate beyond coordinate_limit; and Cancelled.
MeshPointer generate(const MeshRecipe& recipe, const Progress& progress = {});

}  // namespace chainmail
