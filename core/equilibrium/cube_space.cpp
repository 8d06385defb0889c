#include "equilibrium/cube_space.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/cells.h"
#include "mesh/disjoint_sets.h"

namespace chainmail {
namespace {

// A cube is full if the object fills this share of it. Tetrahedra count where their centres are, which rounds.
constexpr double full = 0.75;

std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}
std::uint64_t morton(const CubeSpace::Place& at) {
  return spread(std::uint64_t(at[0])) | spread(std::uint64_t(at[1])) << 1 | spread(std::uint64_t(at[2])) << 2;
}

std::size_t index_of(const CubeSpace::Place& at, const CubeSpace::Place& size) {
  return (std::size_t(at[2]) * std::size_t(size[1]) + std::size_t(at[1])) * std::size_t(size[0]) + std::size_t(at[0]);
}
std::size_t count_of(const CubeSpace::Place& size) {
  return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]);
}

/// Returns the path of the coarser cube's tetrahedron that contains that of a path of the cube in this octant.
int containing_path(int octant, int path) {
  const auto& p = CubeSpace::paths[std::size_t(path)];
  std::array<int, 3> inside{};  // coordinates of a point inside, in eighths of the coarser cube
  for (std::size_t i = 0; i < 3; ++i) {
    inside[p[i]] = 4 * (octant >> p[i] & 1) + 3 - int(i);
  }
  std::array<std::uint8_t, 3> order{0, 1, 2};
  std::ranges::sort(order, [&](auto a, auto b) { return inside[a] > inside[b]; });
  return int(std::ranges::find(CubeSpace::paths, order) - CubeSpace::paths.begin());
}

}  // namespace

std::uint32_t CubeSpace::Level::find(const Place& at) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] < 0 || at[k] >= size[k]) {
      return none;
    }
  }
  return cube_at[index_of(at, size)];
}

CubeSpace::CubeSpace(MeshPointer mesh, const Cuts& cuts, const Progress& progress) : mesh_(std::move(mesh)) {
  find_tetrahedra();
  find_unit(progress.part(0, 0.1));
  sort_tetrahedra(cuts, progress.part(0.1, 0.3));
  std::vector<Pair> pairs;
  {
    const std::vector<std::uint32_t> part_of = find_parts(progress.part(0.3, 0.6));
    pairs = find_pairs(part_of);
    find_volumes(part_of, progress.part(0.6, 0.9));
  }
  sort_elements();
  find_reach();
  join_corners(levels_.back(), pairs);
  find_full(levels_.back());
  while (count_of(levels_.back().size) > 1) {
    make_coarser(pairs);
  }
}

std::span<const CubeSpace::Tetrahedron> CubeSpace::tetrahedra() const {
  return own_tetrahedra_.empty() ? std::span(mesh_->tetrahedra) : std::span(own_tetrahedra_);
}

/// Hexahedra, and the cubes of a lattice without cells, are divided.
void CubeSpace::find_tetrahedra() {
  const auto& given = mesh_->hexahedra;
  if (!mesh_->has_cells() && mesh_->lattice) {
    for_each_cube(*mesh_->lattice, [this](const auto& cube) { own_hexahedra_.push_back(cube); });
  }
  const auto& hexahedra = own_hexahedra_.empty() ? given : own_hexahedra_;
  if (!hexahedra.empty()) {
    own_tetrahedra_ = mesh_->tetrahedra;
    for (const auto& cell : hexahedra) {
      for_each_tetrahedron(*mesh_, cell, [&](const Tetrahedron& one) { own_tetrahedra_.push_back(one); });
    }
  }
}

bool CubeSpace::is_gone(std::uint32_t tetrahedron, const Cuts& cuts) const {
  if (tetrahedron < mesh_->tetrahedra.size()) {
    return !is_whole(*mesh_, cuts, mesh_->tetrahedra[tetrahedron]);
  }
  const auto& hexahedra = own_hexahedra_.empty() ? mesh_->hexahedra : own_hexahedra_;
  return !is_whole(*mesh_, cuts, hexahedra[(tetrahedron - mesh_->tetrahedra.size()) / 6]);
}

double CubeSpace::volume_of(const std::array<Point, 4>& c) {
  return std::abs((c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0])) / 6;
}

/// The unit is the spacing of elements, or a quarter of the longest cell; more where cells are so far apart that there
/// would be more places than cells.
void CubeSpace::find_unit(const Progress& progress) {
  Point low = Point::Constant(INFINITY), high = -low;
  double longest = 0, volume = 0;
  const auto tetrahedra = this->tetrahedra();
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    progress.report(t, tetrahedra.size());
    const auto corners = points_of(t);
    volume += volume_of(corners);
    const Point least = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3]));
    const Point most = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3]));
    low = low.cwiseMin(least);
    high = high.cwiseMax(most);
    longest = std::max(longest, (most - least).maxCoeff());
  }
  const double spacing = mesh_->lattice ? mesh_->lattice->spacing : std::cbrt(volume / mesh_->element_count());
  unit_ = std::max(spacing, longest / 4);
  if (!(unit_ > 0 && std::isfinite(unit_))) {  // all elements at one point
    unit_ = 1;
  }
  const auto places = [&](int k) { return std::max(1.0, std::ceil((high[k] - low[k]) / unit_ / 2 - 1e-9)); };
  while (places(0) * places(1) * places(2) > double(tetrahedra.size())) {
    unit_ *= 2;
  }
  per_unit_ = 1 / unit_;
  origin_ = low;
  levels_.resize(2);
  Level& first = levels_[1];
  first.width = 2;
  extent_ = (high - low).maxCoeff() / unit_;
  for (int k = 0; k < 3; ++k) {
    first.size[std::size_t(k)] = int(places(k));
  }
}

CubeSpace::Place CubeSpace::place_of(const Point& point) const {
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    place[k] = int(std::clamp(std::floor(point[Eigen::Index(k)] / 2 + 1e-12), 0.0, levels_[1].size[k] - 1.0));
  }
  return place;
}

/// Makes the cubes of level 1 that have tetrahedra, and sorts these by cube.
void CubeSpace::sort_tetrahedra(const Cuts& cuts, const Progress& progress) {
  Level& level = levels_[1];
  const std::size_t count = tetrahedra().size();
  std::vector<std::uint32_t> cube_of(count, none);
  level.cube_at.assign(count_of(level.size), none);
  for (std::uint32_t t = 0; t < count; ++t) {
    progress.report(t, count);
    if (cuts.count() > 0 && is_gone(t, cuts)) {
      continue;
    }
    const auto corners = points_of(t);
    const Place at = place_of((corners[0] + corners[1] + corners[2] + corners[3]) / 4);
    std::uint32_t& cube = level.cube_at[index_of(at, level.size)];
    if (cube == none) {
      cube = std::uint32_t(level.cubes.size());
      level.cubes.push_back({at});
    }
    cube_of[t] = cube;
    ++level.cubes[cube].tetrahedron;
  }
  if (level.cubes.empty() && cuts.count() > 0) {
    return sort_tetrahedra({}, progress);
  }
  std::vector<std::uint32_t> order(level.cubes.size()), rank(level.cubes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return morton(level.cubes[i].at); });
  std::vector<Cube> cubes;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    cubes.push_back(level.cubes[order[i]]);
    const std::uint32_t own = std::exchange(cubes.back().tetrahedron, first);
    first += own;
    level.cube_at[index_of(cubes.back().at, level.size)] = i;
  }
  cubes.push_back({.tetrahedron = first});
  level.cubes = std::move(cubes);
  sorted_tetrahedra_.resize(first);
  std::vector<std::uint32_t> next(order.size());
  std::ranges::transform(std::span(level.cubes).first(order.size()), next.begin(), &Cube::tetrahedron);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (cube_of[t] != none) {
      sorted_tetrahedra_[next[rank[cube_of[t]]]++] = t;
    }
  }
}

/// Finds what is connected in each cube. Returns the part of each tetrahedron, in sorted order.
std::vector<std::uint32_t> CubeSpace::find_parts(const Progress& progress) {
  Level& level = levels_[1];
  std::vector<std::uint32_t> part_of(sorted_tetrahedra_.size(), none);
  std::vector<std::uint32_t> seen(mesh_->element_count(), none);  // the last tetrahedron with this element
  for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
    progress.report(c, level.cube_count());
    Cube& cube = level.cubes[c];
    const std::uint32_t begin = cube.tetrahedron, end = level.cubes[c + 1].tetrahedron;
    DisjointSets sets(end - begin);
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const ElementId e : tetrahedra()[sorted_tetrahedra_[i]]) {
        if (seen[e] != none && seen[e] >= begin) {
          sets.unite(seen[e] - begin, i - begin);
        }
        seen[e] = i;
      }
    }
    cube.part = std::uint32_t(level.parts.size());
    for (std::uint32_t i = begin; i < end; ++i) {
      if (const std::size_t root = sets.of(i - begin) + begin; root != i) {
        part_of[i] = part_of[root];
      } else {
        part_of[i] = std::uint32_t(level.parts.size());
        level.parts.push_back({.cube = c});
      }
    }
  }
  level.cubes.back().part = std::uint32_t(level.parts.size());
  return part_of;
}

/// Finds the parts that share elements, and the home of each element.
std::vector<CubeSpace::Pair> CubeSpace::find_pairs(const std::vector<std::uint32_t>& part_of) {
  const Level& level = levels_[1];
  home_.assign(mesh_->element_count(), none);
  std::vector<std::uint32_t> first(mesh_->element_count(), none), known(level.parts.size(), 0);
  std::vector<Pair> pairs;
  const auto is_alone = [&](std::uint32_t cube) { return level.cubes[cube + 1].part == level.cubes[cube].part + 1; };
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    const std::uint32_t part = part_of[i];
    const std::uint32_t cube = level.parts[part].cube;
    for (const ElementId e : tetrahedra()[sorted_tetrahedra_[i]]) {
      const std::uint32_t other = first[e];
      if (other == part) {
        continue;
      }
      if (home_[e] == none || level.parts[home_[e]].cube != cube) {
        const bool is_own = level.cube_at[index_of(place_of(point(e)), level.size)] == cube;
        home_[e] = home_[e] == none || is_own ? part : home_[e];
      }
      if (other == none) {
        first[e] = part;
        continue;
      }
      const Place &here = level.cubes[cube].at, &there = level.cubes[level.parts[other].cube].at;
      int direction = 0;
      bool is_near = true;
      for (std::size_t k = 0; k < 3; ++k) {
        is_near = is_near && std::abs(there[k] - here[k]) <= 1;
        direction = 3 * direction + there[k] - here[k] + 1;
      }
      const bool is_known =
          is_near && (known[part] >> direction & 1) != 0 && is_alone(cube) && is_alone(level.parts[other].cube);
      if (is_near && !is_known) {
        known[part] |= 1U << direction;
        pairs.push_back({other, part});
      }
    }
  }
  return pairs;
}

void CubeSpace::find_volumes(const std::vector<std::uint32_t>& part_of, const Progress& progress) {
  Level& level = levels_[1];
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    progress.report(i, part_of.size());
    Part& part = level.parts[part_of[i]];
    for_each_share(sorted_tetrahedra_[i], level.cubes[part.cube],
                   [&](int path, double volume) { part.volume[std::size_t(path)] += float(volume); });
  }
}

/// Sorts the elements by their home, and those on the surface. Inside, the cells around an element close up: by Euler's
/// formula, twice its neighbours are four more than its tetrahedra.
void CubeSpace::sort_elements() {
  Level& level = levels_[1];
  std::vector<std::uint16_t> around(mesh_->element_count(), 0);
  for (const std::uint32_t t : sorted_tetrahedra_) {
    std::ranges::for_each(tetrahedra()[t], [&](ElementId e) { ++around[e]; });
  }
  const auto is_skin = [&](ElementId e) {
    return !own_tetrahedra_.empty() || 2 * mesh_->neighbours_of(e).size() != around[e] + std::size_t{4};
  };
  const auto sort = [&](std::uint32_t Cube::*begin, std::vector<ElementId>& sorted, const auto& counts) {
    std::vector<std::uint32_t> next(level.cube_count(), 0);
    for (ElementId e = 0; e < home_.size(); ++e) {
      if (home_[e] != none && counts(e)) {
        ++next[level.parts[home_[e]].cube];
      }
    }
    std::uint32_t first = 0;
    for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
      level.cubes[c].*begin = first;
      first += std::exchange(next[c], first);
    }
    level.cubes.back().*begin = first;
    sorted.resize(first);
    for (ElementId e = 0; e < home_.size(); ++e) {
      if (home_[e] != none && counts(e)) {
        sorted[next[level.parts[home_[e]].cube]++] = e;
      }
    }
  };
  sort(&Cube::element, sorted_elements_, [](ElementId) { return true; });
  sort(&Cube::skin, sorted_skin_, is_skin);
  for (const ElementId e : sorted_skin_) {
    rest_of_skin_.push_back(mesh_->rest_position(e));
  }
}

void CubeSpace::find_reach() {
  const Level& level = levels_[1];
  for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
    for (std::uint32_t i = level.cubes[c].tetrahedron; i < level.cubes[c + 1].tetrahedron; ++i) {
      Place low = level.cubes[c].at, high = low;
      for (const ElementId e : tetrahedra()[sorted_tetrahedra_[i]]) {
        for (std::size_t k = 0; k < 3 && home_[e] != none; ++k) {
          const std::int32_t at = level.cubes[level.parts[home_[e]].cube].at[k];
          low[k] = std::min(low[k], at);
          high[k] = std::max(high[k], at);
        }
      }
      reach_ = std::max({reach_, high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    }
  }
}

/// Numbers the nodes: the corners that parts share are one.
void CubeSpace::join_corners(Level& level, const std::vector<Pair>& pairs) {
  DisjointSets sets(8 * level.parts.size());
  for (const auto& [one, other] : pairs) {
    const Place &a = level.cubes[level.parts[one].cube].at, &b = level.cubes[level.parts[other].cube].at;
    for (int corner = 0; corner < 8; ++corner) {
      int same = 0;
      bool is_shared = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const int side = (corner >> k & 1) + a[k] - b[k];
        is_shared = is_shared && (side == 0 || side == 1);
        same |= side << k;
      }
      if (is_shared) {
        sets.unite(8 * std::size_t{one} + std::size_t(corner), 8 * std::size_t{other} + std::size_t(same));
      }
    }
  }
  for (std::size_t i = 0; i < 8 * level.parts.size(); ++i) {
    const std::size_t root = sets.of(i);
    std::uint32_t& node = level.parts[i / 8].corner[i % 8];
    if (root == i) {
      node = std::uint32_t(level.parts_around.size());
      level.parts_around.push_back(0);
    } else {
      node = level.parts[root / 8].corner[root % 8];
    }
    ++level.parts_around[node];
  }
}

/// Marks the cubes that are full, or have a full neighbour.
void CubeSpace::find_full(Level& level) {
  level.is_full.assign(level.cube_count(), 0);
  const double least = full * std::pow(level.width, 3);
  for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
    double filled = 0;
    for (std::uint32_t p = level.cubes[c].part; p < level.cubes[c + 1].part; ++p) {
      filled = std::max(filled, double(level.parts[p].all()));
    }
    if (filled < least) {
      continue;
    }
    const Place at = level.cubes[c].at;
    for (int i = 0; i < 27; ++i) {
      const std::uint32_t other = level.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
      if (other != none) {
        level.is_full[other] = 1;
      }
    }
  }
}

/// Makes the cubes that contain those of a level.
CubeSpace::Level CubeSpace::cubes_around(Level& fine) {
  Level coarse;
  coarse.width = 2 * fine.width;
  for (std::size_t k = 0; k < 3; ++k) {
    coarse.size[k] = (fine.size[k] + 1) / 2;
  }
  coarse.cube_at.assign(count_of(coarse.size), none);
  for (std::uint32_t c = 0; c < fine.cube_count(); ++c) {
    Cube& cube = fine.cubes[c];
    const Place at{cube.at[0] / 2, cube.at[1] / 2, cube.at[2] / 2};
    std::uint32_t& parent = coarse.cube_at[index_of(at, coarse.size)];
    if (parent == none) {
      parent = std::uint32_t(coarse.cubes.size());
      coarse.cubes.push_back(cube);
      coarse.cubes.back().at = at;
      coarse.cubes.back().child = c;
    }
    cube.parent = parent;
  }
  coarse.cubes.push_back(fine.cubes.back());
  coarse.cubes.back().child = std::uint32_t(fine.cube_count());
  return coarse;
}

/// Joins the parts of a level that share elements inside the cubes around them.
void CubeSpace::join_parts(Level& fine, Level& coarse, const std::vector<Pair>& pairs) {
  DisjointSets sets(fine.parts.size());
  for (const auto& [one, other] : pairs) {
    if (fine.cubes[fine.parts[one].cube].parent == fine.cubes[fine.parts[other].cube].parent) {
      sets.unite(one, other);
    }
  }
  std::uint32_t last = none;
  for (std::uint32_t p = 0; p < fine.parts.size(); ++p) {
    Part& part = fine.parts[p];
    const std::uint32_t parent = fine.cubes[part.cube].parent;
    for (; last == none || last < parent; ++last, coarse.cubes[last].part = std::uint32_t(coarse.parts.size())) {
    }
    if (const std::size_t root = sets.of(p); root != p) {
      part.parent = fine.parts[root].parent;
    } else {
      part.parent = std::uint32_t(coarse.parts.size());
      coarse.parts.push_back({.cube = parent});
    }
    const Place& at = fine.cubes[part.cube].at;
    const int octant = (at[0] & 1) | (at[1] & 1) << 1 | (at[2] & 1) << 2;
    for (int path = 0; path < 6; ++path) {
      coarse.parts[part.parent].volume[std::size_t(containing_path(octant, path))] += part.volume[std::size_t(path)];
    }
  }
  for (++last; last < coarse.cubes.size(); ++last) {
    coarse.cubes[last].part = std::uint32_t(coarse.parts.size());
  }
}

/// Adds the next coarser level. `pairs` become its.
void CubeSpace::make_coarser(std::vector<Pair>& pairs) {
  Level& fine = levels_.back();
  Level coarse = cubes_around(fine);
  join_parts(fine, coarse, pairs);
  std::erase_if(pairs, [&](Pair& pair) {
    pair = {fine.parts[pair[0]].parent, fine.parts[pair[1]].parent};
    pair = {std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
    return pair[0] == pair[1];
  });
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  join_corners(coarse, pairs);
  find_full(coarse);
  levels_.push_back(std::move(coarse));
}

std::uint32_t CubeSpace::ancestor(std::uint32_t part, int l) const {
  for (int at = 1; at < l; ++at) {
    part = levels_[std::size_t(at)].parts[part].parent;
  }
  return part;
}

}  // namespace chainmail
