#pragma once

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Fills a closed surface with tetrahedra whose edges are about `size` long (mesh units): the surface's elements keep
/// their ids, and those within follow.
///
/// Throws Error where the surface is open, goes through itself or cannot be filled, saying where; and Cancelled.
MeshPointer fill(const Mesh& surface, double size, const Progress& progress = {});

}  // namespace chainmail
