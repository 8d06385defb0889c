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

/// Returns the rows 0, step, 2 · step, …, and the last row.
std::vector<ElementId> everyStepth(ElementId size, unsigned step) {
  std::vector<ElementId> rows;
  for (ElementId i = 0; i + 1 < size; i += step) {
    rows.push_back(i);
  }
  rows.push_back(size - 1);
  return rows;
}

/// Adds a coarse link that replaces `steps` links in a row, if all of them exist.
void addRow(MeshLevel& level, ElementId from, ElementId stride, ElementId steps) {
  const auto before = level.paths.items.size();
  for (ElementId i = 0; i < steps; ++i) {
    const auto link = find_link(*level.mesh, from + i * stride, from + (i + 1) * stride);
    if (!link) {
      level.paths.items.resize(before);
      return;
    }
    level.paths.items.push_back(*link);
  }
  level.paths.close();
  level.coarseLinks.push_back({from, from + steps * stride});
}

/// Adds a coarse face for each finer face whose corners have three different representatives. Coarse links must be
/// sorted by first element.
template <class Representative>
void addFaces(MeshLevel& level, std::span<const MeshLevel::Face> finer, Representative representative) {
  for (const auto& [a, b, c] : finer) {
    MeshLevel::Face face{representative(a), representative(b), representative(c)};
    std::sort(face.begin(), face.end());
    if (face[0] != face[1] && face[1] != face[2]) {
      level.coarseFaces.push_back(face);
    }
  }
  std::sort(level.coarseFaces.begin(), level.coarseFaces.end());
  level.coarseFaces.erase(std::unique(level.coarseFaces.begin(), level.coarseFaces.end()), level.coarseFaces.end());
  const auto between = [&](ElementId a, ElementId b) {
    const auto& links = level.coarseLinks;
    auto at = std::lower_bound(links.begin(), links.end(), MeshLevel::Link{a, 0});
    while (at != links.end() && (*at)[0] == a && (*at)[1] != b) {
      ++at;
    }
    const bool found = at != links.end() && *at == MeshLevel::Link{a, b};
    return found ? std::uint32_t(at - links.begin()) : MeshLevel::none;
  };
  for (const auto& [a, b, c] : level.coarseFaces) {
    level.faceSides.push_back({between(a, b), between(b, c), between(a, c)});
  }
}

MeshLevelPointer finished(std::shared_ptr<MeshLevel> level) {
  level->links = level->coarseLinks;
  level->faces = level->coarseFaces;
  makeClusters(*level);
  return level;
}

/// The representative of each element of a level, and the link to it.
struct Representatives {
  std::vector<ElementId> of;
  std::vector<std::uint32_t> by;  // none for elements that represent themselves
};

/// The links of each element of a level. visit() passes the number and the other end of each link.
struct LinksByElement {
  explicit LinksByElement(const MeshLevel& level) : links(level.links) {
    const std::size_t count = level.links.size();
    entries = grouped(level.mesh->element_count(), 2 * count, [&](std::uint32_t i) { return links[i / 2][i % 2]; });
  }
  template <class Visit>
  void visit(ElementId e, Visit visit) const {
    for (const std::uint32_t entry : entries[e]) {
      visit(entry / 2, links[entry / 2][1 - entry % 2]);
    }
  }
  std::span<const MeshLevel::Link> links;
  Groups entries;
};

Representatives chooseRepresentatives(const MeshLevel& finer, const LinksByElement& linksOf) {
  Representatives result;
  result.of.assign(finer.mesh->element_count(), MeshLevel::none);
  result.by.assign(finer.mesh->element_count(), MeshLevel::none);
  for (const ElementId e : finer.elements) {
    if (result.of[e] == MeshLevel::none) {
      result.of[e] = e;
      linksOf.visit(e, [&](std::uint32_t link, ElementId other) {
        if (result.of[other] == MeshLevel::none) {
          result.of[other] = e;
          result.by[other] = link;
        }
      });
    }
  }
  return result;
}

/// A path from a representative to another one with a greater id, over a link between elements that they represent.
struct Path {
  ElementId to;
  std::uint32_t link;    // of the finer level
  std::uint32_t length;  // in links of the finer level
};

/// Finds the paths over the links of one element, and keeps the shortest path to each end. `pathTo` contains the index
/// in `paths` for each end.
void findPaths(ElementId member, const LinksByElement& linksOf, const Representatives& representative,
               std::vector<Path>& paths, std::vector<std::uint32_t>& pathTo) {
  const ElementId from = representative.of[member];
  linksOf.visit(member, [&](std::uint32_t link, ElementId other) {
    const ElementId to = representative.of[other];
    if (to <= from) {
      return;
    }
    const std::uint32_t length = 1U + (member != from ? 1U : 0U) + (other != to ? 1U : 0U);
    if (pathTo[to] == MeshLevel::none) {
      pathTo[to] = std::uint32_t(paths.size());
      paths.push_back({to, link, length});
    } else if (length < paths[pathTo[to]].length) {
      paths[pathTo[to]] = {to, link, length};
    }
  });
}

/// Adds a coarse link and all links of the mesh that it replaces.
void addPath(MeshLevel& level, const MeshLevel& finer, const Representatives& representative, ElementId from,
             const Path& path) {
  auto& replaced = level.paths.items;
  const auto add = [&](std::uint32_t link) {
    if (finer.step == 1) {
      replaced.push_back(link);
    } else {
      replaced.insert(replaced.end(), finer.paths[link].begin(), finer.paths[link].end());
    }
  };
  add(path.link);
  for (const ElementId end : finer.links[path.link]) {
    if (representative.by[end] != MeshLevel::none) {
      add(representative.by[end]);
    }
  }
  level.paths.close();
  level.coarseLinks.push_back({from, path.to});
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

MeshLevelPointer coarseLattice(const MeshPointer& mesh, unsigned step) {
  auto level = std::make_shared<MeshLevel>();
  level->mesh = mesh;
  level->step = step;
  const auto& size = mesh->lattice->size;
  const std::array<ElementId, 3> stride{1, size[0], size[0] * size[1]};
  for (const ElementId z : everyStepth(size[2], step)) {
    for (const ElementId y : everyStepth(size[1], step)) {
      for (const ElementId x : everyStepth(size[0], step)) {
        const std::array<ElementId, 3> at{x, y, z};
        const ElementId from = x + y * stride[1] + z * stride[2];
        level->elements.push_back(from);
        for (int k = 0; k < 3; ++k) {
          if (const ElementId steps = std::min<ElementId>(step, size[k] - 1 - at[k]); steps > 0) {
            addRow(*level, from, stride[k], steps);
          }
        }
      }
    }
  }
  addFaces(*level, mesh->triangles, [&](ElementId e) {
    const auto row = [step](ElementId i, ElementId end) { return i + 1 == end ? i : i - i % step; };
    return row(e % size[0], size[0]) + row(e / size[0] % size[1], size[1]) * stride[1] +
           row(e / stride[2], size[2]) * stride[2];
  });
  return finished(level);
}

MeshLevelPointer coarser(const MeshLevel& finer) {
  auto level = std::make_shared<MeshLevel>();
  level->mesh = finer.mesh;
  level->step = 2 * finer.step;
  const LinksByElement linksOf(finer);
  const Representatives representative = chooseRepresentatives(finer, linksOf);
  const Groups members = grouped(finer.mesh->element_count(), finer.elements.size(),
                                 [&](std::uint32_t i) { return representative.of[finer.elements[i]]; });
  std::vector<Path> paths;
  std::vector<std::uint32_t> pathTo(finer.mesh->element_count(), MeshLevel::none);
  for (ElementId e = 0; e < finer.mesh->element_count(); ++e) {
    if (representative.of[e] != e) {
      continue;
    }
    level->elements.push_back(e);
    paths.clear();
    for (const std::uint32_t member : members[e]) {
      findPaths(finer.elements[member], linksOf, representative, paths, pathTo);
    }
    for (const Path& path : paths) {
      pathTo[path.to] = MeshLevel::none;
      addPath(*level, finer, representative, e, path);
    }
  }
  addFaces(*level, finer.faces, [&](ElementId e) { return representative.of[e]; });
  return finished(level);
}

}  // namespace chainmail
