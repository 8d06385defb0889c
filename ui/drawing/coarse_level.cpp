#include "drawing/coarse_level.h"

#include <algorithm>

namespace chainmail {
namespace {

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
