#pragma once

#include <memory>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// The reference solution: the equilibrium of an elastic object while a handle holds one of its elements.
struct ReferenceSolution {
  /// Displacements from rest, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> displacements;
  double handle_displacement = 0;  // length of the handle's displacement from rest (mesh units), above 0
  /// The handle's element and the pins. Their positions are prescribed, whatever the method.
  std::vector<ElementId> prescribed;
};

/// Computes reference solutions by neo-Hookean finite elements in double, with the handle and the pins prescribed. They
/// are converged on the object's own cells, not under refinement of the mesh: one displaced node has no continuum
/// limit.
class ReferenceSolver {
 public:
  /// The lattice of the options does not matter. Throws Error if the object has no static answer, and Cancelled.
  explicit ReferenceSolver(const ElasticProblem& problem, const Progress& progress = {});

  /// Returns the solution with the handle's element at its target (mesh units, on the axes that exist), which must
  /// differ from its rest position. Starts from rest. Throws Error, with the load step, if Newton's method does not
  /// converge, and Cancelled.
  ReferenceSolution at(ElementId handle, const Point& target, const Progress& progress = {});

 private:
  MeshPointer mesh_;
  std::vector<ElementId> pins_;
  std::unique_ptr<ElasticSolver> solver_;
};

}  // namespace chainmail
