#include "files/mesh/mesh_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "files/mesh/flaws.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Copies a flat array of ids in groups. Throws Error if it is not whole groups, or for an id without a position.
template <std::size_t Size>
std::vector<std::array<ElementId, Size>> groups_of(const std::string& name, std::span<const ElementId> flat,
                                                   std::size_t element_count) {
  if (flat.size() % Size != 0) {
    throw Error(name, "there are " + std::to_string(flat.size()) + " ids",
                "give " + std::to_string(Size) + " for each");
  }
  std::vector<std::array<ElementId, Size>> groups(flat.size() / Size);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat[i] >= element_count) {
      throw Error(
          name,
          "number " + std::to_string(i / Size) + " uses element " + std::to_string(flat[i]) + ", which has no position",
          "use ids below " + std::to_string(element_count));
    }
    groups[i / Size][i % Size] = flat[i];
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto corners = groups[i];
    std::ranges::sort(corners);
    if (std::ranges::adjacent_find(corners) != corners.end()) {
      throw Error(name, "number " + std::to_string(i) + " uses an element twice", "name different elements");
    }
  }
  return groups;
}

std::vector<Point> points_of(std::span<const double> positions) {
  if (positions.empty() || positions.size() % 3 != 0) {
    throw Error("positions", "there are " + std::to_string(positions.size()) + " numbers",
                "give x, y and z for each element");
  }
  if (positions.size() / 3 > element_limit) {
    throw Error("positions", "there are too many elements", "use at most " + std::to_string(element_limit));
  }
  std::vector<Point> points(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!(std::abs(positions[i]) <= coordinate_limit)) {
      throw Error("positions, element " + std::to_string(i / 3), "a coordinate is not a finite number up to 1e100",
                  "give smaller numbers");
    }
    points[i / 3][int(i % 3)] = positions[i];
  }
  return points;
}

MeshParts parts_of(const MeshArrays& arrays) {
  MeshParts parts;
  parts.rest = points_of(arrays.positions);
  const std::size_t count = parts.rest.size();
  parts.links = groups_of<2>("links", arrays.links, count);
  parts.triangles = groups_of<3>("triangles", arrays.triangles, count);
  parts.tetrahedra = groups_of<4>("tetrahedra", arrays.tetrahedra, count);
  parts.hexahedra = groups_of<8>("hexahedra", arrays.hexahedra, count);
  parts.space_dimension = arrays.space_dimension;
  add_links_along_edges(parts);
  if (parts.links.empty()) {
    throw Error("links", "there is no link", "give links, faces or cells");
  }
  MeshFlaws flaws;
  leave_out_flawed(parts, flaws);
  if (flaws.doubled > 0) {
    throw Error("faces and cells", std::to_string(flaws.doubled) + " are there twice", "give each one once");
  }
  return parts;
}

}  // namespace

MeshPointer make_mesh(const MeshArrays& arrays) { return build_mesh(parts_of(arrays)); }

}  // namespace chainmail
