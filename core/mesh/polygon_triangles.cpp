#include "mesh/polygon_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

namespace chainmail {
namespace {

using Flat = Eigen::Vector2d;

/// Twice the area of a triangle in the plane; positive if its corners are in the order of the polygon.
double area(const Flat& a, const Flat& b, const Flat& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Returns the corners as seen along the mean normal, from the side from which they turn left; empty for a polygon
/// without an area.
std::vector<Flat> seen_along_normal(std::span<const Point> at) {
  Point normal = Point::Zero();
  for (std::size_t i = 0; i < at.size(); ++i) {
    normal += (at[i] - at[0]).cross(at[(i + 1) % at.size()] - at[0]);
  }
  normal.stableNormalize();
  if (!normal.allFinite() || normal.isZero()) {
    return {};
  }
  const Point right = normal.unitOrthogonal(), up = normal.cross(right);
  std::vector<Flat> seen;
  for (const Point& point : at) {
    seen.emplace_back(right.dot(point - at[0]), up.dot(point - at[0]));
  }
  return seen;
}

/// Cuts triangles off a polygon in the plane until three corners are left.
class Ears {
 public:
  explicit Ears(std::vector<Flat> at) : at_(std::move(at)) {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      ring_.push_back(i);
    }
  }

  bool is_convex() const {
    for (std::size_t place = 0; place < ring_.size(); ++place) {
      if (turn(place) < 0) {
        return false;
      }
    }
    return true;
  }

  /// Calls visit(a, b, c) with the corners of each triangle. Only the neighbours of an ear that is cut off are looked
  /// at again, so that the time grows with the square of the corners.
  template <class Visit>
  void cut(Visit visit) {
    for (std::size_t place = 0; place < ring_.size(); ++place) {
      is_ear_.push_back(looks_like_ear(place));
    }
    for (std::size_t place = 0; ring_.size() > 2;) {
      place = next_ear(place % ring_.size());
      visit(before(place), ring_[place], after(place));
      ring_.erase(ring_.begin() + std::ptrdiff_t(place));
      is_ear_.erase(is_ear_.begin() + std::ptrdiff_t(place));
      for (const std::size_t beside : {(place + ring_.size() - 1) % ring_.size(), place % ring_.size()}) {
        is_ear_[beside] = looks_like_ear(beside);
      }
    }
  }

 private:
  std::size_t before(std::size_t place) const { return ring_[(place + ring_.size() - 1) % ring_.size()]; }
  std::size_t after(std::size_t place) const { return ring_[(place + 1) % ring_.size()]; }
  double turn(std::size_t place) const { return area(at_[before(place)], at_[ring_[place]], at_[after(place)]); }

  /// True if the triangle at this place is in the polygon and no other corner is in it.
  bool looks_like_ear(std::size_t place) const {
    if (!(turn(place) > 0)) {
      return false;
    }
    const Flat &a = at_[before(place)], &b = at_[ring_[place]], &c = at_[after(place)];
    return std::none_of(ring_.begin(), ring_.end(), [&](std::size_t i) {
      const Flat& p = at_[i];
      return p != a && p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
    });
  }

  /// Returns the place of the next ear; without one, as in a polygon that crosses itself, the place that turns most.
  std::size_t next_ear(std::size_t from) const {
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (const std::size_t place = (from + i) % ring_.size(); is_ear_[place]) {
        return place;
      }
    }
    std::size_t best = 0;
    for (std::size_t place = 1; place < ring_.size(); ++place) {
      best = turn(place) > turn(best) ? place : best;
    }
    return best;
  }

  std::vector<Flat> at_;
  std::vector<std::size_t> ring_;  // corners that are left
  std::vector<bool> is_ear_;       // for each of them
};

}  // namespace

void divide_polygon(std::span<const ElementId> corners, std::span<const Point> at,
                    std::vector<std::array<ElementId, 3>>& triangles) {
  Ears ears(corners.size() > max_concave_corners ? std::vector<Flat>() : seen_along_normal(at));
  if (corners.size() > 3 && !ears.is_convex()) {
    ears.cut([&](std::size_t a, std::size_t b, std::size_t c) {
      triangles.push_back({corners[a], corners[b], corners[c]});
    });
    return;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

}  // namespace chainmail
