#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "elastic/small.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

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
  /// Returns the gradient of each corner's shape function, one per column (n x (n + 1), 1 / mesh unit).
  Eigen::Map<const Eigen::MatrixXd> gradients_of(std::size_t simplex) const {
    const Eigen::Index width = dimension + 1;
    return {gradients.data() + static_cast<Eigen::Index>(simplex) * width * dimension, dimension, width};
  }
};

/// Makes simplices of the uncut cells of an object: tetrahedra and hexahedra in space, faces in a plane, links on a
/// line. For a grid or a block without faces or cells, these are its squares or cubes. A hexahedron is split into six
/// tetrahedra around its lowest corner, so that neighbours agree on the diagonals (Dompierre et al. 1999).
///
/// Throws Error, with the corners, for a cell that is flat or oriented differently from the others, and if no cell is
/// left. Throws Cancelled.
Simplices build_simplices(const Mesh& mesh, const Cuts& cuts, const Progress& progress = {});

/// Throws Error if the pins of a part leave it free to move as a rigid body. A part is a set of cells that share
/// elements; the message names one of its elements.
void check_held(const Simplices& simplices, const Mesh& mesh, std::span<const ElementId> pins);

}  // namespace chainmail
