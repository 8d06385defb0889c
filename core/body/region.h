#pragma once

#include <algorithm>
#include <cmath>

#include "body/softness.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The valid region: the box along the axes of the coordinates in which a neighbour may lie, relative to its sponsor
/// (mesh units).
template <class Scalar, int Dimension>
struct Region {
  Scalar low[Dimension];
  Scalar high[Dimension];
};

/// Returns the valid region of a link with this rest vector (thesis 3.1, Li and Brodlie 2003).
///
/// The minimum and maximum, which the thesis omits, keep the region of a link that runs left or down from being inside
/// out. Bounds are computed in double and rounded once. About the rest vector, they bound the difference of two
/// displacements: the lower one is never above 0 and the upper one never below 0, whatever is rounded.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const double (&rest_vector)[Dimension], const LinkSoftness& softness,
                                       bool about_rest_vector = false) {
  const double less = about_rest_vector ? 1 : 0;
  Region<Scalar, Dimension> region;
  for (int k = 0; k < Dimension; ++k) {
    double others = 0;
    for (int j = 0; j < Dimension; ++j) {
      others += j == k ? 0 : std::abs(rest_vector[j]);
    }
    const double compressed = (softness.compression - less) * rest_vector[k];
    const double stretched = (softness.stretch - less) * rest_vector[k];
    region.low[k] = static_cast<Scalar>(std::min(compressed, stretched) - softness.shear * others);
    region.high[k] = static_cast<Scalar>(std::max(compressed, stretched) + softness.shear * others);
  }
  return region;
}

/// Returns the valid region of element `to` relative to element `from`, along the axes of the mesh's coordinates.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const Mesh& mesh, ElementId from, ElementId to, const LinkSoftness& softness,
                                       bool about_rest_vector = false) {
  double rest_vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    rest_vector[k] = mesh.rest[std::size_t{to} * Dimension + k] - mesh.rest[std::size_t{from} * Dimension + k];
  }
  return valid_region<Scalar, Dimension>(rest_vector, softness, about_rest_vector);
}

/// The same along turned axes, for a mesh whose coordinates are those of the world.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const Mesh& mesh, const RegionAxes& axes, ElementId from, ElementId to,
                                       const LinkSoftness& softness) {
  if (!axes.is_turned()) {
    return valid_region<Scalar, Dimension>(mesh, from, to, softness);
  }
  double rest_vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    rest_vector[k] = mesh.rest[std::size_t{to} * Dimension + k] - mesh.rest[std::size_t{from} * Dimension + k];
  }
  turn_into_axes(mesh, axes, rest_vector);
  return valid_region<Scalar, Dimension>(rest_vector, softness);
}

}  // namespace chainmail
