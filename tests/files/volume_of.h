#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mesh/mesh.h"

namespace chainmail::test {

/// Returns the volume of a tetrahedron, below 0 if it is inside out (mesh units cubed).
inline double volume_of_cell(const Mesh& mesh, const std::array<ElementId, 4>& cell) {
  const Point from = mesh.rest_position(cell[0]);
  return (mesh.rest_position(cell[1]) - from)
             .cross(mesh.rest_position(cell[2]) - from)
             .dot(mesh.rest_position(cell[3]) - from) /
         6;
}

/// Returns the sum over the tetrahedra and hexahedra of a mesh (mesh units cubed).
inline double volume_of(const Mesh& mesh) {
  const auto tetrahedron = [&](ElementId a, ElementId b, ElementId c, ElementId d) {
    return volume_of_cell(mesh, {a, b, c, d});
  };
  double sum = 0;
  for (const auto& cell : mesh.tetrahedra) {
    sum += volume_of_cell(mesh, cell);
  }
  for (const auto& h : mesh.hexahedra) {  // as five tetrahedra
    sum += tetrahedron(h[0], h[1], h[3], h[4]) + tetrahedron(h[2], h[3], h[1], h[6]) +
           tetrahedron(h[5], h[4], h[6], h[1]) + tetrahedron(h[7], h[6], h[4], h[3]) +
           tetrahedron(h[1], h[3], h[4], h[6]);
  }
  return sum;
}

}  // namespace chainmail::test
