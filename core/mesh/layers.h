#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A side of an object at rest: the low or the high end of one axis.
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

/// Returns the elements of the layer at one side: those within half a mean rest length of the outermost element,
/// ascending. Empty if the axis does not exist.
std::vector<ElementId> layer(const Mesh& mesh, const ObjectSide& side);

/// Returns the elements on the boundary, ascending: the outer surface of cells, edges with only one face, the rim of a
/// grid without faces, the ends of chains. Empty for a closed surface.
std::vector<ElementId> boundary(const Mesh& mesh);

/// True for the name of a side and for `boundary`.
bool is_side(std::string_view name);
/// Returns the elements of a side by its name, or those of `boundary`. Throws Error for another name, and if there are
/// none.
std::vector<ElementId> elements_at(const Mesh& mesh, std::string_view name);

}  // namespace chainmail
