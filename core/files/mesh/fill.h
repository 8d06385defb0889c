#pragma once

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Approximate number of inner elements per cube with edges of the requested size (measured on a ball, at three sizes).
inline constexpr double points_per_cube = 0.6;

/// Fills a closed surface with tetrahedra whose edges are about `size` long (mesh units). The elements of the surface
/// keep their ids; inner elements follow.
///
/// Throws Error, with the position, if the surface is open, intersects itself or cannot be filled; and Cancelled.
MeshPointer fill(const Mesh& surface, double size, const Progress& progress = {});

}  // namespace chainmail
