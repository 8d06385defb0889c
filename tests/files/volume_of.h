#pragma once

#include <Eigen/Geometry>

#include "mesh/mesh.h"

namespace chainmail::test {

/// Returns the volume of the tetrahedra and hexahedra of a mesh (mesh units cubed).
inline double volume_of(const Mesh& mesh) {
  const auto tetrahedron = [&](ElementId a, ElementId b, ElementId c, ElementId d) {
    const Point from = mesh.rest_position(a);
    return (mesh.rest_position(b) - from).cross(mesh.rest_position(c) - from).dot(mesh.rest_position(d) - from) / 6;
  };
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    sum += tetrahedron(a, b, c, d);
  }
  for (const auto& h : mesh.hexahedra) {  // as five tetrahedra
    sum += tetrahedron(h[0], h[1], h[3], h[4]) + tetrahedron(h[2], h[3], h[1], h[6]) +
           tetrahedron(h[5], h[4], h[6], h[1]) + tetrahedron(h[7], h[6], h[4], h[3]) +
           tetrahedron(h[1], h[3], h[4], h[6]);
  }
  return sum;
}

}  // namespace chainmail::test
