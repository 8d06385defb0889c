#pragma once

#include <memory>
#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// Where an elastic object stands while a hand holds one of its elements: what errors are measured against.
struct Truth {
  /// From rest, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> displacements;
  double hand = 0;  // how far the hand's element is from rest (mesh units), above 0
};

/// Finds it by neo-Hookean finite elements in double, with the hand and the pins prescribed.
class TruthSolver {
 public:
  /// The options' lattice does not matter. Throws Error where the object has no static answer, and Cancelled.
  explicit TruthSolver(const ElasticProblem& problem, const Progress& progress = {});

  /// From rest, the hand's element to its target (mesh units; the carried axes count), which is not where it rests.
  /// Throws Error where Newton's method does not converge, with the load step, and Cancelled.
  Truth at(ElementId hand, const Point& target, const Progress& progress = {});

 private:
  MeshPointer mesh_;
  std::unique_ptr<ElasticSolver> solver_;
};

}  // namespace chainmail
