#include "mesh/cells.h"

namespace chainmail {
namespace {

void add_face(MeshParts& parts, const ElementId* corner, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    parts.links.push_back({corner[i], corner[(i + 1) % count]});
  }
}

template <std::size_t Corners>
void add_cells(MeshParts& parts, const std::vector<std::array<ElementId, Corners>>& cells) {
  for (const auto& cell : cells) {
    for (const auto& [i, j] : edges_of(cell)) {
      parts.links.push_back({cell[i], cell[j]});
    }
  }
}

}  // namespace

void add_links_along_edges(MeshParts& parts) {
  for (const auto& triangle : parts.triangles) {
    add_face(parts, triangle.data(), triangle.size());
  }
  for (std::size_t i = 0; i < parts.polygons.size(); i += parts.polygons[i] + 1) {
    add_face(parts, parts.polygons.data() + i + 1, parts.polygons[i]);
  }
  add_cells(parts, parts.tetrahedra);
  add_cells(parts, parts.hexahedra);
}

}  // namespace chainmail
