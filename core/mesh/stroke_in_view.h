#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Where an element is in a view.
struct ViewPlace {
  Eigen::Vector2d at;
  /// Distance from the eye in perspective; 1 in parallel projection; at most 0 behind the eye.
  double distance = 1;
};

/// A point where the stroke crosses the line between two elements.
struct Crossing {
  double when = 0;   // number of the segment, and the share of it
  double share = 0;  // of the line, from its element with the lower id, on the object
};

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The stroke in the view, and where the elements are.
class StrokeInView {
 public:
  StrokeInView(std::span<const ViewPlace> places, std::span<const Eigen::Vector2d> stroke);

  bool empty() const { return points_.size() < 2; }
  std::span<const Eigen::Vector2d> points() const { return points_; }
  const Eigen::Vector2d& first() const { return points_.front(); }
  const Eigen::Vector2d& last() const { return points_.back(); }
  /// Bounds of the points.
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }
  const ViewPlace& place(ElementId element) const { return places_[element]; }
  /// Returns the crossings with the line between two elements, in the order of the stroke.
  std::vector<Crossing> crossings(ElementId a, ElementId b) const;
  bool is_inside(const Eigen::Vector2d& point, std::span<const ElementId> corners) const;

 private:
  std::optional<Crossing> crossing(std::size_t segment, const ViewPlace& a, const ViewPlace& b) const;

  std::span<const ViewPlace> places_;
  std::vector<Eigen::Vector2d> points_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::max()), high_ = -low_;
};

}  // namespace chainmail
