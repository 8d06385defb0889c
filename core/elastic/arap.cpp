#include <algorithm>

#include "elastic/local_global.h"
#include "elastic/methods.h"

namespace chainmail {
namespace {

/// Returns the edges about each element, as groups. Each cotangent counts as 0 if it is negative, as in CGAL's
/// Surface_mesh_deformation: negative weights would let an element run away.
void group_spokes(LocalGlobalEnergy& energy) {
  std::vector<WeightedEdge> edges = edges_by_cell(energy.cells);
  for (WeightedEdge& edge : edges) {
    edge.weight = std::max(edge.weight, 0.0);
  }
  std::vector<WeightedEdge> spokes;
  for (const WeightedEdge& edge : sum_of_edges(std::move(edges))) {
    if (edge.weight > 0) {
      spokes.push_back(edge);
      spokes.push_back({edge.to, edge.from, edge.weight});
    }
  }
  std::ranges::stable_sort(spokes, {}, &WeightedEdge::from);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    if (i + 1 == spokes.size() || spokes[i + 1].from != spokes[i].from) {
      energy.group_ends.push_back(i + 1);
    }
  }
  energy.edges = std::move(spokes);
}

}  // namespace

/// As-rigid-as-possible deformation (Sorkine and Alexa 2007): on sheets and surfaces, the edges about each element turn
/// together, with cotangent weights. In solids, the edges of each tetrahedron do (Chao et al. 2010): with weights of
/// either sign, groups about elements could lose energy without bound. The material has no effect.
std::unique_ptr<ElasticSolver> make_arap(const ElasticProblem& problem, const Progress& progress) {
  LocalGlobalEnergy energy;
  energy.cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.1));
  if (energy.cells.dimension == 3) {
    energy.edges = edges_by_cell(energy.cells);
    for (std::size_t end = 6; end <= energy.edges.size(); end += 6) {
      energy.group_ends.push_back(end);
    }
  } else {
    group_spokes(energy);
  }
  return make_local_global("ARAP", problem, std::move(energy), problem.options.iterations, progress.part(0.1, 1));
}

}  // namespace chainmail
