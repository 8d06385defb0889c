#include <algorithm>

#include "elastic/corotated.h"
#include "elastic/local_global.h"
#include "elastic/methods.h"

namespace chainmail {
namespace {

// Springs resist at most with this share of the shear modulus, so that the cells keep some resistance of their own.
constexpr double max_spring_fraction = 0.75;

}  // namespace

/// Projective Dynamics (Bouaziz et al. 2014) at rest: springs on the edges, and corotated cells,
///     W = μc |F − R|²  per volume.
/// Springs of all directions resist like an isotropic solid whose Lamé parameters are equal. They take the material's
/// λ, or 3/4 of its μ if that is less, and the cells the rest of μ: then the shear modulus is the material's, and so is
/// Poisson's ratio up to 0.21 in a solid. Above that, the object is more compressible than the material. The answer is
/// the minimum of the energy, and so has no time step.
std::unique_ptr<ElasticSolver> make_projective(const ElasticProblem& problem, const Progress& progress) {
  LocalGlobalEnergy energy;
  energy.cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.1));
  const int n = energy.cells.dimension;
  const Lame material = lame_of_dimension(lame(problem.options.material), n);
  const double of_springs = n == 1 ? material.mu : std::min(material.lambda, max_spring_fraction * material.mu);
  if (of_springs > 0) {
    energy.springs = springs_of(energy.cells, *problem.mesh, spring_modulus(of_springs, n));
  }
  if (n > 1) {
    energy.edges = edges_by_cell(energy.cells);
    for (WeightedEdge& edge : energy.edges) {
      edge.weight *= 2 * (material.mu - of_springs);
    }
    const auto of_cell = std::size_t(n == 3 ? 6 : 3);
    for (std::size_t end = of_cell; end <= energy.edges.size(); end += of_cell) {
      energy.group_ends.push_back(end);
    }
  }
  return make_local_global("Projective Dynamics", problem, std::move(energy), problem.options.iterations,
                           progress.part(0.1, 1));
}

}  // namespace chainmail
