#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

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

/// Orders elements by z, y and x at rest, then by id. So a copy of an element comes where the element does.
struct OrderAtRest {
  const Mesh& mesh;

  bool operator()(ElementId one, ElementId other) const;
};

/// Calls visit(corners) for each cube between the elements of a lattice in space.
template <class Visit>
void for_each_cube(const Lattice& lattice, Visit visit) {
  const auto [width, height, depth] = lattice.size;
  const ElementId row = width, slice = width * height;
  for (std::uint32_t z = 0; z + 1 < depth; ++z) {
    for (std::uint32_t y = 0; y + 1 < height; ++y) {
      for (std::uint32_t x = 0; x + 1 < width; ++x) {
        const ElementId a = z * slice + y * row + x, e = a + slice;
        visit(std::array<ElementId, 8>{a, a + 1, a + row + 1, a + row, e, e + 1, e + row + 1, e + row});
      }
    }
  }
}

/// Calls visit(corners) for the six tetrahedra that a hexahedron stands for: a fan from its first corner over the sides
/// without this corner. Each side is divided by the diagonal from its own first corner, so neighbours agree.
template <class Visit>
void for_each_tetrahedron(const Mesh& mesh, const std::array<ElementId, 8>& cell, Visit visit) {
  const ElementId first = *std::ranges::min_element(cell, OrderAtRest{mesh});
  for (const auto& side : hexahedron_sides) {
    std::array<ElementId, 4> corners{cell[side[0]], cell[side[1]], cell[side[2]], cell[side[3]]};
    if (std::ranges::find(corners, first) == corners.end()) {
      std::rotate(corners.begin(), std::ranges::min_element(corners, OrderAtRest{mesh}), corners.end());
      visit(std::array{first, corners[0], corners[1], corners[2]});
      visit(std::array{first, corners[0], corners[2], corners[3]});
    }
  }
}

/// Returns three times the radius of the inscribed sphere of a tetrahedron, relative to that of the circumscribed one:
/// 1 if it is regular, 0 if it is flat or not finite.
double tetrahedron_quality(const std::array<Point, 4>& corners);

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

/// Index of a cell: the tetrahedra first, then the hexahedra.
using CellId = std::uint32_t;
/// Index of a side, cell by cell: four per tetrahedron, then six per hexahedron.
using SideId = std::uint32_t;

/// The corners of a side: three, or four in order around it.
struct Side {
  std::array<ElementId, 4> corner{};
  int count = 0;

  std::span<const ElementId> corners() const { return std::span(corner).first(std::size_t(count)); }
};

/// Neighbourhood of the cells of a mesh. Immutable, made once per mesh. Takes 16 bytes per tetrahedron, the same again
/// for the cells of each element, and nothing for a mesh without cells.
class CellTable {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Throws Cancelled.
  explicit CellTable(MeshPointer mesh, const Progress& progress = {});

  const MeshPointer& mesh() const { return mesh_; }
  CellId cell_count() const { return static_cast<CellId>(mesh_->tetrahedra.size() + mesh_->hexahedra.size()); }
  SideId side_count() const { return static_cast<SideId>(twins_.size()); }
  bool empty() const { return twins_.empty(); }

  std::span<const ElementId> corners_of(CellId cell) const;
  /// As indices of the corners of the cell.
  std::span<const CellEdge> edges_of(CellId cell) const;
  SideId first_side(CellId cell) const { return cell < tetrahedra_ ? 4 * cell : 6 * cell - 2 * tetrahedra_; }
  SideId end_side(CellId cell) const { return first_side(cell) + (cell < tetrahedra_ ? 4 : 6); }
  CellId cell_of(SideId side) const { return side < 4 * tetrahedra_ ? side / 4 : (side + 2 * tetrahedra_) / 6; }
  /// The elements of a side at rest, counterclockwise as seen from outside its cell.
  Side side(SideId side) const;
  bool has_corner(SideId side, ElementId element) const;
  /// Returns the side of another cell with the same corners, if any. If more than two sides have them, they are paired.
  /// A side of four corners may coincide with two of three: see for_each_tetrahedron. They have it as twin, and it one
  /// of them.
  SideId twin(SideId side) const { return twins_[side]; }
  template <class Visit>
  void for_each_twin(SideId side, Visit visit) const {
    if (twins_[side] != none) {
      visit(twins_[side]);
    }
    if (const auto second = second_twins_.find(side); second != second_twins_.end()) {
      visit(second->second);
    }
  }
  /// Returns the cells with this corner, ascending.
  std::span<const CellId> cells_of(ElementId element) const {
    return {cells_.data() + first_cell_[element], cells_.data() + first_cell_[element + 1]};
  }
  /// Calls visit(cell) for each cell with this link as an edge.
  template <class Visit>
  void for_each_cell(LinkId link, Visit visit) const {
    if (empty()) {
      return;
    }
    const auto [a, b] = mesh_->links[link];
    for (const CellId cell : cells_of(a)) {
      if (has_edge(cell, a, b)) {
        visit(cell);
      }
    }
  }
  /// Returns the links that are not an edge of a cell, ascending.
  const std::vector<LinkId>& loose_links() const { return loose_links_; }
  /// Returns the triangles of the mesh that are not part of a side of a cell, ascending.
  const std::vector<std::uint32_t>& loose_triangles() const { return loose_triangles_; }

 private:
  Side side_by_number(SideId side) const;
  bool is_inverted(CellId cell) const;
  bool has_edge(CellId cell, ElementId a, ElementId b) const;
  void list_cells();
  void pair_sides(const Progress& progress);
  void pair_with_triangles();
  void find_loose_links();
  void find_loose_triangles();

  MeshPointer mesh_;
  std::uint32_t tetrahedra_ = 0;
  std::vector<SideId> twins_;
  std::unordered_map<SideId, SideId> second_twins_;  // of sides of four corners
  std::vector<std::uint32_t> first_cell_;            // of each element, among cells_, and the end
  std::vector<CellId> cells_;
  std::vector<LinkId> loose_links_;
  std::vector<std::uint32_t> loose_triangles_;
};

using CellTablePointer = std::shared_ptr<const CellTable>;

}  // namespace chainmail
