#include "files/mesh/join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/formats/seeded_hash.h"

namespace chainmail {
namespace {

constexpr auto none = std::numeric_limits<ElementId>::max();

/// Finds points near others. Space is divided into cubes of twice the tolerance, so that a point has its neighbours in
/// at most eight of them, and so that a cube has few points that are not joined.
class NearPoints {
 public:
  NearPoints(const std::vector<Point>& points, double tolerance)
      : points_(points), tolerance_(tolerance), next_(points.size(), none) {}

  /// Returns the first added point near this one; none if there is none.
  ElementId near(ElementId point) const {
    ElementId found = none;
    for (int corner = 0; corner < (tolerance_ > 0 ? 8 : 1); ++corner) {
      const auto cube = cubes_.find(cube_of(points_[point], corner));
      for (ElementId other = cube == cubes_.end() ? none : cube->second; other != none; other = next_[other]) {
        if ((points_[other] - points_[point]).cwiseAbs().maxCoeff() <= tolerance_) {
          found = std::min(found, other);
        }
      }
    }
    return found;
  }

  void add(ElementId point) {
    const auto [cube, is_new] = cubes_.try_emplace(cube_of(points_[point], 0), point);
    if (!is_new) {
      next_[point] = std::exchange(cube->second, point);
    }
  }

 private:
  /// Returns the cube of a point, or for `corner` above 0 that of a nearest neighbour along the axes of its bits.
  std::array<double, 3> cube_of(const Point& point, int corner) const {
    std::array<double, 3> cube{};
    for (int axis = 0; axis < 3; ++axis) {
      const double place = tolerance_ > 0 ? point[axis] / (2 * tolerance_) : point[axis];
      const double whole = tolerance_ > 0 ? std::floor(place) : place;
      const double way = place - whole < 0.5 ? -1 : 1;
      cube[std::size_t(axis)] = whole + ((corner >> axis) % 2 == 1 ? way : 0.0) + 0.0;  // -0 is 0
    }
    return cube;
  }

  const std::vector<Point>& points_;
  double tolerance_;
  std::vector<ElementId> next_;  // the next point in the same cube
  std::unordered_map<std::array<double, 3>, ElementId, SeededHash> cubes_;
};

template <class Groups>
void rename(Groups& groups, const std::vector<ElementId>& ids) {
  for (auto& group : groups) {
    std::ranges::transform(group, group.begin(), [&](ElementId id) { return ids[id]; });
  }
}

}  // namespace

void rename_elements(MeshParts& parts, const std::vector<ElementId>& ids) {
  rename(parts.links, ids);
  rename(parts.triangles, ids);
  rename(parts.tetrahedra, ids);
  rename(parts.hexahedra, ids);
  for (std::size_t i = 0; i < parts.polygons.size(); i += parts.polygons[i] + 1) {
    const auto first = parts.polygons.begin() + std::ptrdiff_t(i) + 1;
    std::transform(first, first + parts.polygons[i], first, [&](ElementId id) { return ids[id]; });
  }
}

std::vector<ElementId> first_within(const std::vector<Point>& points, double tolerance) {
  NearPoints kept(points, tolerance);
  std::vector<ElementId> first(points.size());
  for (ElementId point = 0; point < first.size(); ++point) {
    const ElementId other = kept.near(point);
    first[point] = other == none ? point : other;
    if (other == none) {
      kept.add(point);
    }
  }
  return first;
}

std::uint64_t join_close(MeshParts& parts, double tolerance) {
  const std::vector<ElementId> first = first_within(parts.rest, tolerance);
  std::vector<ElementId> ids(first.size());
  ElementId count = 0;
  for (ElementId point = 0; point < first.size(); ++point) {
    const bool stays = first[point] == point;
    ids[point] = stays ? count : ids[first[point]];
    if (stays) {
      parts.rest[count++] = parts.rest[point];
    }
  }
  parts.rest.resize(count);
  if (count < first.size()) {
    rename_elements(parts, ids);
  }
  return first.size() - count;
}

double largest_extent(const MeshParts& parts) {
  if (parts.rest.empty()) {
    return 0;
  }
  Point low = parts.rest.front(), high = low;
  for (const Point& point : parts.rest) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).maxCoeff();
}

}  // namespace chainmail
