#include "mesh/cells.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

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

bool OrderAtRest::operator()(ElementId one, ElementId other) const {
  const Point a = mesh.rest_position(one), b = mesh.rest_position(other);
  return std::tuple(a.z(), a.y(), a.x(), one) < std::tuple(b.z(), b.y(), b.x(), other);
}

double tetrahedron_quality(const std::array<Point, 4>& corners) {
  const auto& [p, q, r, s] = corners;
  const double longest =
      std::max({(q - p).cwiseAbs().maxCoeff(), (r - p).cwiseAbs().maxCoeff(), (s - p).cwiseAbs().maxCoeff()});
  if (!(longest > 0) || !std::isfinite(longest)) {
    return 0;
  }
  const double scale = std::exp2(-std::ilogb(longest));  // a power of two, so that nothing is rounded
  const Point a = scale * (q - p), b = scale * (r - p), c = scale * (s - p);
  const Point bc = b.cross(c), ab = a.cross(b), ac = a.cross(c);
  const double volume = std::abs(a.dot(bc));  // times 6
  const double area = bc.norm() + ab.norm() + ac.norm() + (b - a).cross(c - a).norm();
  const double radius = (a.squaredNorm() * bc - b.squaredNorm() * ac + c.squaredNorm() * ab).norm();
  const double quality = 6 * volume * volume / (area * radius);
  return quality > 0 ? quality : 0;  // also if it is NaN
}

namespace {

/// Sort key of a side: its corners except the lowest, ascending. Two coinciding sides have the same corners.
struct Key {
  std::uint64_t second_and_third = 0;
  ElementId fourth = CellTable::none;
  SideId side = 0;

  bool operator<(const Key& other) const {
    return second_and_third != other.second_and_third ? second_and_third < other.second_and_third
           : fourth != other.fourth                   ? fourth < other.fourth
                                                      : side < other.side;
  }
  bool is_alike(const Key& other) const { return second_and_third == other.second_and_third && fourth == other.fourth; }
};

Key key_of(const Side& side, SideId number) {
  auto corner = side.corner;
  if (side.count == 3) {
    corner[3] = CellTable::none;
  }
  for (const auto& [i, j] : std::array<std::array<int, 2>, 5>{{{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}}}) {
    if (corner[j] < corner[i]) {
      std::swap(corner[i], corner[j]);
    }
  }
  return {std::uint64_t{corner[1]} << 32 | corner[2], corner[3], number};
}

bool is_lowest(const Side& side, ElementId element) {
  return std::all_of(side.corner.begin(), side.corner.begin() + side.count,
                     [element](ElementId corner) { return element <= corner; });
}

bool has(const Side& side, ElementId element) {
  return std::find(side.corner.begin(), side.corner.begin() + side.count, element) != side.corner.begin() + side.count;
}

}  // namespace

CellTable::CellTable(MeshPointer mesh, const Progress& progress)
    : mesh_(std::move(mesh)), tetrahedra_(static_cast<std::uint32_t>(mesh_->tetrahedra.size())) {
  if (cell_count() == 0) {
    return;
  }
  progress.report(0);
  list_cells();
  progress.report(0.1);
  pair_sides(progress.part(0.1, 0.9));
  pair_with_triangles();
  find_loose_links();
  find_loose_triangles();
}

std::span<const ElementId> CellTable::corners_of(CellId cell) const {
  if (cell < tetrahedra_) {
    return mesh_->tetrahedra[cell];
  }
  return mesh_->hexahedra[cell - tetrahedra_];
}

std::span<const CellEdge> CellTable::edges_of(CellId cell) const {
  if (cell < tetrahedra_) {
    return tetrahedron_edges;
  }
  return hexahedron_edges;
}

Side CellTable::side_by_number(SideId number) const {
  const CellId cell = cell_of(number);
  const auto corners = corners_of(cell);
  Side side;
  const auto take = [&](const auto& places) {
    side.count = static_cast<int>(places.size());
    std::transform(places.begin(), places.end(), side.corner.begin(), [&](int index) { return corners[index]; });
  };
  const SideId which = number - first_side(cell);
  cell < tetrahedra_ ? take(tetrahedron_sides[which]) : take(hexahedron_sides[which]);
  return side;
}

/// Returns true if the three edges at the first corner of the cell form a left-handed system.
bool CellTable::is_inverted(CellId cell) const {
  const auto corners = corners_of(cell);
  const Point at = mesh_->rest_position(corners[0]);
  Eigen::Matrix3d edges;
  edges.col(0) = mesh_->rest_position(corners[1]) - at;
  edges.col(1) = mesh_->rest_position(corners[cell < tetrahedra_ ? 2 : 3]) - at;
  edges.col(2) = mesh_->rest_position(corners[cell < tetrahedra_ ? 3 : 4]) - at;
  return edges.determinant() < 0;
}

Side CellTable::side(SideId number) const {
  Side side = side_by_number(number);
  if (is_inverted(cell_of(number))) {
    std::reverse(side.corner.begin(), side.corner.begin() + side.count);
  }
  return side;
}

bool CellTable::has_corner(SideId side, ElementId element) const { return has(side_by_number(side), element); }

bool CellTable::has_edge(CellId cell, ElementId a, ElementId b) const {
  const auto corners = corners_of(cell);
  const auto edges = edges_of(cell);
  return std::any_of(edges.begin(), edges.end(), [&](const CellEdge& edge) {
    const ElementId i = corners[edge[0]], j = corners[edge[1]];
    return (i == a && j == b) || (i == b && j == a);
  });
}

void CellTable::list_cells() {
  // A collapsed cell has the same corner twice, but is listed there once.
  const auto for_each_corner = [this](auto visit) {
    for (CellId cell = 0; cell < cell_count(); ++cell) {
      const auto corners = corners_of(cell);
      for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
        if (std::find(corners.begin(), corner, *corner) == corner) {
          visit(cell, *corner);
        }
      }
    }
  };
  first_cell_.assign(std::size_t{mesh_->element_count()} + 1, 0);
  for_each_corner([this](CellId /*cell*/, ElementId corner) { ++first_cell_[corner + 1]; });
  std::partial_sum(first_cell_.begin(), first_cell_.end(), first_cell_.begin());
  cells_.resize(first_cell_.back());
  std::vector<std::uint32_t> next(first_cell_.begin(), first_cell_.end() - 1);
  for_each_corner([&](CellId cell, ElementId corner) { cells_[next[corner]++] = cell; });
}

/// Pairs coinciding sides. They have the same lowest corner, and few sides share one, so only short lists are sorted.
void CellTable::pair_sides(const Progress& progress) {
  twins_.assign(std::size_t{4} * tetrahedra_ + 6 * mesh_->hexahedra.size(), none);
  std::vector<Key> keys;
  for (ElementId e = 0; e < mesh_->element_count(); ++e) {
    progress.report(e, mesh_->element_count());
    keys.clear();
    for (const CellId cell : cells_of(e)) {
      for (SideId i = first_side(cell); i < end_side(cell); ++i) {
        if (const Side side = side_by_number(i); has(side, e) && is_lowest(side, e)) {
          keys.push_back(key_of(side, i));
        }
      }
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
      if (keys[i].is_alike(keys[i + 1])) {
        twins_[keys[i].side] = keys[i + 1].side;
        twins_[keys[i + 1].side] = keys[i].side;
        ++i;
      }
    }
  }
}

/// Pairs sides of hexahedra with two sides of tetrahedra each.
void CellTable::pair_with_triangles() {
  if (tetrahedra_ == 0 || mesh_->hexahedra.empty()) {
    return;
  }
  const auto key_of_three = [](ElementId a, ElementId b, ElementId c) {
    std::array key{a, b, c};
    std::ranges::sort(key);
    return key;
  };
  std::map<std::array<ElementId, 3>, SideId> open;
  for (SideId side = 0; side < 4 * tetrahedra_; ++side) {
    if (twins_[side] == none) {
      const auto& [a, b, c, d] = side_by_number(side).corner;
      open[key_of_three(a, b, c)] = side;
    }
  }
  for (SideId side = 4 * tetrahedra_; side < side_count(); ++side) {
    if (twins_[side] != none) {
      continue;
    }
    auto corner = side_by_number(side).corner;
    std::rotate(corner.begin(), std::ranges::min_element(corner, OrderAtRest{*mesh_}), corner.end());
    const auto one = open.find(key_of_three(corner[0], corner[1], corner[2]));
    const auto other = open.find(key_of_three(corner[0], corner[2], corner[3]));
    if (one != open.end() && other != open.end() && one != other) {
      twins_[side] = one->second;
      second_twins_[side] = other->second;
      twins_[one->second] = twins_[other->second] = side;
      open.erase(one);
      open.erase(other);
    }
  }
}

void CellTable::find_loose_links() {
  std::vector<ElementId> joined(mesh_->element_count(), none);  // joined[b] is a while an edge of a cell joins a and b
  for (ElementId a = 0; a < mesh_->element_count(); ++a) {
    for (const CellId cell : cells_of(a)) {
      const auto corners = corners_of(cell);
      for (const auto& [i, j] : edges_of(cell)) {
        if (corners[i] == a || corners[j] == a) {
          joined[corners[i] == a ? corners[j] : corners[i]] = a;
        }
      }
    }
    for (EntryId entry = mesh_->first_entry[a]; entry < mesh_->first_entry[a + 1]; ++entry) {
      if (a < mesh_->neighbours[entry] && joined[mesh_->neighbours[entry]] != a) {
        loose_links_.push_back(mesh_->entry_link[entry]);
      }
    }
  }
  std::sort(loose_links_.begin(), loose_links_.end());
}

void CellTable::find_loose_triangles() {
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) {
    const auto [a, b, c] = mesh_->triangles[i];
    const auto cells = cells_of(a);
    const bool on_side = std::any_of(cells.begin(), cells.end(), [&, b = b, c = c](CellId cell) {
      for (SideId side = first_side(cell); side < end_side(cell); ++side) {
        if (has_corner(side, mesh_->triangles[i][0]) && has_corner(side, b) && has_corner(side, c)) {
          return true;
        }
      }
      return false;
    });
    if (!on_side) {
      loose_triangles_.push_back(i);
    }
  }
}

}  // namespace chainmail
