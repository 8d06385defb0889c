#include "mesh/stroke_in_view.h"

#include <algorithm>

namespace chainmail {
namespace {

// Moves the stroke (pixels), so that no corner is exactly on it.
const Eigen::Vector2d aside(1.37e-6, 0.73e-6);

}  // namespace

StrokeInView::StrokeInView(std::span<const ViewPlace> places, std::span<const Eigen::Vector2d> stroke)
    : places_(places) {
  for (const Eigen::Vector2d& point : stroke) {
    points_.push_back(point + aside);
    low_ = low_.cwiseMin(points_.back());
    high_ = high_.cwiseMax(points_.back());
  }
}

std::vector<Crossing> StrokeInView::crossings(ElementId a, ElementId b) const {
  const ViewPlace &from = places_[std::min(a, b)], &to = places_[std::max(a, b)];
  std::vector<Crossing> result;
  if ((from.at.cwiseMin(to.at).array() > high_.array()).any() ||
      (from.at.cwiseMax(to.at).array() < low_.array()).any()) {
    return result;
  }
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    if (const auto found = crossing(i, from, to)) {
      result.push_back(*found);
    }
  }
  return result;
}

std::optional<Crossing> StrokeInView::crossing(std::size_t segment, const ViewPlace& a, const ViewPlace& b) const {
  const Eigen::Vector2d &p = points_[segment], &q = points_[segment + 1];
  const Eigen::Vector2d way = q - p, side = b.at - a.at;
  const double of_a = cross(way, a.at - p), of_b = cross(way, b.at - p);
  const double of_p = cross(side, p - a.at), of_q = cross(side, q - a.at);
  if ((of_a >= 0) == (of_b >= 0) || (of_p >= 0) == (of_q >= 0)) {
    return std::nullopt;
  }
  const double seen = of_a / (of_a - of_b), near = seen * a.distance;  // perspective shortens what is far away
  return Crossing{double(segment) + of_p / (of_p - of_q), near / ((1 - seen) * b.distance + near)};
}

bool StrokeInView::is_inside(const Eigen::Vector2d& point, std::span<const ElementId> corners) const {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = places_[corners[i]].at, &b = places_[corners[(i + 1) % corners.size()]].at;
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace chainmail
