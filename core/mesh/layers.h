#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A side of an object, as it stands at rest: the low or the high end of one axis.
struct ObjectSide {
  std::string_view name;
  int axis;
  bool high;
};
inline constexpr std::array<ObjectSide, 6> object_sides{{{"left", 0, false},
                                                         {"right", 0, true},
                                                         {"bottom", 1, false},
                                                         {"top", 1, true},
                                                         {"back", 2, false},
                                                         {"front", 2, true}}};
const ObjectSide* find_side(std::string_view name);

/// The elements of the layer at one side: those within half a mean rest length of the outermost, ascending. Empty where
/// the scene does not carry the axis.
std::vector<ElementId> layer(const Mesh& mesh, const ObjectSide& side);

/// The elements on the boundary, ascending: of a volume's cells the outer surface, of faces the edges that one face
/// alone has, of a grid without faces its rim, of chains their ends. Empty for a closed surface, which has none.
std::vector<ElementId> boundary(const Mesh& mesh);

}  // namespace chainmail
