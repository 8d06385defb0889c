#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
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
/// Their order depends on the ids of their corners alone, so that no answer depends on the order of the cells in a
/// file. XPBD meets them in turn, and would come to another answer in another order.
///
/// Throws Error, with the corners, for a cell that is flat or oriented differently from the others, and if no cell is
/// left. Throws Cancelled.
Simplices build_simplices(const Mesh& mesh, const Cuts& cuts, const Progress& progress = {});

/// Puts simplices, `width` corners each, into a scattered order that depends on the ids of their corners alone. The
/// corners of each keep their order. In ascending order, neighbours follow each other, and sweeps of XPBD over a large
/// solid do not converge in 2,000 iterations where scattered ones do.
void sort_simplices(std::vector<ElementId>& corners, std::size_t width);

/// The simplices of all cells, cut or not, and the links that each cell needs: without one of these, the cell is gone.
struct CellSimplices {
  Simplices simplices;                    // of a flat cell: volumes and gradients of 0
  std::vector<std::uint32_t> cell_of;     // of each simplex, ascending
  std::vector<std::uint32_t> first_link;  // of each cell, and the end: places in `links`
  std::vector<LinkId> links;

  std::size_t cell_count() const { return first_link.size() - 1; }
  std::span<const LinkId> links_of(std::size_t cell) const {
    return std::span(links).subspan(first_link[cell], first_link[cell + 1] - first_link[cell]);
  }
};
/// Returns true if a simplex of this dimension is flat, from its volume and the longest edge at its first corner: its
/// shape functions have then lost half the digits of a double.
bool is_flat(double volume, double longest, int dimension);
/// Returns true if a mesh has cells of its space's dimension: faces or squares in a plane, cells or cubes in space.
bool has_solid_cells(const Mesh& mesh);
/// The same division as build_simplices, in the order of the mesh. Flat cells and any orientation are accepted. Throws
/// Cancelled.
CellSimplices build_cell_simplices(const Mesh& mesh, const Progress& progress = {});

/// Throws Error if the pins of a part leave it free to move as a rigid body. A part is a set of cells that share
/// elements; the message names one of its elements.
void check_held(const Simplices& simplices, const Mesh& mesh, std::span<const ElementId> pins);

/// Throws Error if an object has no pins.
void check_pinned(const Mesh& mesh, std::span<const ElementId> pins);
/// Throws Error, with an element of the part, if the pins of a part leave it free to move as a rigid body.
void check_part_held(const Mesh& mesh, ElementId part, const std::vector<ElementId>& pins);

}  // namespace chainmail
