#pragma once

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// About how many elements lie within for each cube whose edges are of the size asked for (measured on a ball, at three
/// sizes).
inline constexpr double points_per_cube = 0.6;

/// Fills a closed surface with tetrahedra whose edges are about `size` long (mesh units): the surface's elements keep
/// their ids, and those within follow.
///
/// Throws Error where the surface is open, goes through itself or cannot be filled, saying where; and Cancelled.
MeshPointer fill(const Mesh& surface, double size, const Progress& progress = {});

}  // namespace chainmail
