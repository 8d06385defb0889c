#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "mesh/mesh.h"

namespace chainmail {

/// Returns the number of elements along x and y of a sheet for a picture of this many pixels, with `across` along x.
/// Its squares are as square as whole numbers allow.
std::array<std::uint32_t, 2> sheet_size(std::array<std::uint32_t, 2> picture, std::uint32_t across);

/// Returns a picture as a sheet of triangles in the plane. One texel is one mesh unit, the outermost elements are on
/// the border of the picture, and y points up. Sets the box of the picture. Throws Error for fewer than 2 elements
/// across or more than element_limit in all, before memory is allocated, and Cancelled.
MeshPointer make_sheet(Texture picture, std::uint32_t across, const Progress& progress = {});

/// True if the mesh shows a picture from make_sheet, or from a session with one: such a picture can be warped.
bool is_sheet(const Mesh& mesh);

}  // namespace chainmail
