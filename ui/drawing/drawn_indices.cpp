#include "drawing/drawn_indices.h"

#include <algorithm>
#include <iterator>

namespace chainmail {
namespace {

/// A multiplicative hash (Knuth 1973) that separates neighbouring ids.
ElementId scatter(ElementId e) { return e * 2654435761U >> 16; }

}  // namespace

DrawnLinks drawnLinks(const MeshLevel& level, const Cuts& cuts, const std::vector<std::uint32_t>& clusters,
                      std::size_t nth) {
  DrawnLinks drawn;
  std::size_t count = 0;
  for (const std::uint32_t cluster : clusters) {
    for (const std::uint32_t link : level.clusterLinks[cluster]) {
      if (count++ % nth == 0 && level.isUncut(link, cuts)) {
        drawn.numbers.push_back(link);
        drawn.ends.insert(drawn.ends.end(), level.links[link].begin(), level.links[link].end());
      }
    }
  }
  return drawn;
}

std::vector<ElementId> drawnFaces(const MeshLevel& level, const Cuts& cuts,
                                  const std::vector<std::uint32_t>& clusters) {
  std::vector<ElementId> indices;
  for (const std::uint32_t cluster : clusters) {
    for (const std::uint32_t face : level.clusterFaces[cluster]) {
      if (level.isWhole(face, cuts)) {
        indices.insert(indices.end(), level.faces[face].begin(), level.faces[face].end());
      }
    }
  }
  return indices;
}

DrawnLinks surfaceLinks(const Surface& surface, const Cuts& cuts, std::size_t nth) {
  const CellTable& table = surface.table();
  DrawnLinks drawn;
  std::size_t count = 0;
  const auto add = [&](LinkId link) {
    if (count++ % nth == 0 && !cuts.is_cut(link)) {
      drawn.numbers.push_back(link);
      const auto& ends = table.mesh()->links[link];
      drawn.ends.insert(drawn.ends.end(), ends.begin(), ends.end());
    }
  };
  std::ranges::for_each(surface.links(), add);
  std::ranges::for_each(table.loose_links(), add);
  return drawn;
}

std::vector<ElementId> surfaceFaces(const Surface& surface, const Cuts& cuts) {
  const CellTable& table = surface.table();
  std::vector<ElementId> corners;
  for (const SideId side : surface.sides()) {
    if (table.twin(side) == CellTable::none) {
      append_triangles(table.side(side), corners);
    }
  }
  for (const std::uint32_t i : table.loose_triangles()) {
    if (const auto& face = table.mesh()->triangles[i]; isWholeFace(*table.mesh(), cuts, face)) {
      corners.insert(corners.end(), face.begin(), face.end());
    }
  }
  return corners;
}

std::vector<ElementId> freshSurfaceFaces(const Surface& surface) {
  const CellTable& table = surface.table();
  std::vector<ElementId> corners;
  for (const SideId side : surface.sides()) {
    if (table.twin(side) != CellTable::none) {
      append_triangles(table.side(side), corners);
    }
  }
  return corners;
}

std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost) {
  const std::size_t share = (elements.size() + atMost - 1) / atMost;
  if (share <= 1) {
    return elements;
  }
  std::vector<ElementId> indices;
  std::copy_if(elements.begin(), elements.end(), std::back_inserter(indices),
               [share](ElementId e) { return scatter(e) % share == 0; });
  return indices;
}

}  // namespace chainmail
