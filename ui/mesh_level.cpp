#include "mesh_level.h"

#include <algorithm>
#include <numeric>

#include "simulate/frame.h"

namespace chainmail {
namespace {

constexpr unsigned keyBits = 10;  // of each axis

/// Spreads ten bits so that two fit between each and the next.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

/// Places along a curve that stays near where it is (Morton 1966), of the elements' rest positions.
std::vector<std::uint32_t> curveKeys(const Mesh& mesh, const std::vector<ElementId>& elements) {
  const auto box = bounds(mesh);
  const double extent = std::max((box[1] - box[0]).maxCoeff(), std::numeric_limits<double>::min());
  const double scale = ((1U << keyBits) - 1) / extent;
  std::vector<std::uint32_t> keys(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double* at = mesh.rest.data() + std::size_t{elements[i]} * mesh.space_dimension;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      keys[i] |= spread(std::uint32_t((at[k] - box[0][mesh.axes[k]]) * scale)) << k;
    }
  }
  return keys;
}

/// Sorts by the keys, ten bits at a time from the lowest.
void sortByKeys(std::vector<ElementId>& elements, std::vector<std::uint32_t> keys) {
  for (unsigned shift = 0; shift < 3 * keyBits; shift += keyBits) {
    const Groups order = grouped(1U << keyBits, keys.size(),
                                 [&](std::uint32_t i) { return keys[i] >> shift & ((1U << keyBits) - 1); });
    std::vector<ElementId> sorted(elements.size());
    std::vector<std::uint32_t> sortedKeys(keys.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      sorted[i] = elements[order.items[i]];
      sortedKeys[i] = keys[order.items[i]];
    }
    elements.swap(sorted);
    keys.swap(sortedKeys);
  }
}

bool isCut(const Mesh& mesh, const Cuts& cuts, ElementId a, ElementId b) {
  const auto link = find_link(mesh, a, b);
  return link && cuts.is_cut(*link);
}

/// For each cell, what `numbersOf` names for it, other than itself and once each.
template <class NumbersOf>
Groups distinct(std::size_t cells, std::size_t numbers, NumbersOf numbersOf) {
  Groups result;
  std::vector<std::uint32_t> seenBy(numbers, MeshLevel::none);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    numbersOf(cell, [&](std::uint32_t number) {
      if (seenBy[number] != cell) {
        seenBy[number] = cell;
        result.items.push_back(number);
      }
    });
    result.close();
  }
  return result;
}

}  // namespace

bool MeshLevel::isUncut(std::uint32_t link, const Cuts& cuts) const {
  if (step == 1 || cuts.count() == 0) {
    return !cuts.is_cut(link);
  }
  const auto path = paths[link];
  return std::none_of(path.begin(), path.end(), [&](LinkId one) { return cuts.is_cut(one); });
}

bool MeshLevel::isWhole(std::uint32_t face, const Cuts& cuts) const {
  if (step > 1) {
    return std::all_of(faceSides[face].begin(), faceSides[face].end(),
                       [&](std::uint32_t side) { return side == none || isUncut(side, cuts); });
  }
  const auto& [a, b, c] = faces[face];
  // Most corners touch no cut: that is seen without looking for links.
  return !(cuts.touches(a) || cuts.touches(b) || cuts.touches(c)) ||
         !(isCut(*mesh, cuts, a, b) || isCut(*mesh, cuts, b, c) || isCut(*mesh, cuts, c, a));
}

void makeCells(MeshLevel& level) {
  sortByKeys(level.elements, curveKeys(*level.mesh, level.elements));
  const std::size_t cells = (level.elements.size() + MeshLevel::cellElements - 1) / MeshLevel::cellElements;
  std::vector<std::uint32_t> cellOf(level.mesh->element_count());
  for (std::size_t i = 0; i < level.elements.size(); ++i) {
    cellOf[level.elements[i]] = std::uint32_t(i / MeshLevel::cellElements);
  }
  level.cellLinks = grouped(cells, level.links.size(), [&](auto i) { return cellOf[level.links[i][0]]; });
  level.cellFaces = grouped(cells, level.faces.size(), [&](auto i) { return cellOf[level.faces[i][0]]; });
  level.cellsLinked = distinct(cells, cells, [&](std::uint32_t cell, auto add) {
    for (const std::uint32_t link : level.cellLinks[cell]) {
      add(cellOf[level.links[link][1]]);
    }
    for (const std::uint32_t face : level.cellFaces[cell]) {
      add(cellOf[level.faces[face][1]]);
      add(cellOf[level.faces[face][2]]);
    }
  });
  const std::size_t blocks = level.mesh->element_count() / Frame::block_elements + 1;
  level.cellBlocks = distinct(cells, blocks, [&](std::uint32_t cell, auto add) {
    for (const ElementId e : level.cell(cell)) {
      add(e / Frame::block_elements);
    }
  });
}

MeshLevelPointer wholeLevel(const MeshPointer& mesh) {
  auto level = std::make_shared<MeshLevel>();
  level->mesh = mesh;
  level->links = mesh->links;
  level->faces = mesh->triangles;
  level->elements.resize(mesh->element_count());
  std::iota(level->elements.begin(), level->elements.end(), ElementId{0});
  makeCells(*level);
  return level;
}

}  // namespace chainmail
