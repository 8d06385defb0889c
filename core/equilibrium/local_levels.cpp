#include "equilibrium/local_levels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "elastic/simplices.h"

namespace chainmail {
namespace {

// Of the weights of the Laplacian between elements: obtuse cells have some of the wrong sign.
constexpr float least_share = 0.02F;
// Each of a cube's tetrahedra counts at least this share of its mean, so that no node is without energy.
constexpr float least_filled = 0.02F;
// If there are more weights of the Laplacian than these (16 MB), a cut forgets all of them.
constexpr std::size_t most_weights = std::size_t{1} << 22;
// The coarsest level has a few nodes.
constexpr int rounds_of_coarsest = 6;

/// Finds the gradients of the shape functions of corners 1 to 3. Returns the volume. All are 0 if the tetrahedron is
/// flat.
double shape_of(const std::array<Point, 4>& c, LocalLevels::Shape& gradient) {
  const std::array<Point, 3> edge{c[1] - c[0], c[2] - c[0], c[3] - c[0]};
  const double determinant = edge[0].dot(edge[1].cross(edge[2]));
  if (is_flat(determinant / 6, std::max({edge[0].norm(), edge[1].norm(), edge[2].norm()}), 3)) {
    gradient.fill(Point::Zero());
    return 0;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    gradient[i] = edge[(i + 1) % 3].cross(edge[(i + 2) % 3]) / determinant;
  }
  return std::abs(determinant) / 6;
}

/// Returns −V ∇a·∇b of two corners.
double coupling(const LocalLevels::Shape& g, double volume, std::size_t a, std::size_t b) {
  return -volume * (a > 0 ? g[a - 1] : Point(-g[0] - g[1] - g[2])).dot(g[b - 1]);
}

}  // namespace

LocalLevels::LocalLevels(const CubeSpace& space, const FixedElements& fixed)
    : space_(space),
      fixed_(fixed),
      levels_(std::size_t(space.top()) + 1),
      old_(levels_.size()),
      in_use_(levels_.size()),
      before_(levels_.size()),
      divided_(levels_.size()),
      cubes_(levels_.size()),
      is_fine_(space.mesh().element_count(), 0),
      left_of_(space.level(1).cube_count(), none),
      row_of_(space.mesh().element_count(), none) {
  in_use_[0] = before_[0] = std::vector<std::uint32_t>(space.mesh().element_count(), none);
  for (int l = 1; l <= space.top(); ++l) {
    in_use_[std::size_t(l)] = before_[std::size_t(l)] = std::vector<std::uint32_t>(space.level(l).node_count(), none);
    divided_[std::size_t(l)].assign(space.level(l).cube_count(), 0);
  }
}

void LocalLevels::set_divided(int l, std::uint32_t cube, bool divided) {
  divided_[std::size_t(l)][cube] = divided ? 1 : 0;
  if (l == 1) {
    const auto& cubes = space_.level(1).cubes;
    for (std::uint32_t i = cubes[cube].element; i < cubes[cube + 1].element; ++i) {
      is_fine_[space_.sorted_elements()[i]] = divided ? 1 : 0;
    }
  }
}

LocalLevels::Leaf LocalLevels::leaf_of(ElementId element) const {
  std::uint32_t part = space_.home(element);
  if (part == none || is_fine(element)) {
    return {0, none};
  }
  int l = 1;
  for (; l < top(); ++l) {
    const CubeSpace::Level& level = space_.level(l);
    if (is_divided(l + 1, level.cubes[level.parts[part].cube].parent)) {
      break;
    }
    part = level.parts[part].parent;
  }
  return {l, part};
}

void LocalLevels::Level::clear() {
  const auto clear_all = [](auto&... all) { (all.clear(), ...); };
  clear_all(node, hangs, up, share, next, weight, more, diagonal, keep, around, beside_leaf);
}

void LocalLevels::forget_rows(std::span<const ElementId> elements) {
  std::ranges::for_each(elements, [this](ElementId e) { row_of_[e] = none; });
  if (rows_.size() > most_weights) {  // those of forgotten rows are still among them
    rows_.clear();
    std::ranges::fill(row_of_, none);
  }
}

void LocalLevels::list(const std::vector<std::uint8_t>& is_gone, double modulus) {
  std::swap(levels_, old_);
  std::swap(in_use_, before_);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (const std::uint32_t node : levels_[l].node) {  // those of two changes ago
      in_use_[l][node] = none;
    }
  }
  for (int l = top(); l > 0; --l) {
    list_level(l, modulus);
  }
  find_explicit(is_gone);
  list_elements();
  number_points();
  find_rows(modulus);
  add_batches();
  find_springs();
  find_fixed_points();
}

void LocalLevels::list_level(int l, double modulus) {
  auto& cubes = cubes_[std::size_t(l)];
  cubes.clear();
  const CubeSpace::Level& of = space_.level(l);
  if (l == top()) {
    for (std::uint32_t c = 0; c < of.cube_count(); ++c) {
      cubes.push_back(c);
    }
  } else {
    const CubeSpace::Level& coarser = space_.level(l + 1);
    for (const std::uint32_t c : cubes_[std::size_t(l) + 1]) {
      for (std::uint32_t child = coarser.cubes[c].child; is_divided(l + 1, c) && child < coarser.cubes[c + 1].child;
           ++child) {
        cubes.push_back(child);
      }
    }
  }
  levels_[std::size_t(l)].clear();
  for (const std::uint32_t c : cubes) {
    for (std::uint32_t p = of.cubes[c].part; p < of.cubes[c + 1].part; ++p) {
      add_part(l, p, modulus);
    }
  }
  classify(l, modulus);
}

/// Returns the number of the node at a corner of a part, which is listed if it was not.
std::uint32_t LocalLevels::node_at(int l, const CubeSpace::Part& part, std::size_t corner) {
  std::uint32_t& i = in_use_[std::size_t(l)][part.corner[corner]];
  if (i != none) {
    return i;
  }
  Level& level = levels_[std::size_t(l)];
  i = std::uint32_t(level.node.size());
  level.node.push_back(part.corner[corner]);
  level.next.push_back({i, i, i, i, i, i});
  level.weight.push_back({});
  level.diagonal.push_back(0);
  level.around.push_back(0);
  level.beside_leaf.push_back(0);
  level.up.push_back({});
  level.share.push_back({});
  if (l < top()) {  // between the corners of the coarser cube
    const auto& corners = space_.level(l + 1).parts[part.parent].corner;
    const CubeSpace::Place& at = space_.level(l).cubes[part.cube].at;
    std::size_t low = 0, high = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t offset = std::size_t(at[k] & 1) + (corner >> k & 1);
      low |= (offset / 2) << k;
      high |= ((offset + 1) / 2) << k;
    }
    const auto& use = in_use_[std::size_t(l) + 1];
    level.up[i] = {use[corners[low]], use[corners[high]], 0, 0};
    level.share[i] = {low == high ? 1.0F : 0.5F, low == high ? 0.0F : 0.5F, 0, 0};
  }
  return i;
}

void LocalLevels::add_part(int l, std::uint32_t p, double modulus) {
  Level& level = levels_[std::size_t(l)];
  const CubeSpace::Level& of = space_.level(l);
  const CubeSpace::Part& part = of.parts[p];
  const bool is_leaf = !is_divided(l, part.cube);
  std::array<std::uint32_t, 8> node;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t i = node_at(l, part, corner);
    node[corner] = i;
    ++level.around[i];
    level.beside_leaf[i] |= is_leaf ? 1 : 0;
  }
  const auto unit = float(modulus / (double(of.width) * of.width));
  const float least = least_filled * part.all() / 6;
  for (std::size_t path = 0; path < 6; ++path) {
    const float weight = unit * std::max(least, part.volume[path]);
    const auto corners = CubeSpace::corners_of(int(path));
    for (std::size_t k = 0; k < 3; ++k) {
      add_edge(level, node[corners[k]], node[corners[k + 1]], CubeSpace::paths[path][k], weight);
    }
  }
}

void LocalLevels::add_edge(Level& level, std::uint32_t i, std::uint32_t j, std::size_t axis, float weight) {
  level.diagonal[i] += weight;
  level.diagonal[j] += weight;
  std::uint32_t &from_i = level.next[i][2 * axis + 1], &from_j = level.next[j][2 * axis];
  if ((from_i == i || from_i == j) && (from_j == j || from_j == i)) {
    from_i = j;
    from_j = i;
    level.weight[i][2 * axis + 1] += weight;
    level.weight[j][2 * axis] += weight;
  } else {
    level.more.push_back({i, j, weight});
  }
}

/// Decides which nodes hang and which are fixed.
void LocalLevels::classify(int l, double modulus) {
  Level& level = levels_[std::size_t(l)];
  const auto& around = space_.level(l).parts_around;
  level.hangs.assign(level.size(), 0);
  level.keep.assign(level.size(), 1);
  level.inverse.assign(level.size(), 0);
  for (auto* vector : {&level.r, &level.x, &level.t, &level.y}) {
    vector->resize(level.size());
  }
  for (std::size_t i = 0; i < level.size(); ++i) {
    const std::uint32_t node = level.node[i];
    level.hangs[i] = level.around[i] != around[node] ? 1 : 0;
    level.keep[i] = fixed_.at_node(l, node) != no_element ? 0.0F : 1.0F;
    level.diagonal[i] += float(modulus) * fixed_.spring(l, node);
    if (level.hangs[i] == 0 && level.keep[i] > 0 && level.diagonal[i] > 0) {
      level.inverse[i] = 1 / level.diagonal[i];
    }
  }
}

/// Finds the tetrahedra whose energy is computed one by one: those with a fine element, and those in divided cubes.
void LocalLevels::find_explicit(const std::vector<std::uint8_t>& is_gone) {
  explicit_.clear();
  left_.clear();
  for (const std::uint32_t c : left_cubes_) {
    left_of_[c] = none;
  }
  left_cubes_.clear();
  const CubeSpace::Level& level = space_.level(1);
  const int reach = space_.reach();
  std::vector<std::uint32_t> near;
  for (const std::uint32_t c : cubes_[1]) {
    if (is_divided(1, c)) {
      const CubeSpace::Place& at = level.cubes[c].at;
      for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
          for (int x = -reach; x <= reach; ++x) {
            const std::uint32_t other = level.find({at[0] + x, at[1] + y, at[2] + z});
            if (other != none && left_of_[other] == none) {
              left_of_[other] = 0;
              near.push_back(other);
            }
          }
        }
      }
    }
  }
  std::ranges::sort(near);
  for (const std::uint32_t c : near) {
    left_of_[c] = none;
    scan(c, is_gone);
  }
  gradients_.resize(explicit_.size());
  volumes_.resize(explicit_.size());
  for (std::size_t i = 0; i < explicit_.size(); ++i) {
    volumes_[i] = shape_of(space_.points_of(explicit_[i]), gradients_[i]);
  }
}

void LocalLevels::scan(std::uint32_t c, const std::vector<std::uint8_t>& is_gone) {
  const CubeSpace::Level& level = space_.level(1);
  const CubeSpace::Cube& cube = level.cubes[c];
  const std::uint32_t end = level.cubes[c + 1].tetrahedron;
  const bool is_own = is_divided(1, c);
  const auto is_explicit = [&](std::uint32_t t) {
    const CubeSpace::Tetrahedron& corners = space_.tetrahedra()[t];
    return is_own || is_fine_[corners[0]] != 0 || is_fine_[corners[1]] != 0 || is_fine_[corners[2]] != 0 ||
           is_fine_[corners[3]] != 0;
  };
  const std::size_t before = explicit_.size();
  for (std::uint32_t i = cube.tetrahedron; i < end; ++i) {
    const std::uint32_t t = space_.sorted_tetrahedra()[i];
    if (is_gone[t] == 0 && is_explicit(t)) {
      explicit_.push_back(t);
    }
  }
  if (is_own || explicit_.size() == before) {
    return;
  }
  left_of_[c] = std::uint32_t(left_.size());
  left_cubes_.push_back(c);
  const std::uint32_t parts = level.cubes[c + 1].part - cube.part;
  left_.resize(left_.size() + parts);
  for (std::uint32_t i = cube.tetrahedron; i < end; ++i) {
    const std::uint32_t t = space_.sorted_tetrahedra()[i];
    if (is_gone[t] == 0 && !is_explicit(t)) {
      std::uint32_t part = 0;
      for (const ElementId e : space_.tetrahedra()[t]) {
        const std::uint32_t home = space_.home(e);
        if (home >= cube.part && home < cube.part + parts) {
          part = home - cube.part;
        }
      }
      space_.for_each_share(
          t, cube, [&](int path, double volume) { left_[left_of_[c] + part][std::size_t(path)] += float(volume); });
    }
  }
}

/// Lists the elements of explicit tetrahedra as level 0.
void LocalLevels::list_elements() {
  Level& level = levels_[0];
  level.clear();
  for (const std::uint32_t t : explicit_) {
    for (const ElementId e : space_.tetrahedra()[t]) {
      std::uint32_t& i = in_use_[0][e];
      if (i != none) {
        continue;
      }
      i = std::uint32_t(level.node.size());
      level.node.push_back(e);
      level.hangs.push_back(is_fine(e) ? 0 : 1);
      level.keep.push_back(fixed_.is_fixed(e) ? 0.0F : 1.0F);
      const CubeSpace::Level& of = space_.level(1);
      const CubeSpace::Part& part = of.parts[space_.home(e)];
      const auto at = space_.interpolate(space_.point(e), 1, of.cubes[part.cube]);
      std::array<std::uint32_t, 4> up;
      std::array<float, 4> share;
      for (std::size_t k = 0; k < 4; ++k) {
        up[k] = in_use_[1][part.corner[at.corner[k]]];
        share[k] = float(at.weight[k]);
      }
      level.up.push_back(up);
      level.share.push_back(share);
    }
  }
}

void LocalLevels::number_points() {
  point_count_ = unknown_count_ = 0;
  is_held_point_.clear();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.point.assign(level.size(), none);
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (l == 0 || level.beside_leaf[i] != 0 || level.hangs[i] != 0) {
        level.point[i] = std::uint32_t(point_count_++);
        unknown_count_ += level.hangs[i] == 0 && level.keep[i] > 0 ? 1 : 0;
        const ElementId e = l == 0 ? level.node[i] : fixed_.at_node(int(l), level.node[i]);
        is_held_point_.push_back(e != no_element && fixed_.is_held(e) ? 1 : 0);
      }
    }
  }
}

/// Computes the Laplacian around fine elements that are new: all tetrahedra around them are explicit.
void LocalLevels::fill_rows() {
  const Mesh& mesh = space_.mesh();
  constexpr std::uint32_t is_new = none - 1;
  bool any = false;
  for (const ElementId e : levels_[0].node) {
    if (is_fine(e) && row_of_[e] == none) {
      row_of_[e] = is_new;
      any = true;
    }
  }
  if (!any) {
    return;
  }
  std::vector<std::uint8_t> counts(mesh.element_count() > 0 ? levels_[0].size() : 0, 0);
  for (std::size_t i = 0; i < levels_[0].size(); ++i) {
    const ElementId e = levels_[0].node[i];
    if (row_of_[e] == is_new) {
      counts[i] = 1;
      row_of_[e] = std::uint32_t(rows_.size());
      rows_.resize(rows_.size() + mesh.neighbours_of(e).size(), 0);
    }
  }
  for (std::size_t k = 0; k < explicit_.size(); ++k) {
    const auto& corners = space_.tetrahedra()[explicit_[k]];
    for (std::size_t a = 0; a < 4; ++a) {
      if (counts[in_use_[0][corners[a]]] == 0) {
        continue;
      }
      const auto neighbours = mesh.neighbours_of(corners[a]);
      for (std::size_t b = 0; b < 4; ++b) {
        const auto at = a == b ? neighbours.end() : std::ranges::find(neighbours, corners[b]);
        if (at != neighbours.end()) {
          rows_[row_of_[corners[a]] + std::size_t(at - neighbours.begin())] +=
              float(coupling(gradients_[k], volumes_[k], std::min(a, b), std::max(a, b)));
        }
      }
    }
  }
}

/// Calls visit(i, j, weight) for each neighbour in use of each element that does not hang.
template <class Visit>
void LocalLevels::for_each_entry(double modulus, Visit visit) const {
  const Level& level = levels_[0];
  for (std::uint32_t i = 0; i < level.size(); ++i) {
    const ElementId e = level.node[i];
    if (level.hangs[i] != 0) {
      continue;
    }
    const auto neighbours = space_.mesh().neighbours_of(e);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const std::uint32_t j = in_use_[0][neighbours[k]];
      if (const float weight = rows_[row_of_[e] + k]; j != none && weight != 0) {
        visit(i, j, float(modulus) * std::max(least_share, weight));
      }
    }
  }
}

void LocalLevels::find_rows(double modulus) {
  fill_rows();
  Level& level = levels_[0];
  const std::size_t count = level.size();
  level.row.assign(count + 1, 0);
  level.diagonal.assign(count, 0);
  level.inverse.assign(count, 0);
  for_each_entry(modulus, [&](std::uint32_t i, std::uint32_t j, float) {
    ++level.row[i + 1];
    level.row[j + 1] += level.hangs[j];
  });
  for (std::size_t i = 0; i < count; ++i) {
    level.row[i + 1] += level.row[i];
  }
  level.neighbour.resize(level.row[count]);
  level.row_weight.resize(level.row[count]);
  std::vector<std::uint32_t> next(level.row.begin(), level.row.end() - 1);
  for_each_entry(modulus, [&](std::uint32_t i, std::uint32_t j, float weight) {
    level.diagonal[i] += weight;
    level.neighbour[next[i]] = j;
    level.row_weight[next[i]++] = weight;
    if (level.hangs[j] != 0) {
      level.neighbour[next[j]] = i;
      level.row_weight[next[j]++] = weight;
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    level.inverse[i] = level.hangs[i] == 0 && level.diagonal[i] > 0 ? level.keep[i] / level.diagonal[i] : 0;
  }
  for (auto* vector : {&level.r, &level.x, &level.t, &level.y}) {
    vector->resize(count);
  }
}

void LocalLevels::add_batches() {
  batches_.clear();
  beside_handle_.clear();
  tetrahedron_count_ = 0;
  for (std::size_t k = 0; k < explicit_.size(); ++k) {
    std::array<std::uint32_t, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
      points[i] = levels_[0].point[in_use_[0][space_.tetrahedra()[explicit_[k]][i]]];
    }
    add_tetrahedron(points, gradients_[k], volumes_[k]);
  }
  for (int l = 1; l <= top(); ++l) {
    const CubeSpace::Level& of = space_.level(l);
    for (const std::uint32_t c : cubes_[std::size_t(l)]) {
      for (std::uint32_t p = of.cubes[c].part; !is_divided(l, c) && p < of.cubes[c + 1].part; ++p) {
        add_leaf(l, p);
      }
    }
  }
  for (std::size_t lane = tetrahedron_count_ % Batch::lanes; lane > 0 && lane < Batch::lanes; ++lane) {
    for (auto& corner : batches_.back().corner) {
      corner[lane] = corner[0];
    }
  }
}

void LocalLevels::add_leaf(int l, std::uint32_t p) {
  const CubeSpace::Level& of = space_.level(l);
  const CubeSpace::Part& part = of.parts[p];
  const Level& level = levels_[std::size_t(l)];
  std::array<float, 6> volume = part.volume;
  if (l == 1 && left_of_[part.cube] != none) {
    volume = left_[left_of_[part.cube] + p - of.cubes[part.cube].part];
  }
  float all = 0;
  for (const float one : volume) {
    all += one;
  }
  const double steep = 1.0 / of.width;
  for (std::size_t path = 0; path < 6 && all > 0; ++path) {
    const auto corners = CubeSpace::corners_of(int(path));
    std::array<std::uint32_t, 4> points;
    for (std::size_t i = 0; i < 4; ++i) {
      points[i] = level.point[in_use_[std::size_t(l)][part.corner[corners[i]]]];
    }
    const auto& axes = CubeSpace::paths[path];
    Shape gradient{Point::Zero(), Point::Zero(), Point::Zero()};
    for (std::size_t i = 0; i < 3; ++i) {
      gradient[i][axes[i]] = steep;
      if (i < 2) {
        gradient[i][axes[i + 1]] = -steep;
      }
    }
    add_tetrahedron(points, gradient, std::max(volume[path], least_filled * all / 6));
  }
}

void LocalLevels::add_tetrahedron(const std::array<std::uint32_t, 4>& points, const Shape& gradient, double volume) {
  const std::size_t lane = tetrahedron_count_++ % Batch::lanes;
  if (lane == 0) {
    batches_.push_back({});
  }
  Batch& batch = batches_.back();
  bool is_held = false;
  for (std::size_t i = 0; i < 4; ++i) {
    batch.corner[i][lane] = points[i];
    is_held = is_held || is_held_point_[points[i]] != 0;
    for (std::size_t k = 0; i > 0 && k < 3; ++k) {
      batch.gradient[i - 1][k].at[lane] = gradient[i - 1][Eigen::Index(k)];
    }
  }
  batch.volume.at[lane] = volume;
  const auto index = std::uint32_t(batches_.size() - 1);
  if (is_held && (beside_handle_.empty() || beside_handle_.back() != index)) {
    beside_handle_.push_back(index);
  }
}

void LocalLevels::find_springs() {
  springs_.clear();
  for (const ElementId e : fixed_.elements()) {
    const auto [l, p] = leaf_of(e);
    if (l == 0) {
      continue;
    }
    const CubeSpace::Level& of = space_.level(l);
    const Level& level = levels_[std::size_t(l)];
    const CubeSpace::Part& part = of.parts[p];
    const auto at = space_.interpolate(space_.point(e), l, of.cubes[part.cube]);
    Spring spring{e, {}, {}};
    bool is_needed = false;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t node = in_use_[std::size_t(l)][part.corner[at.corner[i]]];
      spring.point[i] = level.point[node];
      spring.weight[i] = float(at.weight[i]);
      is_needed = is_needed || (level.keep[node] > 0 && std::abs(at.weight[i]) > 1e-3);
    }
    if (is_needed) {
      springs_.push_back(spring);
    }
  }
}

void LocalLevels::find_fixed_points() {
  fixed_points_.clear();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (level.keep[i] == 0 && level.point[i] != none) {
        fixed_points_.push_back({l == 0 ? level.node[i] : fixed_.at_node(int(l), level.node[i]), level.point[i]});
      }
    }
  }
}

void LocalLevels::multiply(const Level& level, int l, const std::vector<Floats4>& x, std::vector<Floats4>& result) {
  if (l == 0) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Floats4 sum = level.diagonal[i] * x[i];
      for (std::uint32_t k = level.row[i]; k < level.row[i + 1]; ++k) {
        sum -= level.row_weight[k] * x[level.neighbour[k]];
      }
      result[i] = sum;
    }
    return;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& n = level.next[i];
    const auto& w = level.weight[i];
    result[i] = level.diagonal[i] * x[i] - (w[0] * x[n[0]] + w[1] * x[n[1]] + w[2] * x[n[2]]) -
                (w[3] * x[n[3]] + w[4] * x[n[4]] + w[5] * x[n[5]]);
  }
  for (const auto& [i, j, weight] : level.more) {
    result[i] -= weight * x[j];
    result[j] -= weight * x[i];
  }
}

/// Sets x to a polynomial of degree 2 (Chebyshev's) of the diagonal's inverse times the matrix, times r.
void LocalLevels::smooth(Level& level, int l, std::vector<Floats4>& x) {
  constexpr float high = 2.04F, low = 0.25F, middle = (high + low) / 2, half = (high - low) / 2;
  constexpr float first = half / middle, second = 1 / (2 / first - first);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = level.inverse[i] / middle * level.r[i];
  }
  multiply(level, l, x, level.t);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] += second * first * x[i] + 2 * second / half * level.inverse[i] * (level.r[i] - level.t[i]);
  }
}

/// Smooths from the finest level on, and leaves the residual to the next coarser one.
void LocalLevels::go_down(const std::vector<Floats4>& q) {
  for (int l = 0;; ++l) {
    Level& level = levels_[std::size_t(l)];
    for (std::size_t i = 0; i < level.size(); ++i) {
      level.r[i] = level.point[i] != none ? q[level.point[i]] : Floats4{};
    }
    if (l > 0) {
      const Level& fine = levels_[std::size_t(l) - 1];
      const std::size_t ups = l == 1 ? 4 : 2;
      for (std::size_t i = 0; i < fine.size(); ++i) {
        const Floats4 rest = fine.keep[i] * (fine.r[i] - fine.t[i]);
        for (std::size_t k = 0; k < ups; ++k) {
          level.r[fine.up[i][k]] += fine.share[i][k] * rest;
        }
      }
    }
    for (std::size_t i = 0; i < level.size(); ++i) {
      level.r[i] *= level.keep[i];
    }
    if (l == top()) {
      return;
    }
    smooth(level, l, level.x);
    multiply(level, l, level.x, level.t);
  }
}

void LocalLevels::solve_coarsest() {
  Level& last = levels_.back();
  std::ranges::fill(last.x, Floats4{});
  for (int round = 0; round < rounds_of_coarsest; ++round) {
    smooth(last, top(), last.y);
    multiply(last, top(), last.y, last.t);
    for (std::size_t i = 0; i < last.size(); ++i) {
      last.x[i] += last.y[i];
      last.r[i] -= last.keep[i] * last.t[i];
    }
  }
}

/// Adds what the next coarser level found, and smooths.
void LocalLevels::go_up(int l) {
  Level& level = levels_[std::size_t(l)];
  const Level& coarse = levels_[std::size_t(l) + 1];
  const std::size_t ups = l == 0 ? 4 : 2;
  for (std::size_t i = 0; i < level.size(); ++i) {
    Floats4 sum{};
    for (std::size_t k = 0; k < ups; ++k) {
      sum += level.share[i][k] * coarse.x[level.up[i][k]];
    }
    sum *= level.keep[i];
    level.r[i] -= level.t[i];
    level.x[i] += sum;
    level.y[i] = sum;
  }
  multiply(level, l, level.y, level.t);
  for (std::size_t i = 0; i < level.size(); ++i) {
    level.r[i] -= level.t[i];
  }
  smooth(level, l, level.y);
  for (std::size_t i = 0; i < level.size(); ++i) {
    level.x[i] += level.y[i];
  }
}

void LocalLevels::cycle(const std::vector<Floats4>& q, std::vector<Floats4>& z) {
  go_down(q);
  solve_coarsest();
  for (int l = top() - 1; l >= 0; --l) {
    go_up(l);
  }
  z.resize(point_count_);
  for (const Level& level : levels_) {
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (level.point[i] != none) {
        z[level.point[i]] = level.x[i];
      }
    }
  }
}

}  // namespace chainmail
