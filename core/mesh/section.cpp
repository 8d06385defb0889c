#include "mesh/section.h"

#include <algorithm>

namespace chainmail {
namespace {

/// The six tetrahedra around the diagonal of a hexahedron from its first corner to the opposite one, as indices of its
/// corners (Freudenthal 1942). In a regular block, two neighbours split their common side in the same way.
constexpr std::array<std::array<int, 4>, 6> tetrahedra_of_hexahedron{
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};

}  // namespace

Section::Section(CellTablePointer table, const SectionPlane& plane) : table_(std::move(table)), plane_(plane) {
  const Mesh& mesh = *table_->mesh();
  std::vector<bool> before(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    before[e] = plane_.before(mesh.rest_position(e)) > 0;
  }
  first_corner_.push_back(0);
  for (CellId cell = 0; cell < table_->cell_count(); ++cell) {
    cross(cell, before);
  }
  numbers_ = {};
}

void Section::cross(CellId cell, const std::vector<bool>& before) {
  const auto corners = table_->corners_of(cell);
  const auto in_front = std::count_if(corners.begin(), corners.end(), [&](ElementId e) { return before[e]; });
  if (in_front == 0 || in_front == std::ssize(corners)) {
    return;
  }
  if (corners.size() == 4) {
    cross_tetrahedron({corners[0], corners[1], corners[2], corners[3]}, before);
  } else {
    for (const auto& [i, j, k, l] : tetrahedra_of_hexahedron) {
      cross_tetrahedron({corners[i], corners[j], corners[k], corners[l]}, before);
    }
  }
  cells_.push_back(cell);
  first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
}

/// Cuts a tetrahedron. One corner alone on its side of the plane gives a triangle, two corners give a quadrilateral.
void Section::cross_tetrahedron(const std::array<ElementId, 4>& corners, const std::vector<bool>& before) {
  std::array<ElementId, 4> sorted = corners;
  const auto middle = std::stable_partition(sorted.begin(), sorted.end(), [&](ElementId e) { return !before[e]; });
  const auto behind = std::span(sorted.begin(), middle), in_front = std::span(middle, sorted.end());
  if (behind.empty() || in_front.empty()) {
    return;
  }
  std::vector<std::uint32_t> around;
  if (behind.size() == 2) {
    around = {point(behind[0], in_front[0]), point(behind[0], in_front[1]), point(behind[1], in_front[1]),
              point(behind[1], in_front[0])};
  } else {
    for (const ElementId low : behind) {
      for (const ElementId high : in_front) {
        around.push_back(point(low, high));
      }
    }
  }
  for (std::size_t i = 2; i < around.size(); ++i) {
    corners_.insert(corners_.end(), {around[0], around[i - 1], around[i]});
  }
}

std::uint32_t Section::point(ElementId behind, ElementId before) {
  const auto [low, high] = std::minmax(behind, before);
  const auto [found, is_new] =
      numbers_.try_emplace(std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(points_.size()));
  if (is_new) {
    const Mesh& mesh = *table_->mesh();
    const double a = plane_.before(mesh.rest_position(low)), b = plane_.before(mesh.rest_position(high));
    points_.push_back({low, high, static_cast<float>(a / (a - b))});
  }
  return found->second;
}

std::vector<std::uint32_t> Section::triangles(const Surface& surface) const {
  std::vector<std::uint32_t> result;
  result.reserve(corners_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (surface.is_whole(cells_[i])) {
      result.insert(result.end(), corners_.begin() + first_corner_[i], corners_.begin() + first_corner_[i + 1]);
    }
  }
  return result;
}

}  // namespace chainmail
