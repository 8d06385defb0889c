#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Throws Error where nothing of an object is pinned.
void check_pinned(const Mesh& mesh, std::span<const ElementId> pins);
/// Throws Error, naming the part after an element of it, where its pins leave it free to move as a rigid body.
void check_part_held(const Mesh& mesh, ElementId part, const std::vector<ElementId>& pins);

}  // namespace chainmail
