#include "files/formats/divided_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
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

/// Adds the quadrangle to the faces.
void add_quadrangle(MeshParts& parts, const std::array<ElementId, 4>& corners) {
  parts.polygons.push_back(4);
  parts.polygons.insert(parts.polygons.end(), corners.begin(), corners.end());
}

constexpr std::array<std::array<std::size_t, 2>, 2> lines_of_line3{{{0, 2}, {2, 1}}};
constexpr std::array<std::array<std::size_t, 3>, 4> triangles_of_triangle6{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
constexpr std::array<std::array<std::size_t, 3>, 4> corners_of_quadrangle8{
    {{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}}};
constexpr std::array<std::array<std::size_t, 4>, 4> parts_of_quadrangle9{
    {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}};
/// Four at the corners, and four about the line between the middles of two opposite edges.
constexpr std::array<std::array<std::size_t, 4>, 8> tetrahedra_of_tetrahedron10{
    {{0, 4, 6, 7}, {1, 5, 4, 9}, {2, 6, 5, 8}, {3, 9, 7, 8}, {6, 9, 4, 5}, {6, 9, 5, 8}, {6, 9, 8, 7}, {6, 9, 7, 4}}};
/// Each layer is divided as triangle6.
constexpr std::array<std::array<std::size_t, 6>, 8> prisms_of_prism18{{{0, 6, 7, 8, 15, 16},
                                                                       {6, 1, 9, 15, 10, 17},
                                                                       {7, 9, 2, 16, 17, 11},
                                                                       {6, 9, 7, 15, 17, 16},
                                                                       {8, 15, 16, 3, 12, 13},
                                                                       {15, 10, 17, 12, 4, 14},
                                                                       {16, 17, 11, 13, 14, 5},
                                                                       {15, 17, 16, 12, 14, 13}}};
/// Four at the corners, one at the top, one below it upside down; between them are four tetrahedra.
constexpr std::array<std::array<std::size_t, 5>, 6> pyramids_of_pyramid14{{{0, 5, 13, 6, 7},
                                                                           {5, 1, 8, 13, 9},
                                                                           {13, 8, 2, 10, 11},
                                                                           {6, 13, 10, 3, 12},
                                                                           {7, 9, 11, 12, 4},
                                                                           {7, 9, 11, 12, 13}}};
constexpr std::array<std::array<std::size_t, 4>, 4> tetrahedra_of_pyramid14{
    {{5, 13, 7, 9}, {8, 13, 9, 11}, {10, 13, 11, 12}, {6, 13, 12, 7}}};
constexpr std::array<std::array<std::size_t, 8>, 8> hexahedra_of_hexahedron27{{{0, 8, 20, 9, 10, 21, 26, 22},
                                                                               {8, 1, 11, 20, 21, 12, 23, 26},
                                                                               {20, 11, 2, 13, 26, 23, 14, 24},
                                                                               {9, 20, 13, 3, 22, 26, 24, 15},
                                                                               {10, 21, 26, 22, 4, 16, 25, 17},
                                                                               {21, 12, 23, 26, 16, 5, 18, 25},
                                                                               {26, 23, 14, 24, 25, 18, 6, 19},
                                                                               {22, 26, 24, 15, 17, 25, 19, 7}}};

constexpr std::array<std::array<std::size_t, 4>, 2> parts_of_quadrangle6{{{0, 4, 5, 3}, {4, 1, 2, 5}}};
constexpr std::array<std::array<std::size_t, 3>, 6> triangles_of_triangle7{
    {{0, 3, 6}, {3, 1, 6}, {1, 4, 6}, {4, 2, 6}, {2, 5, 6}, {5, 0, 6}}};
constexpr std::array<std::array<std::size_t, 6>, 4> prisms_of_prism12{
    {{0, 6, 8, 3, 9, 11}, {6, 1, 7, 9, 4, 10}, {8, 7, 2, 11, 10, 5}, {6, 7, 8, 9, 10, 11}}};
constexpr std::array<std::array<std::size_t, 4>, 4> quadrangles_of_pyramid19{
    {{0, 5, 13, 8}, {5, 1, 6, 13}, {13, 6, 2, 7}, {8, 13, 7, 3}}};
/// What surrounds the triangles, and their middles.
constexpr std::array<std::array<std::size_t, 7>, 4> faces_of_pyramid19{
    {{0, 5, 1, 10, 4, 9, 14}, {1, 6, 2, 11, 4, 10, 15}, {2, 7, 3, 12, 4, 11, 16}, {3, 8, 0, 9, 4, 12, 17}}};
/// Two layers, each with a prism at each upright edge, and what is between these.
constexpr std::array<std::array<std::size_t, 6>, 8> prisms_of_hexahedron24{{{0, 8, 11, 16, 22, 20},
                                                                            {1, 9, 8, 17, 21, 22},
                                                                            {2, 10, 9, 18, 23, 21},
                                                                            {3, 11, 10, 19, 20, 23},
                                                                            {16, 22, 20, 4, 12, 15},
                                                                            {17, 21, 22, 5, 13, 12},
                                                                            {18, 23, 21, 6, 14, 13},
                                                                            {19, 20, 23, 7, 15, 14}}};
constexpr std::array<std::array<std::size_t, 8>, 2> middles_of_hexahedron24{
    {{8, 9, 10, 11, 22, 21, 23, 20}, {22, 21, 23, 20, 12, 13, 14, 15}}};

/// A solid of second order without middles of faces. What remains without its corners is bounded by middles.
template <std::size_t Edges, std::size_t Faces>
struct Middles {
  std::size_t corners;
  /// The ends of the edges, in the order of their middles.
  std::array<std::array<std::size_t, 2>, Edges> edges;
  /// The middles on each face of the solid, around it. The last of three stands twice.
  std::array<std::array<std::size_t, 4>, Faces> faces;
};

constexpr Middles<12, 6> hexahedron20{
    8,
    {{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}},
    {{{8, 11, 13, 9}, {8, 12, 16, 10}, {9, 15, 17, 10}, {11, 14, 18, 12}, {13, 15, 19, 14}, {16, 18, 19, 17}}}};
constexpr Middles<9, 5> prism15{6,
                                {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}},
                                {{{6, 9, 7, 7}, {12, 14, 13, 13}, {6, 10, 12, 8}, {7, 11, 13, 8}, {9, 11, 14, 10}}}};
constexpr Middles<8, 5> pyramid13{5,
                                  {{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}},
                                  {{{5, 8, 10, 6}, {5, 9, 7, 7}, {8, 11, 9, 9}, {10, 12, 11, 11}, {6, 7, 12, 12}}}};

/// Divides what these sides bound into tetrahedra with one corner: the middle, or else that of the lowest id, which
/// lies on the surface. Each side is divided at its own lowest, so that neighbours agree.
void add_convex(MeshParts& parts, std::vector<std::vector<ElementId>> sides, std::optional<ElementId> middle = {}) {
  ElementId apex = middle.value_or(sides[0][0]);
  for (auto& side : sides) {
    std::rotate(side.begin(), std::min_element(side.begin(), side.end()), side.end());
    apex = middle ? *middle : std::min(apex, side[0]);
  }
  for (const auto& side : sides) {
    for (std::size_t i = 2; i < side.size() && side[0] != apex; ++i) {
      add_tetrahedron(parts, {apex, side[0], side[i - 1], side[i]});
    }
  }
}

/// A prism on a face of any number of corners, which are given first; those of the opposite face follow.
void add_prism_on(MeshParts& parts, std::span<const ElementId> v) {
  const std::size_t count = v.size() / 2;
  std::vector<std::vector<ElementId>> sides{{v.begin(), v.begin() + std::ptrdiff_t(count)},
                                            {v.begin() + std::ptrdiff_t(count), v.end()}};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    sides.push_back({v[i], v[next], v[count + next], v[count + i]});
  }
  add_convex(parts, std::move(sides));
}

/// Divides each face around its middle, and the solid around its own.
void add_pyramid19(MeshParts& parts, std::span<const ElementId> v) {
  std::vector<std::vector<ElementId>> sides;
  sides.reserve(quadrangles_of_pyramid19.size() + 6 * faces_of_pyramid19.size());
  for (const auto& [a, b, c, d] : quadrangles_of_pyramid19) {
    sides.push_back({v[a], v[b], v[c], v[d]});
  }
  for (const auto& around : faces_of_pyramid19) {
    for (std::size_t i = 0; i < 6; ++i) {
      sides.push_back({v[around[i]], v[around[(i + 1) % 6]], v[around[6]]});
    }
  }
  add_convex(parts, std::move(sides), v[18]);
}

/// Cuts the corners off, and divides the rest.
template <std::size_t Edges, std::size_t Faces>
void add_middles(MeshParts& parts, const Middles<Edges, Faces>& shape, std::span<const ElementId> v) {
  std::vector<std::vector<ElementId>> sides;
  for (const auto& [a, b, c, d] : shape.faces) {
    sides.push_back(c == d ? std::vector{v[a], v[b], v[c]} : std::vector{v[a], v[b], v[c], v[d]});
  }
  for (std::size_t corner = 0; corner < shape.corners; ++corner) {
    std::vector<ElementId> around;
    for (std::size_t i = 0; i < shape.edges.size(); ++i) {
      if (shape.edges[i][0] == corner || shape.edges[i][1] == corner) {
        around.push_back(v[shape.corners + i]);
      }
    }
    if (around.size() == 3) {
      add_tetrahedron(parts, {v[corner], around[0], around[1], around[2]});
    } else {
      add_pyramid(parts, std::array{around[0], around[1], around[2], around[3], v[corner]});
    }
    sides.push_back(std::move(around));
  }
  add_convex(parts, std::move(sides));
}

}  // namespace

void add_divided(ImportedMesh& mesh, DividedKind kind, std::span<const ElementId> corners) {
  MeshParts& parts = mesh.parts;
  const auto tetrahedron = [&](const auto& cell) { add_tetrahedron(parts, cell); };
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
    case DividedKind::quadrangle8:
      add_each(corners, corners_of_quadrangle8, [&](const auto& face) { parts.triangles.push_back(face); });
      return add_quadrangle(parts, {corners[4], corners[5], corners[6], corners[7]});
    case DividedKind::quadrangle9:
      return add_each(corners, parts_of_quadrangle9, [&](const auto& face) { add_quadrangle(parts, face); });
    case DividedKind::tetrahedron10:
      return add_each(corners, tetrahedra_of_tetrahedron10, tetrahedron);
    case DividedKind::pyramid13:
      return add_middles(parts, pyramid13, corners);
    case DividedKind::pyramid14:
      add_each(corners, pyramids_of_pyramid14, [&](const auto& cell) { add_pyramid(parts, cell); });
      return add_each(corners, tetrahedra_of_pyramid14, tetrahedron);
    case DividedKind::prism15:
      return add_middles(parts, prism15, corners);
    case DividedKind::prism18:
      return add_each(corners, prisms_of_prism18, [&](const auto& cell) { add_prism(parts, cell); });
    case DividedKind::hexahedron20:
      return add_middles(parts, hexahedron20, corners);
    case DividedKind::hexahedron27:
      return add_each(corners, hexahedra_of_hexahedron27, [&](const auto& cell) { parts.hexahedra.push_back(cell); });
    case DividedKind::pentagonal_prism:
    case DividedKind::hexagonal_prism:
      return add_prism_on(parts, corners);
    case DividedKind::quadrangle6:
      return add_each(corners, parts_of_quadrangle6, [&](const auto& face) { add_quadrangle(parts, face); });
    case DividedKind::triangle7:
      return add_each(corners, triangles_of_triangle7, [&](const auto& face) { parts.triangles.push_back(face); });
    case DividedKind::prism12:
      return add_each(corners, prisms_of_prism12, [&](const auto& cell) { add_prism(parts, cell); });
    case DividedKind::pyramid19:
      return add_pyramid19(parts, corners);
    case DividedKind::hexahedron24:
      add_each(corners, prisms_of_hexahedron24, [&](const auto& cell) { add_prism(parts, cell); });
      return add_each(corners, middles_of_hexahedron24, [&](const auto& cell) { add_prism_on(parts, cell); });
  }
}

std::vector<ElementId> in_order(const std::vector<ElementId>& corners, std::span<const int> order) {
  if (order.empty()) {
    return corners;
  }
  std::vector<ElementId> result(corners.size());
  std::ranges::transform(order.first(corners.size()), result.begin(),
                         [&](int place) { return corners[std::size_t(place)]; });
  return result;
}

}  // namespace chainmail
