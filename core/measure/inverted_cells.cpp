#include "measure/inverted_cells.h"

#include <Eigen/Geometry>
#include <limits>

#include "measure/element_cells.h"

namespace chainmail {
namespace {

/// Returns a number with the sign of the orientation of a simplex.
template <class PositionOf>
double orientation(const Mesh& mesh, const Simplex& simplex, PositionOf at) {
  const auto edges = simplex.edges(at);
  const Point first = edges.col(0), second = edges.col(1);
  const Point across = first.cross(second);
  return simplex.count == 4 ? across.dot(Point(edges.col(2)))
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

}  // namespace chainmail
