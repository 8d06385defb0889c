#pragma once

#include <memory>
#include <vector>

#include "elastic/cell_edges.h"
#include "elastic/elastic.h"

namespace chainmail {

/// A local/global energy (Sorkine and Alexa 2007; Bouaziz et al. 2014). With the vector d of an edge and its vector r
/// at rest, it is
///
///     ½ Σ over groups  min over rotations R  Σ over their edges  w |d − R r|²   +   ½ Σ over springs  k (|d| − |r|)²
///
/// Its iterations choose the rotations and the directions of the springs for given positions, and then the positions
/// for these by one solution with a matrix that never changes.
struct LocalGlobalEnergy {
  Simplices cells;  // whose elements move
  std::vector<WeightedEdge> edges;
  std::vector<std::size_t> group_ends;  // of each group, among `edges`
  std::vector<WeightedEdge> springs;
};

/// Makes a solver that stops once a step is below a small share of the mean edge length, or after `iterations`.
std::unique_ptr<ElasticSolver> make_local_global(const char* name, const ElasticProblem& problem,
                                                 LocalGlobalEnergy energy, std::uint32_t iterations,
                                                 const Progress& progress);

}  // namespace chainmail
