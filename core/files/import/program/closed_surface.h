#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail::import {

using Triangle = std::array<ElementId, 3>;

/// The triangles of a surface, polygons split. Throws Error, with the elements and where they stand, where they do not
/// enclose a volume: none at all, a flat one, a hole, three that meet at a link, two that go through each other.
std::vector<Triangle> closed_surface(const MeshParts& parts);

/// What they enclose (mesh units cubed).
double enclosed_volume(const MeshParts& parts, const std::vector<Triangle>& triangles);

}  // namespace chainmail::import
