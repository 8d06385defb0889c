#include "drawing/coarse_level.h"

#include <algorithm>

namespace chainmail {
namespace {

/// 0, step, 2 step, …, and the last.
std::vector<ElementId> everyStepth(ElementId size, unsigned step) {
  std::vector<ElementId> rows;
  for (ElementId i = 0; i + 1 < size; i += step) {
    rows.push_back(i);
  }
  rows.push_back(size - 1);
  return rows;
}

/// Adds a coarse link if it has a path all the way.
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

/// The faces between elements that stand for different corners; the links must be in order of their first elements.
template <class StandIn>
void addFaces(MeshLevel& level, std::span<const MeshLevel::Face> finer, StandIn standIn) {
  for (const auto& [a, b, c] : finer) {
    MeshLevel::Face face{standIn(a), standIn(b), standIn(c)};
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
  makeCells(*level);
  return level;
}

/// Who stands for each element of a level, and by which of its links.
struct StandIns {
  std::vector<ElementId> of;
  std::vector<std::uint32_t> by;  // none for those who stand for themselves
};

/// A link of a level seen from an element: number, other end.
struct Rows {
  explicit Rows(const MeshLevel& level) : links(level.links) {
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

StandIns chooseStandIns(const MeshLevel& finer, const Rows& rows) {
  StandIns result;
  result.of.assign(finer.mesh->element_count(), MeshLevel::none);
  result.by.assign(finer.mesh->element_count(), MeshLevel::none);
  for (const ElementId e : finer.elements) {
    if (result.of[e] == MeshLevel::none) {
      result.of[e] = e;
      rows.visit(e, [&](std::uint32_t link, ElementId other) {
        if (result.of[other] == MeshLevel::none) {
          result.of[other] = e;
          result.by[other] = link;
        }
      });
    }
  }
  return result;
}

/// From an element that stays to one of greater id that stays: over a link between those they stand for.
struct Way {
  ElementId to;
  std::uint32_t link, length;  // in links of the level
};

/// Those that begin at one element; of two with the same end that of fewest links is kept. `wayTo` says where in
/// `ways` each end is.
void findWays(ElementId member, const Rows& rows, const StandIns& standIn, std::vector<Way>& ways,
              std::vector<std::uint32_t>& wayTo) {
  const ElementId from = standIn.of[member];
  rows.visit(member, [&](std::uint32_t link, ElementId other) {
    const ElementId to = standIn.of[other];
    if (to <= from) {
      return;
    }
    const std::uint32_t length = 1U + (member != from ? 1U : 0U) + (other != to ? 1U : 0U);
    if (wayTo[to] == MeshLevel::none) {
      wayTo[to] = std::uint32_t(ways.size());
      ways.push_back({to, link, length});
    } else if (length < ways[wayTo[to]].length) {
      ways[wayTo[to]] = {to, link, length};
    }
  });
}

/// A coarse link, and all links of the mesh that it stands for.
void addWay(MeshLevel& level, const MeshLevel& finer, const StandIns& standIn, ElementId from, const Way& way) {
  auto& path = level.paths.items;
  const auto add = [&](std::uint32_t link) {
    if (finer.step == 1) {
      path.push_back(link);
    } else {
      path.insert(path.end(), finer.paths[link].begin(), finer.paths[link].end());
    }
  };
  add(way.link);
  for (const ElementId end : finer.links[way.link]) {
    if (standIn.by[end] != MeshLevel::none) {
      add(standIn.by[end]);
    }
  }
  level.paths.close();
  level.coarseLinks.push_back({from, way.to});
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
  const Rows rows(finer);
  const StandIns standIn = chooseStandIns(finer, rows);
  const Groups members = grouped(finer.mesh->element_count(), finer.elements.size(),
                                 [&](std::uint32_t i) { return standIn.of[finer.elements[i]]; });
  std::vector<Way> ways;
  std::vector<std::uint32_t> wayTo(finer.mesh->element_count(), MeshLevel::none);
  for (ElementId e = 0; e < finer.mesh->element_count(); ++e) {
    if (standIn.of[e] != e) {
      continue;
    }
    level->elements.push_back(e);
    ways.clear();
    for (const std::uint32_t member : members[e]) {
      findWays(finer.elements[member], rows, standIn, ways, wayTo);
    }
    for (const Way& way : ways) {
      wayTo[way.to] = MeshLevel::none;
      addWay(*level, finer, standIn, e, way);
    }
  }
  addFaces(*level, finer.faces, [&](ElementId e) { return standIn.of[e]; });
  return finished(level);
}

}  // namespace chainmail
