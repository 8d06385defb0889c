#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mesh/mesh.h"
#include "mesh/parameters.h"

namespace chainmail {

enum class MeshKind { line, grid, cloth, block, tetra };

/// Name of a kind of mesh on the command line, number of its sizes, and description.
struct MeshKindInfo {
  MeshKind kind;
  std::string_view name;
  int sizes;
  std::string_view help;
};

/// Returns all kinds, in the order of menus and help texts.
std::span<const MeshKindInfo> mesh_kinds();

/// A generated mesh: `size` elements along x, y and z, `spacing` apart (mesh units).
struct MeshRecipe {
  MeshKind kind = MeshKind::grid;
  std::array<std::uint32_t, 3> size{16, 16, 1};
  double spacing = parameters::spacing.default_value;
  std::optional<int> space_dimension = {};
};

/// Builds a mesh; its elements are numbered along x, then y, then z.
///
/// cloth splits each square by the diagonal from its first element; tetra splits each cube into the six tetrahedra
/// around its main diagonal (Freudenthal 1942). Throws Error for a size of 0, for more than element_limit elements
/// (before memory is allocated), and for a spacing that is not positive or moves a coordinate beyond coordinate_limit;
/// and Cancelled.
MeshPointer generate(const MeshRecipe& recipe, const Progress& progress = {});

}  // namespace chainmail
