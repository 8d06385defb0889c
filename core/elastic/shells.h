#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Parts triangles into surfaces that hang together along edges, each ascending, by their first triangle, and turns the
/// triangles of each alike. Throws Error where one is open, cut open, has three triangles at an edge or one side alone.
std::vector<std::vector<std::uint32_t>> part_into_shells(const Mesh& mesh, const Cuts& cuts,
                                                         std::vector<std::array<ElementId, 3>>& triangles);

}  // namespace chainmail
