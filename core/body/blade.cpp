#include "body/blade.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "mesh/divide_cells.h"
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

/// Parallel projection along a direction.
class ParallelView {
 public:
  ParallelView(const Mesh& mesh, const Point& along) : from_(mesh.box[0]) {
    constexpr double width = 1000;  // of the object (pixels): StrokeInView moves strokes aside by a part of a pixel
    const double size = (mesh.box[1] - from_).norm();
    right_ = (size > 0 ? width / size : 1) * along.unitOrthogonal();
    up_ = along.cross(right_);
  }

  Eigen::Vector2d operator()(const Point& at) const { return {right_.dot(at - from_), up_.dot(at - from_)}; }

 private:
  Point from_, right_, up_;
};

}  // namespace

void check(const Blade& blade, const Mesh& mesh) {
  constexpr double smallest_angle = 1e-6;  // between the direction and the plane of an object
  require(mesh.has_cells() || can_split(mesh), "the object has neither cells nor faces, or it is a lattice of faces",
          "cut its links instead");
  require(blade.line.size() > 1, "its line has fewer than two points", "give two or more");
  for (const Point& point : blade.line) {
    check_position(mesh, "blade", point);
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
  const ParallelView seen(mesh, blade.along.value_or(across(mesh)).stableNormalized());
  const PositionView positions = body.positions();
  std::vector<ViewPlace> places;
  places.reserve(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    places.push_back({seen(point_of(mesh, positions, e))});
  }
  std::vector<Eigen::Vector2d> stroke;
  for (Point at : blade.line) {
    for (int k = 0; k < 3; ++k) {
      at[k] = mesh.has_axis(k) ? at[k] : mesh.origin[k];
    }
    stroke.push_back(seen(at));
  }
  std::vector<LinkId> links(mesh.has_cells() ? 0 : mesh.link_count());
  std::iota(links.begin(), links.end(), 0);
  SplitEdit edit = mesh.has_cells() ? divide_cells(mesh, places, stroke) : split_along(mesh, places, stroke, links);
  return edit.empty() ? nullptr : make_split(body.mesh_pointer(), std::move(edit));
}

}  // namespace chainmail
