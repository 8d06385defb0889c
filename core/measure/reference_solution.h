#pragma once

#include <memory>
#include <vector>

#include "body/body.h"
#include "elastic/elastic.h"

namespace chainmail {

/// The reference solution: the equilibrium of an elastic object with the handle's elements held at their targets.
struct ReferenceSolution {
  /// Displacements from rest, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> displacements;
  /// Length of the largest displacement from rest of an element of the handle (mesh units), above 0.
  double handle_displacement = 0;
  /// The handle's elements and the pins. Every method gets their positions as input.
  std::vector<ElementId> prescribed;
  /// True: the relative error leaves out the prescribed elements, which may be many.
  bool only_free = false;
};

/// Computes reference solutions by finite elements in double, neo-Hookean or of the problem's law, with prescribed
/// positions of the handle and the pins. A solution is converged on the object's own cells, but not under refinement of
/// the mesh: one displaced node has no continuum limit.
class ReferenceSolver {
 public:
  /// The lattice in the options has no effect. Throws Error if the object has no static solution, and Cancelled.
  explicit ReferenceSolver(const ElasticProblem& problem, const Progress& progress = {});

  /// Returns the solution with the handle's element at its target (mesh units, on the axes that exist), which must
  /// differ from its rest position. Starts from rest. Throws Error, with the load step, if Newton's method does not
  /// converge, and Cancelled.
  ReferenceSolution at(ElementId handle, const Point& target, const Progress& progress = {});
  /// The same for a handle of elements (ascending) and their displacements from rest, space_dimension coordinates each
  /// (mesh units), not all 0.
  ReferenceSolution at(const std::vector<ElementId>& handle, const std::vector<double>& displacements,
                       const Progress& progress = {});

 private:
  MeshPointer mesh_;
  StrainLaw law_;
  std::vector<ElementId> pins_;
  std::unique_ptr<ElasticSolver> solver_;
};

/// Returns the solution with an object's pins and these elements (ids), the handle, at their current positions. Throws
/// Error if an element does not exist, is given twice or is pinned, if the handle is at rest, if nothing is pinned, and
/// as ReferenceSolver does; and Cancelled.
ReferenceSolution reference_solution(const Body& body, std::vector<ElementId> handle, const Progress& progress = {});

}  // namespace chainmail
