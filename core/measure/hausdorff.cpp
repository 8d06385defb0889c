#include "measure/hausdorff.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/surface.h"

namespace chainmail {
namespace {

using Triangle = std::array<Point, 3>;  // a point is a triangle whose corners coincide

/// Returns the squared distance from a point to a segment.
double squared_to_segment(const Point& from, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length = along.squaredNorm();
  const double at = length > 0 ? std::clamp((from - a).dot(along) / length, 0.0, 1.0) : 0;
  return (a + at * along - from).squaredNorm();
}

/// Returns the squared distance from a point to a triangle: to its plane if the foot is inside, otherwise to its edges.
double squared_to_triangle(const Point& from, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Point normal = (b - a).cross(c - a);
  const double size = normal.squaredNorm();
  if (size > 0) {
    const auto inside = [&](const Point& p, const Point& q) { return (q - p).cross(from - p).dot(normal) >= 0; };
    if (inside(a, b) && inside(b, c) && inside(c, a)) {
      const double height = (from - a).dot(normal);
      return height * height / size;
    }
  }
  return std::min({squared_to_segment(from, a, b), squared_to_segment(from, b, c), squared_to_segment(from, c, a)});
}

/// A tree of boxes over triangles, to find the nearest one.
class TriangleTree {
 public:
  explicit TriangleTree(const PointSurface& surface) {
    for (const auto& [a, b, c] : surface.triangles) {
      triangles_.push_back({surface.points[a], surface.points[b], surface.points[c]});
    }
    if (surface.triangles.empty()) {
      for (const Point& point : surface.points) {
        triangles_.push_back({point, point, point});
      }
    }
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.reserve(2 * triangles_.size() / leaf_size + 2);
    if (!triangles_.empty()) {
      build(0, triangles_.size());
    }
  }

  /// Returns the squared distance to the nearest triangle, if it is below `nearest`; otherwise `nearest`. Ends early
  /// with a value below `enough`.
  double squared_distance(const Point& from, double nearest, double enough) const {
    visit(0, from, nearest, enough);
    return nearest;
  }

 private:
  static constexpr std::size_t leaf_size = 8;

  struct Node {
    Point low, high;
    std::size_t first = 0, end = 0;   // in order_
    std::size_t left = 0, right = 0;  // 0 for a leaf
    double squared_distance(const Point& from) const {
      return (low - from).cwiseMax(from - high).cwiseMax(0).squaredNorm();
    }
  };

  std::size_t build(std::size_t first, std::size_t end) {
    const std::size_t number = nodes_.size();
    nodes_.push_back({triangles_[order_[first]][0], triangles_[order_[first]][0], first, end, 0, 0});
    for (std::size_t i = first; i < end; ++i) {
      for (const Point& corner : triangles_[order_[i]]) {
        nodes_[number].low = nodes_[number].low.cwiseMin(corner);
        nodes_[number].high = nodes_[number].high.cwiseMax(corner);
      }
    }
    if (end - first > leaf_size) {
      Eigen::Index axis = 0;
      (nodes_[number].high - nodes_[number].low).maxCoeff(&axis);
      const auto middle_of = [&](std::size_t triangle) {
        const auto& [a, b, c] = triangles_[triangle];
        return a[axis] + b[axis] + c[axis];
      };
      const std::size_t middle = first + (end - first) / 2;
      std::nth_element(order_.begin() + std::ptrdiff_t(first), order_.begin() + std::ptrdiff_t(middle),
                       order_.begin() + std::ptrdiff_t(end),
                       [&](std::size_t one, std::size_t other) { return middle_of(one) < middle_of(other); });
      const std::size_t left = build(first, middle), right = build(middle, end);
      nodes_[number].left = left;
      nodes_[number].right = right;
    }
    return number;
  }

  void visit(std::size_t number, const Point& from, double& nearest, double enough) const {
    const Node& node = nodes_[number];
    if (nearest <= enough || node.squared_distance(from) >= nearest) {
      return;
    }
    if (node.left == 0) {
      for (std::size_t i = node.first; i < node.end; ++i) {
        nearest = std::min(nearest, squared_to_triangle(from, triangles_[order_[i]]));
      }
      return;
    }
    const bool left_first = nodes_[node.left].squared_distance(from) <= nodes_[node.right].squared_distance(from);
    visit(left_first ? node.left : node.right, from, nearest, enough);
    visit(left_first ? node.right : node.left, from, nearest, enough);
  }

  std::vector<Triangle> triangles_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

/// Returns the largest of `largest` and the squared distances from the points of one surface to another one.
double one_way(const PointSurface& from, const TriangleTree& to, double largest) {
  for (const Point& point : from.points) {
    largest = std::max(largest, to.squared_distance(point, std::numeric_limits<double>::infinity(), largest));
  }
  return largest;
}

std::vector<std::array<ElementId, 3>> triangles_of(const Mesh& mesh) {
  if (!mesh.has_cells()) {
    return mesh.triangles;
  }
  // The surface refers to the mesh only while it is made.
  const MeshPointer unowned(MeshPointer(), &mesh);
  const std::vector<ElementId> corners = Surface(std::make_shared<const CellTable>(unowned)).triangles();
  std::vector<std::array<ElementId, 3>> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return triangles;
}

}  // namespace

PointSurface surface_of(const Mesh& mesh, const PositionView& positions) {
  PointSurface surface{{}, triangles_of(mesh)};
  constexpr ElementId none = std::numeric_limits<ElementId>::max();
  std::vector<ElementId> number(mesh.element_count(), surface.triangles.empty() ? 0 : none);
  for (auto& triangle : surface.triangles) {
    for (const ElementId corner : triangle) {
      number[corner] = 0;
    }
  }
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (number[e] != none) {
      number[e] = static_cast<ElementId>(surface.points.size());
      surface.points.push_back(point_of(mesh, positions, e));
    }
  }
  for (auto& triangle : surface.triangles) {
    triangle = {number[triangle[0]], number[triangle[1]], number[triangle[2]]};
  }
  return surface;
}

double hausdorff_distance(const PointSurface& one, const PointSurface& other) {
  if (one.points.empty() || other.points.empty()) {
    return 0;
  }
  return std::sqrt(one_way(other, TriangleTree(one), one_way(one, TriangleTree(other), 0)));
}

double hausdorff_distance(const Mesh& mesh, const PositionView& one, const PositionView& other) {
  return hausdorff_distance(surface_of(mesh, one), surface_of(mesh, other)) /
         (mesh.mean_link_length > 0 ? mesh.mean_link_length : 1);
}

}  // namespace chainmail
