#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "files/formats/seeded_hash.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Gives equal positions one id, in the order in which they first appear. For formats that list faces by positions.
class PointIds {
 public:
  /// The points get into `points`.
  explicit PointIds(std::vector<Point>& points) : points_(points) {}

  ElementId of(const Point& point) {
    const std::array key{point.x() + 0.0, point.y() + 0.0, point.z() + 0.0};  // -0 is 0
    const auto [found, is_new] = ids_.try_emplace(key, static_cast<ElementId>(points_.size()));
    if (is_new) {
      points_.push_back(point);
    }
    return found->second;
  }

 private:
  std::vector<Point>& points_;
  std::unordered_map<std::array<double, 3>, ElementId, SeededHash> ids_;
};

}  // namespace chainmail
