#include "drawing/mesh_level.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "mesh/cells.h"
#include "simulate/frame.h"

namespace chainmail {
namespace {

constexpr std::size_t clusterElements = 256;  // approximately
constexpr unsigned keyBits = 10;              // per axis

/// Returns ten bits with two zero bits between neighbours.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

/// Returns the positions of the elements along a Z-order curve (Morton 1966) through their rest positions.
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

/// Sorts the elements by their keys with a radix sort: ten bits per pass, lowest bits first.
std::vector<ElementId> sortedAlongCurve(const Mesh& mesh, std::vector<ElementId> elements) {
  auto keys = curveKeys(mesh, elements);
  for (unsigned shift = 0; shift < 3 * keyBits; shift += keyBits) {
    const Groups order =
        grouped(1U << keyBits, keys.size(), [&](std::uint32_t i) { return keys[i] >> shift & ((1U << keyBits) - 1); });
    std::vector<ElementId> sorted(elements.size());
    std::vector<std::uint32_t> sortedKeys(keys.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      sorted[i] = elements[order.items[i]];
      sortedKeys[i] = keys[order.items[i]];
    }
    elements.swap(sorted);
    keys.swap(sortedKeys);
  }
  return elements;
}

/// The clusters of a lattice: bricks with about `clusterElements` elements each.
struct Bricks {
  Bricks(const Mesh& mesh, unsigned step) : size(mesh.lattice->size) {
    const auto axes = std::count_if(size.begin(), size.end(), [](auto one) { return one > 1; });
    rows = step * std::uint32_t(axes == 3 ? 6 : axes == 2 ? 16 : clusterElements);
    for (int k = 0; k < 3; ++k) {
      count[k] = (size[k] + rows - 1) / rows;
    }
  }
  std::uint32_t of(ElementId e) const {
    const ElementId x = e % size[0] / rows, y = e / size[0] % size[1] / rows, z = e / size[0] / size[1] / rows;
    return x + count[0] * (y + count[1] * z);
  }
  std::array<std::uint32_t, 3> size, count{};
  std::uint32_t rows = 1;
};

Groups clustersOf(const MeshLevel& level) {
  if (level.mesh->lattice) {
    const Bricks bricks(*level.mesh, level.step);
    Groups clusters = grouped(std::size_t{bricks.count[0]} * bricks.count[1] * bricks.count[2], level.elements.size(),
                              [&](std::uint32_t i) { return bricks.of(level.elements[i]); });
    std::ranges::transform(clusters.items, clusters.items.begin(), [&](std::uint32_t i) { return level.elements[i]; });
    return clusters;
  }
  Groups clusters;
  clusters.items = sortedAlongCurve(*level.mesh, level.elements);
  for (std::size_t end = clusterElements; end < clusters.items.size(); end += clusterElements) {
    clusters.first.push_back(std::uint32_t(end));
  }
  clusters.close();
  return clusters;
}

/// Finds the clusters that the links and faces of each cluster lead to, and sorts its links by these clusters.
void findReached(MeshLevel& level, const std::vector<std::uint32_t>& clusterOf) {
  std::vector<std::uint32_t> slotOf(level.clusterCount()), seenBy(level.clusterCount(), MeshLevel::none), ends, sorted;
  for (std::uint32_t cluster = 0; cluster < level.clusterCount(); ++cluster) {
    const auto add = [&](ElementId element) {
      const std::uint32_t other = clusterOf[element];
      if (seenBy[other] != cluster) {
        seenBy[other] = cluster;
        slotOf[other] = std::uint32_t(ends.size());
        level.reached.items.push_back(other);
        ends.push_back(0);
      }
      return slotOf[other];
    };
    const auto links = level.clusterLinks[cluster];
    ends.clear();
    for (const std::uint32_t link : links) {
      ++ends[add(level.links[link][1])];
    }
    for (const std::uint32_t face : level.clusterFaces[cluster]) {
      add(level.faces[face][1]);
      add(level.faces[face][2]);
    }
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0U);
    const std::uint32_t first = level.clusterLinks.first[cluster];
    std::ranges::transform(ends, std::back_inserter(level.reachedLinks), [first](auto end) { return first + end; });
    sorted.resize(links.size());
    for (const std::uint32_t link : links) {
      sorted[ends[slotOf[clusterOf[level.links[link][1]]]]++] = link;
    }
    std::ranges::copy(sorted, level.clusterLinks.items.begin() + first);
    level.reached.close();
  }
  level.reachedLinks.push_back(std::uint32_t(level.links.size()));
}

/// Returns, for each cluster, the blocks of Frame::changed that contain its elements.
Groups blocksOf(const MeshLevel& level) {
  Groups result;
  std::vector<std::uint32_t> seenBy(level.mesh->element_count() / Frame::block_elements + 1, MeshLevel::none);
  for (std::uint32_t cluster = 0; cluster < level.clusterCount(); ++cluster) {
    for (const ElementId e : level.clusters[cluster]) {
      if (std::uint32_t& seen = seenBy[e / Frame::block_elements]; seen != cluster) {
        seen = cluster;
        result.items.push_back(e / Frame::block_elements);
      }
    }
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
  return isWholeFace(*mesh, cuts, faces[face]);
}

bool isWholeFace(const Mesh& mesh, const Cuts& cuts, const MeshLevel::Face& face) {
  const auto& [a, b, c] = face;
  return !is_cut_between(mesh, cuts, a, b) && !is_cut_between(mesh, cuts, b, c) && !is_cut_between(mesh, cuts, c, a);
}

void makeClusters(MeshLevel& level) {
  level.clusters = clustersOf(level);
  std::vector<std::uint32_t> clusterOf(level.mesh->element_count());
  for (std::uint32_t cluster = 0; cluster < level.clusterCount(); ++cluster) {
    for (const ElementId e : level.clusters[cluster]) {
      clusterOf[e] = cluster;
    }
  }
  level.clusterLinks =
      grouped(level.clusterCount(), level.links.size(), [&](auto i) { return clusterOf[level.links[i][0]]; });
  level.clusterFaces =
      grouped(level.clusterCount(), level.faces.size(), [&](auto i) { return clusterOf[level.faces[i][0]]; });
  findReached(level, clusterOf);
  level.clusterBlocks = blocksOf(level);
}

MeshLevelPointer wholeLevel(const MeshPointer& mesh) {
  auto level = std::make_shared<MeshLevel>();
  level->mesh = mesh;
  level->links = mesh->links;
  level->faces = mesh->triangles;
  level->elements.resize(mesh->element_count());
  std::iota(level->elements.begin(), level->elements.end(), ElementId{0});
  makeClusters(*level);
  return level;
}

}  // namespace chainmail
