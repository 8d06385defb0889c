#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "body/positions.h"
#include "mesh/mesh.h"

namespace chainmail {

/// A simplex of an object, as the figures about its shape see it: a tetrahedron, or a triangle.
struct Simplex {
  std::array<ElementId, 4> corners{};
  int count = 0;  // of the corners: 4, or 3
  std::size_t cell = 0;

  /// Returns the edges from the first corner, one per column (3 x (count − 1), mesh units).
  template <class PositionOf>
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(PositionOf position_of) const {
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> result(3, count - 1);
    for (int i = 1; i < count; ++i) {
      result.col(i - 1) = position_of(corners[std::size_t(i)]) - position_of(corners[0]);
    }
    return result;
  }
};

/// Returns the tetrahedra of an object; a hexahedron has those at its eight corners, which share its number as a cell.
/// Without cells, these are its faces, as triangles.
std::vector<Simplex> simplices_of(const Mesh& mesh);

}  // namespace chainmail
