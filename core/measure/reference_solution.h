#pragma once

#include <memory>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// The reference solution: where an elastic object stands while a handle holds one of its elements.
struct ReferenceSolution {
  /// From rest, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> displacements;
  double hand = 0;  // how far the handle's element is from rest (mesh units), above 0
  /// The handle's element and the pins: these stand where they are prescribed, whatever the method.
  std::vector<ElementId> prescribed;
};

/// Finds it by neo-Hookean finite elements in double, with the handle and the pins prescribed. It is converged on the
/// object's own cells, not under refinement of the mesh: one displaced node has no continuum limit.
class ReferenceSolver {
 public:
  /// The options' lattice does not matter. Throws Error where the object has no static answer, and Cancelled.
  explicit ReferenceSolver(const ElasticProblem& problem, const Progress& progress = {});

  /// From rest, the hand's element to its target (mesh units; the carried axes count), which is not where it rests.
  /// Throws Error where Newton's method does not converge, with the load step, and Cancelled.
  ReferenceSolution at(ElementId hand, const Point& target, const Progress& progress = {});

 private:
  MeshPointer mesh_;
  std::vector<ElementId> pins_;
  std::unique_ptr<ElasticSolver> solver_;
};

}  // namespace chainmail
