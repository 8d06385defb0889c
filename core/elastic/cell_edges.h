#pragma once

#include <span>
#include <vector>

#include "elastic/simplices.h"

namespace chainmail {

/// Returns the cells of an object for methods that work on edges: the simplices of linear FEM, or the uncut faces of a
/// surface in space, as triangles of thickness 1 with their gradients in their own planes. Throws as build_simplices.
Simplices build_edge_cells(const Mesh& mesh, const Cuts& cuts, const Progress& progress = {});

/// An edge with a weight.
struct WeightedEdge {
  ElementId from = 0, to = 0;
  double weight = 0;
};

/// Returns the edges of each cell in turn, (n + 1) n / 2 each, with their share −V ∇φi · ∇φj of its Laplacian: for a
/// triangle half the cotangent of the opposite angle (Pinkall and Polthier 1993), for a tetrahedron a sixth of the
/// opposite edge's length times the cotangent of the angle there.
std::vector<WeightedEdge> edges_by_cell(const Simplices& cells);
/// Returns each edge of the cells once, with `from` below `to`, ascending. Its weight is the sum of those of its cells.
std::vector<WeightedEdge> sum_of_edges(std::vector<WeightedEdge> edges);

/// The springs that stand for the cells. The stiffness of each is the sum of the volumes of its cells, over the square
/// of its rest length, times `modulus` (Van Gelder 1998).
std::vector<WeightedEdge> springs_of(const Simplices& cells, const Mesh& mesh, double modulus);
/// Returns the modulus with which springs of all directions have this shear modulus. Averaged over the directions,
/// their first Lamé parameter is then the same (Cauchy's relation). On a line it is twice the number, as Young's
/// modulus is.
double spring_modulus(double shear, int dimension);

/// Returns the mean length of edges at rest (mesh units).
double mean_length(std::span<const WeightedEdge> edges, const Mesh& mesh);

}  // namespace chainmail
