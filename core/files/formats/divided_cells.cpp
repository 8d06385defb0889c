#include "files/formats/divided_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace chainmail {
namespace {

void add_tetrahedron(MeshParts& parts, std::array<ElementId, 4> corners) {
  const auto from_first = [&](int i) { return parts.rest[corners[std::size_t(i)]] - parts.rest[corners[0]]; };
  if (from_first(1).cross(from_first(2)).dot(from_first(3)) < 0) {
    std::swap(corners[2], corners[3]);
  }
  parts.tetrahedra.push_back(corners);
}

/// The corners, so that the one with the lowest id is first, for each of its places.
constexpr std::array<std::array<std::size_t, 6>, 6> prism_orders{{{0, 1, 2, 3, 4, 5},
                                                                  {1, 2, 0, 4, 5, 3},
                                                                  {2, 0, 1, 5, 3, 4},
                                                                  {3, 5, 4, 0, 2, 1},
                                                                  {4, 3, 5, 1, 0, 2},
                                                                  {5, 4, 3, 2, 1, 0}}};

/// Divides the sides at the corner with the lowest id, and the side opposite of it at its own lowest.
void add_prism(MeshParts& parts, std::span<const ElementId> corners) {
  const auto lowest = std::size_t(std::min_element(corners.begin(), corners.end()) - corners.begin());
  const auto v = [&](std::size_t i) { return corners[prism_orders[lowest][i]]; };
  if (std::min(v(1), v(5)) < std::min(v(2), v(4))) {
    add_tetrahedron(parts, {v(0), v(1), v(2), v(5)});
    add_tetrahedron(parts, {v(0), v(1), v(5), v(4)});
  } else {
    add_tetrahedron(parts, {v(0), v(1), v(2), v(4)});
    add_tetrahedron(parts, {v(0), v(4), v(2), v(5)});
  }
  add_tetrahedron(parts, {v(0), v(4), v(5), v(3)});
}

void add_pyramid(MeshParts& parts, std::span<const ElementId> v) {
  const std::size_t first = std::min(v[0], v[2]) < std::min(v[1], v[3]) ? 0 : 1;
  add_tetrahedron(parts, {v[first], v[first + 1], v[first + 2], v[4]});
  add_tetrahedron(parts, {v[first], v[first + 2], v[(first + 3) % 4], v[4]});
}

template <std::size_t Size, std::size_t Count>
void add_each(std::span<const ElementId> v, const std::array<std::array<std::size_t, Size>, Count>& pieces,
              const auto& add) {
  for (const auto& piece : pieces) {
    std::array<ElementId, Size> corners{};
    std::transform(piece.begin(), piece.end(), corners.begin(), [&](std::size_t i) { return v[i]; });
    add(corners);
  }
}

constexpr std::array<std::array<std::size_t, 2>, 2> lines_of_line3{{{0, 2}, {2, 1}}};
constexpr std::array<std::array<std::size_t, 3>, 4> triangles_of_triangle6{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
/// Four at the corners, and four about the line between the middles of two opposite edges.
constexpr std::array<std::array<std::size_t, 4>, 8> tetrahedra_of_tetrahedron10{
    {{0, 4, 6, 7}, {1, 5, 4, 9}, {2, 6, 5, 8}, {3, 9, 7, 8}, {6, 9, 4, 5}, {6, 9, 5, 8}, {6, 9, 8, 7}, {6, 9, 7, 4}}};

}  // namespace

std::size_t corner_count(DividedKind kind) {
  switch (kind) {
    case DividedKind::prism:
    case DividedKind::triangle6:
      return 6;
    case DividedKind::pyramid:
      return 5;
    case DividedKind::line3:
      return 3;
    case DividedKind::tetrahedron10:
      return 10;
  }
  return 0;
}

void add_divided(ImportedMesh& mesh, DividedKind kind, std::span<const ElementId> corners) {
  MeshParts& parts = mesh.parts;
  ++mesh.divided;
  switch (kind) {
    case DividedKind::prism:
      return add_prism(parts, corners);
    case DividedKind::pyramid:
      return add_pyramid(parts, corners);
    case DividedKind::line3:
      return add_each(corners, lines_of_line3, [&](const auto& line) { parts.links.push_back(line); });
    case DividedKind::triangle6:
      return add_each(corners, triangles_of_triangle6, [&](const auto& face) { parts.triangles.push_back(face); });
    case DividedKind::tetrahedron10:
      return add_each(corners, tetrahedra_of_tetrahedron10, [&](const auto& cell) { add_tetrahedron(parts, cell); });
  }
}

}  // namespace chainmail
