#include "measure/shape_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "mesh/cells.h"
#include "mesh/eigenvectors.h"

namespace chainmail {
namespace {

/// A simplex of an object, as the figures about its shape see it: a tetrahedron, or a triangle.
struct Simplex {
  std::array<ElementId, 4> corners{};
  int count = 0;  // of the corners: 4, or 3
  std::size_t cell = 0;

  /// Returns the edges from the first corner (mesh units); the third one is 0 for a triangle.
  template <class PositionOf>
  std::array<Point, 3> edges(PositionOf position_of) const {
    const Point first = position_of(corners[0]);
    return {position_of(corners[1]) - first, position_of(corners[2]) - first,
            count == 4 ? Point(position_of(corners[3]) - first) : Point(Point::Zero())};
  }
};

// The corners of a hexahedron, each with its three neighbours, counterclockwise as seen from outside the corner.
constexpr std::array<std::array<std::size_t, 4>, 8> corners_of_hexahedron{
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};

/// Returns the tetrahedra of an object; a hexahedron has those at its eight corners, which share its number as a cell.
/// Without cells, these are its faces, as triangles.
std::vector<Simplex> simplices_of(const Mesh& mesh) {
  std::vector<Simplex> result;
  std::size_t cell = 0;
  for (const auto& corners : mesh.tetrahedra) {
    result.push_back({corners, 4, cell++});
  }
  for (const auto& corners : mesh.hexahedra) {
    for (const auto& [a, b, c, d] : corners_of_hexahedron) {
      result.push_back({{corners[a], corners[b], corners[c], corners[d]}, 4, cell});
    }
    ++cell;
  }
  if (result.empty()) {
    for (const auto& [a, b, c] : mesh.triangles) {
      result.push_back({{a, b, c, a}, 3, cell++});
    }
  }
  return result;
}

/// Returns a number with the sign of the orientation of a simplex.
template <class PositionOf>
double orientation(const Mesh& mesh, const Simplex& simplex, PositionOf at) {
  const auto [first, second, third] = simplex.edges(at);
  const Point across = first.cross(second);
  return simplex.count == 4 ? across.dot(third)
                            : across.dot(Point::Unit(mesh.axes[0]).cross(Point::Unit(mesh.axes[1])));
}

}  // namespace

std::optional<std::uint64_t> inverted_cells(const Mesh& mesh, const PositionView& positions) {
  const bool has_inside = mesh.space_dimension == 2 || mesh.has_cells();
  const std::vector<Simplex> simplices = has_inside ? simplices_of(mesh) : std::vector<Simplex>();
  if (simplices.empty()) {
    return std::nullopt;
  }
  std::uint64_t count = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
  for (const Simplex& one : simplices) {
    const double before = orientation(mesh, one, [&](ElementId e) { return mesh.rest_position(e); });
    const double now = orientation(mesh, one, [&](ElementId e) { return point_of(mesh, positions, e); });
    if (one.cell != last && before != 0 && !(before * now > 0)) {
      ++count;
      last = one.cell;
    }
  }
  return count;
}

namespace {

/// Returns the products of edges with each other: the metric of their simplex.
Eigen::Matrix3d metric_of(const std::array<Point, 3>& edges) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result(i, j) = edges[std::size_t(i)].dot(edges[std::size_t(j)]);
    }
  }
  return result;
}

/// Returns the Cholesky factor of a positive definite matrix, in its lower triangle.
Eigen::Matrix3d factor_of(Eigen::Matrix3d matrix) {
  for (int j = 0; j < 3; ++j) {
    for (int i = j; i < 3; ++i) {
      for (int k = 0; k < j; ++k) {
        matrix(i, j) -= matrix(i, k) * matrix(j, k);
      }
      matrix(i, j) = i == j ? std::sqrt(matrix(j, j)) : matrix(i, j) / matrix(j, j);
    }
  }
  return matrix;
}

/// Multiplies a matrix, from the left, by the inverse of a lower triangle.
Eigen::Matrix3d divided(Eigen::Matrix3d matrix, const Eigen::Matrix3d& lower) {
  for (int column = 0; column < 3; ++column) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < i; ++k) {
        matrix(i, column) -= lower(i, k) * matrix(k, column);
      }
      matrix(i, column) /= lower(i, i);
    }
  }
  return matrix;
}

/// Returns the largest principal stretch of a simplex; 0 if it is flat at rest.
double stretch_of(const Mesh& mesh, const Simplex& simplex, const PositionView& positions) {
  // The squares of the stretches are the eigenvalues of the metric now, relative to that at rest.
  Eigen::Matrix3d before = metric_of(simplex.edges([&](ElementId e) { return mesh.rest_position(e); }));
  const Eigen::Matrix3d after = metric_of(simplex.edges([&](ElementId e) { return point_of(mesh, positions, e); }));
  const double trace = before.trace();
  if (simplex.count < 4) {
    before(2, 2) = 1;  // the stretch across a triangle is 0
  }
  const double volume = before.col(0).cross(before.col(1)).dot(before.col(2));
  if (!(volume > 1e-16 * std::pow(trace, simplex.count - 1))) {
    return 0;
  }
  const Eigen::Matrix3d lower = factor_of(before);
  const Eigen::Matrix3d half = divided(after, lower);
  return std::sqrt(std::max(0.0, ascending_eigenvectors(divided(half.transpose(), lower)).values[2]));
}

}  // namespace

std::optional<double> largest_principal_stretch(const Mesh& mesh, const PositionView& positions) {
  double largest = 0;
  for (const Simplex& one : simplices_of(mesh)) {
    largest = std::max(largest, stretch_of(mesh, one, positions));
  }
  return largest > 0 ? std::optional(largest) : std::nullopt;
}

namespace {

double signed_volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  return (b - a).dot((c - a).cross(d - a)) / 6;
}

/// Returns the volume under a side of a cell, seen from a corner of the cell. A side of four corners is the mean of its
/// two ways to be split.
template <class PositionOf, class Cell>
double hexahedron_volume(const Cell& cell, PositionOf at) {
  double sum = 0;
  for (const auto& side : hexahedron_sides) {
    const Point from = at(cell[0]), a = at(cell[std::size_t(side[0])]), b = at(cell[std::size_t(side[1])]),
                c = at(cell[std::size_t(side[2])]), d = at(cell[std::size_t(side[3])]);
    sum += (signed_volume(from, a, b, c) + signed_volume(from, a, c, d) + signed_volume(from, b, c, d) +
            signed_volume(from, b, d, a)) /
           2;
  }
  return sum;
}

/// True if each edge of the triangles is used once in each direction.
bool is_closed(const Mesh& mesh) {
  std::vector<std::array<ElementId, 2>> there, back;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      there.push_back(edge);
      back.push_back({edge[1], edge[0]});
    }
  }
  std::ranges::sort(there);
  std::ranges::sort(back);
  return there == back && std::ranges::adjacent_find(there) == there.end();
}

/// Sums the volumes of cells, each with the sign of its orientation at rest.
template <class PositionOf>
double volume_of_cells(const Mesh& mesh, PositionOf at) {
  const auto rest = [&](ElementId e) { return mesh.rest_position(e); };
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const double before = signed_volume(rest(a), rest(b), rest(c), rest(d));
    sum += (before < 0 ? -1 : 1) * signed_volume(at(a), at(b), at(c), at(d));
  }
  for (const auto& cell : mesh.hexahedra) {
    sum += (hexahedron_volume(cell, rest) < 0 ? -1 : 1) * hexahedron_volume(cell, at);
  }
  return sum;
}

template <class PositionOf>
double area_in_plane(const Mesh& mesh, PositionOf at) {
  const Point normal = Point::Unit(mesh.axes[0]).cross(Point::Unit(mesh.axes[1]));
  const auto area = [&](const auto& triangle, auto of) {
    return (of(triangle[1]) - of(triangle[0])).cross(of(triangle[2]) - of(triangle[0])).dot(normal) / 2;
  };
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const double before = area(triangle, [&](ElementId e) { return mesh.rest_position(e); });
    sum += (before < 0 ? -1 : 1) * area(triangle, at);
  }
  return sum;
}

/// Returns what closed faces enclose, or none: their signed volume seen from the first element (Gauss).
template <class PositionOf>
std::optional<double> enclosed_volume(const Mesh& mesh, PositionOf at) {
  if (mesh.triangles.empty() || !is_closed(mesh)) {
    return std::nullopt;
  }
  const auto sum = [&](auto of) {
    double volume = 0;
    const Point from = of(0);
    for (const auto& [a, b, c] : mesh.triangles) {
      volume += signed_volume(from, of(a), of(b), of(c));
    }
    return volume;
  };
  const double before = sum([&](ElementId e) { return mesh.rest_position(e); });
  return (before < 0 ? -1 : 1) * sum(at);
}

template <class PositionOf>
std::optional<double> volume(const Mesh& mesh, PositionOf at) {
  if (mesh.space_dimension < 2 || (mesh.space_dimension == 2 && mesh.triangles.empty())) {
    return std::nullopt;
  }
  if (mesh.space_dimension == 2) {
    return area_in_plane(mesh, at);
  }
  return mesh.has_cells() ? std::optional(volume_of_cells(mesh, at)) : enclosed_volume(mesh, at);
}

}  // namespace

std::optional<double> volume_of(const Mesh& mesh, const PositionView& positions) {
  return volume(mesh, [&](ElementId e) { return point_of(mesh, positions, e); });
}

std::optional<double> volume_change(const Mesh& mesh, const PositionView& positions) {
  const auto rest = volume(mesh, [&](ElementId e) { return mesh.rest_position(e); });
  return rest && *rest > 0 ? std::optional(*volume_of(mesh, positions) / *rest - 1) : std::nullopt;
}

}  // namespace chainmail
