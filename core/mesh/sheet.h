#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "mesh/mesh.h"

namespace chainmail {

/// How many elements along x and y a sheet has for a picture of so many pixels a side, `across` of them along x: its
/// squares are as square as whole numbers of them allow.
std::array<std::uint32_t, 2> sheet_size(std::array<std::uint32_t, 2> picture, std::uint32_t across);

/// A picture as a sheet of triangles in the plane. A texel is one mesh unit a side, the outermost elements stand on the
/// picture's border, y runs upward. Its box is set by this. Throws Error where there are fewer than 2 elements across
/// or more than element_limit in all, before memory is taken, and Cancelled.
MeshPointer make_sheet(Texture picture, std::uint32_t across, const Progress& progress = {});

/// Whether the mesh shows a picture that make_sheet, or a session of it, has put on it: one that can be warped.
bool is_sheet(const Mesh& mesh);

}  // namespace chainmail
