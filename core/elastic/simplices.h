#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Up to 3 x 3, and up to the 12 coordinates of a tetrahedron's corners: on the stack.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

/// An object as linear finite elements of its space dimension n: bars, triangles of thickness 1, or tetrahedra. Each
/// has n + 1 corners.
struct Simplices {
  int dimension = 3;
  std::vector<ElementId> corners;  // n + 1 each
  std::vector<double> volumes;     // at rest: lengths, areas times the thickness, volumes (mesh units to the n)
  std::vector<double> gradients;   // of the corners' shape functions at rest: n + 1 rows of n each (1 / mesh unit)

  std::size_t count() const { return volumes.size(); }
  std::span<const ElementId> corners_of(std::size_t simplex) const {
    const auto width = static_cast<std::size_t>(dimension) + 1;
    return std::span(corners).subspan(simplex * width, width);
  }
  /// A corner's gradient in column i of (n x (n + 1)).
  Eigen::Map<const Eigen::MatrixXd> gradients_of(std::size_t simplex) const {
    const Eigen::Index width = dimension + 1;
    return {gradients.data() + static_cast<Eigen::Index>(simplex) * width * dimension, dimension, width};
  }
};

/// The cells of an object that no cut goes through: its tetrahedra and hexahedra, its faces in a plane, its links on a
/// line; where a grid or a block has links alone, its squares and cubes. A hexahedron is parted into six tetrahedra
/// about its lowest corner, so that neighbours agree on the diagonals (Dompierre et al. 1999).
///
/// Throws Error, naming the corners, for a cell that is flat or the other way round than the others, and where no cell
/// is left; Cancelled.
Simplices build_simplices(const Mesh& mesh, const Cuts& cuts, const Progress& progress = {});

/// Throws Error, naming it, for a part, over the cells, whose pins leave it free to move as a rigid body.
void check_held(const Simplices& simplices, const Mesh& mesh, std::span<const ElementId> pins);

}  // namespace chainmail
