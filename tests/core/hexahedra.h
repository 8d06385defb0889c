#pragma once

#include "mesh/cells.h"

namespace chainmail::test {

/// The parts of a block of hexahedra, `size` of them along x, y and z, with links along their edges. A test may change
/// them.
inline MeshParts hexahedral_parts(std::array<std::uint32_t, 3> size, double spacing = 1) {
  MeshParts parts;
  const std::uint32_t width = size[0] + 1, layer = width * (size[1] + 1);
  const Lattice lattice{{width, size[1] + 1, size[2] + 1}, spacing};
  for (ElementId e = 0; e < lattice.element_count(); ++e) {
    parts.rest.push_back(lattice.position(e));
  }
  for (std::uint32_t z = 0; z < size[2]; ++z) {
    for (std::uint32_t y = 0; y < size[1]; ++y) {
      for (std::uint32_t x = 0; x < size[0]; ++x) {
        const ElementId a = x + width * y + layer * z, b = a + layer;
        parts.hexahedra.push_back({a, a + 1, a + 1 + width, a + width, b, b + 1, b + 1 + width, b + width});
      }
    }
  }
  add_links_along_edges(parts);
  return parts;
}

inline MeshPointer hexahedral_block(std::array<std::uint32_t, 3> size, double spacing = 1) {
  return build_mesh(hexahedral_parts(size, spacing));
}

}  // namespace chainmail::test
