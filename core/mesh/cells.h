#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// A cell is a tetrahedron or a hexahedron. These tables give its edges and sides as indices of its corners.

using CellEdge = std::array<int, 2>;
/// Sides are counterclockwise as seen from outside, unless the cell is inverted.
template <std::size_t Corners>
using CellSide = std::array<int, Corners>;

inline constexpr std::array<CellEdge, 6> tetrahedron_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<CellSide<3>, 4> tetrahedron_sides{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
inline constexpr std::array<CellEdge, 12> hexahedron_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
inline constexpr std::array<CellSide<4>, 6> hexahedron_sides{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

constexpr const auto& edges_of(const std::array<ElementId, 4>& /*cell*/) { return tetrahedron_edges; }
constexpr const auto& edges_of(const std::array<ElementId, 8>& /*cell*/) { return hexahedron_edges; }

/// True if two elements are linked and the link is cut.
inline bool is_cut_between(const Mesh& mesh, const Cuts& cuts, ElementId a, ElementId b) {
  const auto link = cuts.touches(a) && cuts.touches(b) ? find_link(mesh, a, b) : std::nullopt;
  return link && cuts.is_cut(*link);
}

/// True if no link along the edges of a cell is cut. Otherwise the cell is gone.
template <std::size_t Corners>
bool is_whole(const Mesh& mesh, const Cuts& cuts, const std::array<ElementId, Corners>& cell) {
  return std::none_of(edges_of(cell).begin(), edges_of(cell).end(),
                      [&](const CellEdge& edge) { return is_cut_between(mesh, cuts, cell[edge[0]], cell[edge[1]]); });
}

/// Adds links along the edges of all faces and cells, for files that list no links.
void add_links_along_edges(MeshParts& parts);

}  // namespace chainmail
