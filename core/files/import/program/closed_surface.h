#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail::import {

using Triangle = std::array<ElementId, 3>;

/// Returns the triangles of a surface, with polygons split. Throws Error, with elements and positions, if they do not
/// enclose a volume: no triangles, a flat one, a hole, three at one link, or two that intersect.
std::vector<Triangle> closed_surface(const MeshParts& parts);

/// Returns the volume that the triangles enclose (mesh units cubed).
double enclosed_volume(const MeshParts& parts, const std::vector<Triangle>& triangles);

}  // namespace chainmail::import
