#include "body/positions.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "mesh/error.h"

namespace chainmail {

double position_limit(Precision precision) {
  return precision == Precision::single_precision ? double(std::numeric_limits<float>::max() / 16)
                                                  : std::numeric_limits<double>::max() / 16;
}

void check(Precision precision, const Mesh& mesh) {
  const double limit = position_limit(precision);
  for (const Point& corner : mesh.box) {
    if (!(corner.array().abs() <= limit).all()) {
      throw Error("mesh", "a coordinate is out of the range of the precision", "use double, or scale the mesh down");
    }
  }
}

std::vector<double> coordinates_of(const Mesh& mesh, std::span<const double> positions, Precision precision) {
  if (positions.size() != std::size_t{3} * mesh.element_count()) {
    throw Error("positions",
                "there are " + std::to_string(positions.size()) + " numbers for " +
                    std::to_string(mesh.element_count()) + " elements",
                "give x, y and z for each element");
  }
  const double limit = position_limit(precision);
  std::vector<double> coordinates;
  coordinates.reserve(mesh.rest.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const int k = int(i % 3);
    const auto where = [i] { return "positions, element " + std::to_string(i / 3); };
    if (!(std::abs(positions[i]) <= limit)) {
      throw Error(where(), "a coordinate is not finite or out of the range of the precision", "give smaller numbers");
    }
    if (mesh.has_axis(k)) {
      coordinates.push_back(positions[i]);
    } else if (positions[i] != mesh.origin[k]) {
      refuse_axis(where(), k);
    }
  }
  return coordinates;
}

Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element) {
  std::array<double, 3> coordinates{};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    coordinates[k] = positions(element, k);
  }
  return mesh.to_point(coordinates.data());
}

std::vector<double> displacements_of(const Mesh& mesh, const PositionView& positions,
                                     std::span<const ElementId> elements) {
  const auto dimension = static_cast<std::size_t>(mesh.space_dimension);
  std::vector<double> displacements;
  displacements.reserve(dimension * elements.size());
  for (const ElementId element : elements) {
    for (std::size_t k = 0; k < dimension; ++k) {
      displacements.push_back(positions(element, static_cast<int>(k)) - mesh.rest[element * dimension + k]);
    }
  }
  return displacements;
}

std::vector<double> displacements_of(const Mesh& mesh, const PositionView& positions) {
  std::vector<ElementId> all(mesh.element_count());
  std::iota(all.begin(), all.end(), ElementId{0});
  return displacements_of(mesh, positions, all);
}

}  // namespace chainmail
