#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// The outer surface of a volume's cells as an object of its own.
struct OuterSurface {
  MeshPointer mesh;                 // closed, of triangles seen from outside counterclockwise
  std::vector<ElementId> elements;  // of the volume, for each of the surface's; ascending

  /// The surface's element that is this one of the volume, or no element.
  ElementId on_surface(ElementId of_volume) const;
};

/// Throws Error where the object has no cells.
OuterSurface outer_surface(const MeshPointer& volume);

}  // namespace chainmail
