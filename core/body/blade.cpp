#include "body/blade.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"
#include "mesh/split_along.h"

namespace chainmail {
namespace {

void require(bool holds, const std::string& problem, const std::string& remedy) {
  if (!holds) {
    throw Error("blade", problem, remedy);
  }
}

/// Returns the direction across the plane of an object in two dimensions.
Point across(const Mesh& mesh) { return Point::Unit(mesh.axes[0]).cross(Point::Unit(mesh.axes[1])); }

// Of the object in the view (pixels). StrokeInView moves strokes aside by a part of a pixel.
constexpr double view_width = 1000;

/// Parallel projection along a direction, with the middle of the object at the origin.
class ParallelView {
 public:
  ParallelView(const std::vector<Point>& points, const Point& along) {
    Point low = points.front(), high = low;
    for (const Point& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    middle_ = low + (high - low) / 2;
    const double size = (high - low).stableNorm();
    right_ = (size > 0 ? view_width / size : 1) * along.unitOrthogonal();
    up_ = along.cross(right_);
  }

  Eigen::Vector2d operator()(const Point& at) const { return {right_.dot(at - middle_), up_.dot(at - middle_)}; }

 private:
  Point middle_, right_, up_;
};

/// Returns a stroke that is the same inside the square of 2 · `view_width` around the object, and runs along its sides
/// where the stroke is outside. Far points would make the numbers coarse.
std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d>& stroke) {
  std::vector<Eigen::Vector2d> result;
  const auto add = [&](const Eigen::Vector2d& at) {
    result.emplace_back(at.cwiseMax(-view_width).cwiseMin(view_width));
  };
  for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
    const Eigen::Vector2d& from = stroke[i];
    const Eigen::Vector2d way = stroke[i + 1] - from;
    std::vector<double> shares;  // where the segment meets the lines of the sides
    for (Eigen::Index k = 0; k < 2; ++k) {
      for (const double side : {-view_width, view_width}) {
        if (const double share = (side - from[k]) / way[k]; share > 0 && share < 1) {
          shares.push_back(share);
        }
      }
    }
    std::ranges::sort(shares);
    add(from);
    std::ranges::for_each(shares, [&](double share) { add(from + share * way); });
  }
  add(stroke.back());
  return result;
}

}  // namespace

void check(const Blade& blade, const Mesh& mesh) {
  constexpr double smallest_angle = 1e-6;  // between the direction and the plane of an object
  check_can_split(mesh, "blade");
  require(blade.line.size() > 1, "its line has fewer than two points", "give two or more");
  require(blade.line.size() <= blade_point_limit,
          "its line has more than " + std::to_string(blade_point_limit) + " points", "give fewer");
  for (const Point& point : blade.line) {
    check_position(mesh, "blade", point);
    require(point.cwiseAbs().maxCoeff() <= coordinate_limit, "a coordinate is too large", "use numbers up to 1e100");
  }
  const bool is_plane = mesh.space_dimension < 3;
  require(blade.along || is_plane, "it has no direction", "give the direction along which its line is swept");
  const Point along = blade.along.value_or(across(mesh)).stableNormalized();
  require(along.allFinite() && along != Point::Zero(), "its direction is not finite or has the length 0",
          "give another one");
  require(!is_plane || std::abs(along.dot(across(mesh))) > smallest_angle,
          "its direction lies in the plane of the object", "leave it out, or give another one");
}

SplitPointer split_along(const Blade& blade, const Body& body) {
  const Mesh& mesh = body.mesh();
  check(blade, mesh);
  std::vector<Point> points;
  points.reserve(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    points.push_back(point_of(mesh, body.positions(), e));
  }
  const ParallelView seen(points, blade.along.value_or(across(mesh)).stableNormalized());
  std::vector<ViewPlace> places;
  places.reserve(points.size());
  std::ranges::for_each(points, [&](const Point& point) { places.push_back({seen(point)}); });
  std::vector<Eigen::Vector2d> stroke;
  for (Point at : blade.line) {
    for (int k = 0; k < 3; ++k) {
      at[k] = mesh.has_axis(k) ? at[k] : mesh.origin[k];
    }
    stroke.push_back(seen(at));
  }
  SplitEdit edit = split_along(mesh, places, clipped(stroke));
  return edit.empty() ? nullptr : make_split(body.mesh_pointer(), std::move(edit));
}

}  // namespace chainmail
