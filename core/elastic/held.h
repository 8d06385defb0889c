#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Throws Error if an object has no pins.
void check_pinned(const Mesh& mesh, std::span<const ElementId> pins);
/// Throws Error, with an element of the part, if the pins of a part leave it free to move as a rigid body.
void check_part_held(const Mesh& mesh, ElementId part, const std::vector<ElementId>& pins);

}  // namespace chainmail
