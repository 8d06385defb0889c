#include "measure/volume_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/cells.h"

namespace chainmail {
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
