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
#include "mesh/parts.h"

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

/// Returns the largest principal stretch of a simplex; 0 if it is flat at rest.
double stretch_of(const Mesh& mesh, const Simplex& simplex, const PositionView& positions) {
  const auto [a, b, c] = simplex.edges([&](ElementId e) { return mesh.rest_position(e); });
  const Point across = a.cross(b), third = simplex.count == 4 ? c : Point(across.normalized());
  const double volume = third.dot(across), squares = a.squaredNorm() + b.squaredNorm() + c.squaredNorm();
  if (!(volume * volume > 1e-16 * std::pow(squares, simplex.count - 1))) {
    return 0;
  }
  // The stretches are the singular values of the deformation gradient. The one across a triangle is 0.
  const std::array<Point, 3> now = simplex.edges([&](ElementId e) { return point_of(mesh, positions, e); });
  Eigen::Matrix3d gradient = now[0] * b.cross(third).transpose();
  gradient += now[1] * third.cross(a).transpose();
  gradient += now[2] * across.transpose();
  gradient /= volume;
  return std::sqrt(std::max(0.0, ascending_eigenvectors(gradient.transpose() * gradient).values[2]));
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

/// Sums the volumes of cells without a cut link, each with the sign of its orientation at rest.
template <class PositionOf>
double volume_of_cells(const Mesh& mesh, const Cuts& cuts, PositionOf at) {
  const auto rest = [&](ElementId e) { return mesh.rest_position(e); };
  double sum = 0;
  for (const auto& cell : mesh.tetrahedra) {
    if (is_whole(mesh, cuts, cell)) {
      const auto& [a, b, c, d] = cell;
      const double before = signed_volume(rest(a), rest(b), rest(c), rest(d));
      sum += (before < 0 ? -1 : 1) * signed_volume(at(a), at(b), at(c), at(d));
    }
  }
  for (const auto& cell : mesh.hexahedra) {
    if (is_whole(mesh, cuts, cell)) {
      sum += (hexahedron_volume(cell, rest) < 0 ? -1 : 1) * hexahedron_volume(cell, at);
    }
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
std::optional<double> volume(const Mesh& mesh, const Cuts& cuts, PositionOf at) {
  if (mesh.space_dimension < 2 || (mesh.space_dimension == 2 && mesh.triangles.empty())) {
    return std::nullopt;
  }
  if (mesh.space_dimension == 2) {
    return area_in_plane(mesh, at);
  }
  return mesh.has_cells() ? std::optional(volume_of_cells(mesh, cuts, at)) : enclosed_volume(mesh, at);
}

}  // namespace

std::optional<double> volume_of(const Mesh& mesh, const PositionView& positions, const Cuts& cuts) {
  return volume(mesh, cuts, [&](ElementId e) { return point_of(mesh, positions, e); });
}

std::optional<CellFigures> cell_figures(const Mesh& mesh, const Cuts& cuts, const PositionView& positions) {
  if (!mesh.has_cells()) {
    return std::nullopt;
  }
  CellFigures result{.parts = cuts.count() == 0 ? mesh.part_count : count_parts(mesh, cuts),
                     .rest_volume = volume_of_cells(mesh, cuts, [&](ElementId e) { return mesh.rest_position(e); }),
                     .volume = volume_of(mesh, positions, cuts).value_or(0)};
  const auto add = [&](const std::array<ElementId, 4>& corner) {
    std::array<Point, 4> at;
    std::ranges::transform(corner, at.begin(), [&](ElementId e) { return mesh.rest_position(e); });
    result.worst_quality = std::min(result.worst_quality.value_or(1), tetrahedron_quality(at));
  };
  const auto add_cell = [&](const auto& cell, auto add_tetrahedra) {
    if (is_whole(mesh, cuts, cell)) {
      add_tetrahedra(cell);
      ++result.cells;
    }
  };
  for (const auto& cell : mesh.tetrahedra) {
    add_cell(cell, add);
  }
  for (const auto& cell : mesh.hexahedra) {
    add_cell(cell, [&](const auto& one) { for_each_tetrahedron(mesh, one, add); });
  }
  return result;
}

std::optional<double> volume_change(const Mesh& mesh, const PositionView& positions, const Cuts& cuts) {
  const auto rest = volume(mesh, cuts, [&](ElementId e) { return mesh.rest_position(e); });
  return rest && *rest > 0 ? std::optional(*volume_of(mesh, positions, cuts) / *rest - 1) : std::nullopt;
}

}  // namespace chainmail
