#include "mesh/separate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "mesh/disjoint_sets.h"

namespace chainmail {
namespace {

using Triangle = std::array<ElementId, 3>;

/// Returns the quality of a triangle at rest: its area, relative to its sides. 0 if its corners are on a line.
double quality(const std::vector<Point>& rest, ElementId a, ElementId b, ElementId c) {
  const Point ab = rest[b] - rest[a], ac = rest[c] - rest[a], bc = rest[c] - rest[b];
  return ab.cross(ac).norm() / (ab.squaredNorm() + ac.squaredNorm() + bc.squaredNorm());
}

/// Returns the triangles of a convex piece whose worst one is best: the best way to fill the corners i to j follows
/// from the third corner of the triangle at the line between them (Klincsek 1980).
std::vector<Triangle> triangulated(const Ring& ring, const std::vector<Point>& rest) {
  const std::size_t n = ring.size();
  std::vector<double> worst(n * n, std::numeric_limits<double>::max());
  std::vector<std::size_t> third(n * n, 0);
  for (std::size_t length = 2; length < n; ++length) {
    for (std::size_t i = 0; i + length < n; ++i) {
      const std::size_t j = i + length;
      worst[i * n + j] = -1;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double here = std::min({worst[i * n + k], worst[k * n + j], quality(rest, ring[i], ring[k], ring[j])});
        if (here > worst[i * n + j]) {
          worst[i * n + j] = here;
          third[i * n + j] = k;
        }
      }
    }
  }
  std::vector<Triangle> result;
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j >= i + 2) {
      const std::size_t k = third[i * n + j];
      result.push_back({ring[i], ring[k], ring[j]});
      open.push_back({k, j});
      open.push_back({i, k});
    }
  }
  return result;
}

/// Rotates a polygon so that the triangles about its first corner, as which it is drawn, are as good as possible.
Ring rotated(Ring ring, const std::vector<Point>& rest) {
  const auto worst = [&rest](const Ring& one) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 2; i < one.size(); ++i) {
      least = std::min(least, quality(rest, one[0], one[i - 1], one[i]));
    }
    return least;
  };
  Ring best = ring;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    best = worst(ring) > worst(best) ? ring : best;
  }
  return best;
}

/// Separates faces along the sides that are cut, and writes the edit.
class Separation {
 public:
  Separation(const Mesh& mesh, const Faces& faces, const FacesInPieces& divided)
      : faces_(faces), cut_(divided.cut), rest_(rest_after(mesh, divided.points)) {
    edit_.elements = divided.points;
    for (const auto& [face, pieces] : divided.pieces) {
      replace(face);
      for (const Ring& piece : pieces) {
        add(piece, faces.is_polygon(face));
      }
    }
  }

  SplitEdit run();

 private:
  /// A face that has an element as a corner.
  struct Corner {
    std::uint32_t face = 0;  // of the mesh; or, from the number of these on, a new one
    std::size_t index = 0;
  };

  void replace(std::uint32_t face) {
    (faces_.is_polygon(face) ? edit_.removed_polygons : edit_.removed)
        .push_back(faces_.is_polygon(face) ? faces_.polygon(face) : face);
    replaced_.insert(face);
  }
  void add(const Ring& piece, bool is_polygon);
  std::span<const ElementId> corners(std::uint32_t face) const {
    return face < faces_.count() ? faces_[face] : std::span<const ElementId>(added_[face - faces_.count()]);
  }
  std::map<ElementId, std::vector<Corner>> corners_at_cut() const;
  void separate(ElementId element, const std::vector<Corner>& around);
  void write();

  const Faces& faces_;
  const std::set<EdgeKey>& cut_;
  std::vector<Point> rest_;
  std::set<std::uint32_t> replaced_;
  std::vector<Ring> added_;
  std::map<std::uint32_t, std::map<std::size_t, ElementId>> moved_;  // corners that become copies, by face
  SplitEdit edit_;
};

void Separation::add(const Ring& piece, bool is_polygon) {
  if (is_polygon) {
    added_.push_back(rotated(piece, rest_));
    return;
  }
  for (const Triangle& one : triangulated(piece, rest_)) {
    added_.emplace_back(one.begin(), one.end());
  }
}

/// Returns the corners of faces at each element on the cut.
std::map<ElementId, std::vector<Separation::Corner>> Separation::corners_at_cut() const {
  std::vector<bool> is_meant(rest_.size());
  for (const EdgeKey one : cut_) {
    is_meant[ends_of(one)[0]] = is_meant[ends_of(one)[1]] = true;
  }
  std::map<ElementId, std::vector<Corner>> result;
  for (std::uint32_t face = 0; face < faces_.count() + added_.size(); ++face) {
    const auto all = corners(face);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (is_meant[all[i]] && !replaced_.contains(face)) {
        result[all[i]].push_back({face, i});
      }
    }
  }
  return result;
}

/// Groups the faces around an element by the sides at it that are not cut. One group keeps the element; each other gets
/// a copy. Faces that no side joined before keep the element, too.
void Separation::separate(ElementId element, const std::vector<Corner>& around) {
  std::map<ElementId, std::vector<std::size_t>> at_side;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto all = corners(around[i].face);
    at_side[all[(around[i].index + 1) % all.size()]].push_back(i);
    at_side[all[(around[i].index + all.size() - 1) % all.size()]].push_back(i);
  }
  DisjointSets before(around.size()), after(around.size());
  for (const auto& [other, faces] : at_side) {
    for (const std::size_t one : faces) {
      before.unite(faces[0], one);
      if (!cut_.contains(edge_key(element, other))) {
        after.unite(faces[0], one);
      }
    }
  }
  std::map<std::size_t, ElementId> copies;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::size_t group = after.of(i);
    if (group == before.of(i)) {
      continue;
    }
    if (const auto [copy, is_new] = copies.try_emplace(group, static_cast<ElementId>(rest_.size())); is_new) {
      rest_.push_back(rest_[element]);
      edit_.elements.push_back(SplitPoint::copy(element));
    }
    moved_[around[i].face][around[i].index] = copies[group];
  }
}

/// Moves corners to their copies, and writes the new faces.
void Separation::write() {
  for (const auto& [face, to] : moved_) {
    Ring ring(corners(face).begin(), corners(face).end());
    for (const auto& [index, copy] : to) {
      ring[index] = copy;
    }
    if (face < faces_.count()) {
      replace(face);
      added_.push_back(std::move(ring));
    } else {
      added_[face - faces_.count()] = std::move(ring);
    }
  }
  std::ranges::sort(edit_.removed);
  std::ranges::sort(edit_.removed_polygons);
  for (const Ring& ring : added_) {
    if (ring.size() == 3) {
      edit_.triangles.push_back({ring[0], ring[1], ring[2]});
    } else {
      edit_.polygons.push_back(static_cast<ElementId>(ring.size()));
      edit_.polygons.insert(edit_.polygons.end(), ring.begin(), ring.end());
    }
  }
}

SplitEdit Separation::run() {
  for (const auto& [element, around] : corners_at_cut()) {
    separate(element, around);
  }
  if (moved_.empty()) {
    return {};
  }
  write();
  return std::move(edit_);
}

}  // namespace

SplitEdit separate(const Mesh& mesh, const Faces& faces, const FacesInPieces& divided) {
  return Separation(mesh, faces, divided).run();
}

}  // namespace chainmail
