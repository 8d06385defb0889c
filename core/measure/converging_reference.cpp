#include "measure/converging_reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "elastic/simplices.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/refine.h"

namespace chainmail {
namespace {

constexpr double growth_of_time = 12;  // of a level over the one before: eight times the cells, and more fill

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Returns the finite elements of an object without its cut cells, as a mesh with the same elements.
MeshPointer cells_of(const Mesh& mesh, const Cuts& cuts) {
  const Simplices simplices = build_simplices(mesh, cuts);
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(mesh.rest_position(e));
  }
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    const auto corners = simplices.corners_of(s);
    if (simplices.dimension == 1) {
      parts.links.push_back({corners[0], corners[1]});
    } else if (simplices.dimension == 2) {
      parts.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
      parts.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
    }
  }
  add_links_along_edges(parts);
  parts.space_dimension = mesh.space_dimension;
  return build_mesh(std::move(parts));
}

/// RMS of the difference of the first values, over the RMS of the first values of `finer`.
double change_between(const std::vector<double>& finer, const std::vector<double>& coarser, std::size_t count) {
  double apart = 0, all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    apart += (finer[i] - coarser[i]) * (finer[i] - coarser[i]);
    all += finer[i] * finer[i];
  }
  return all > 0 ? std::sqrt(apart / all) : 0;
}

}  // namespace

std::vector<ElementId> elements_in(const Mesh& mesh, const Patch& patch, const std::vector<ElementId>& excluded) {
  std::vector<ElementId> elements;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if ((mesh.rest_position(e) - patch.centre).norm() <= patch.radius * (1 + 1e-9) &&
        !std::ranges::binary_search(excluded, e)) {
      elements.push_back(e);
    }
  }
  return elements;
}

struct ConvergingReference::Level {
  ElasticProblem problem;
  Refinement refinement;  // of the level before; only its mesh on the first level
  std::unique_ptr<ElasticSolver> solver;
};

ConvergingReference::ConvergingReference(const ElasticProblem& problem, const ConvergingOptions& options,
                                         const Progress& progress)
    : options_(options) {
  auto level = std::make_shared<Level>();
  level->problem = problem;
  level->refinement.mesh = cells_of(*problem.mesh, problem.cuts);
  level->problem.mesh = level->refinement.mesh;
  level->problem.cuts = Cuts(level->refinement.mesh);
  level->solver = make_elastic(ElasticMethod::neo_hookean, level->problem, progress);
  levels_.push_back(std::move(level));
}

/// Throws Error if the method does not accept as many elements.
void ConvergingReference::add_level() {
  const Level& before = *levels_.back();
  auto level = std::make_shared<Level>();
  level->refinement = refine(*before.refinement.mesh);
  const MeshPointer& mesh = level->refinement.mesh;
  check(ElasticMethod::neo_hookean, *mesh);
  const ElasticProblem& coarse = before.problem;
  level->problem = {mesh, Cuts(mesh), coarse.pins, {}, coarse.options, coarse.law};
  const auto& parents = level->refinement.parents;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (std::ranges::binary_search(coarse.pins, parents[i][0]) &&
        std::ranges::binary_search(coarse.pins, parents[i][1])) {
      level->problem.pins.push_back(before.refinement.mesh->element_count() + static_cast<ElementId>(i));
    }
  }
  const int n = mesh->space_dimension;
  std::vector<double> positions(before.refinement.mesh->rest.size(), 0.0);
  for (std::size_t i = 0; i < coarse.pinned.size(); ++i) {
    positions[coarse.pins[i / std::size_t(n)] * std::size_t(n) + i % std::size_t(n)] = coarse.pinned[i];
  }
  const std::vector<double> finer = interpolated(level->refinement, positions, n);
  for (const ElementId pin : level->problem.pins) {
    level->problem.pinned.insert(level->problem.pinned.end(), finer.begin() + std::ptrdiff_t(pin) * n,
                                 finer.begin() + std::ptrdiff_t(pin + 1) * n);
  }
  level->solver = make_elastic(ElasticMethod::neo_hookean, level->problem);
  levels_.push_back(std::move(level));
}

std::vector<double> ConvergingReference::answer(Level& level, const Patch& handle, const Point& way,
                                                const Progress& progress) {
  const Mesh& mesh = *level.refinement.mesh;
  const std::vector<ElementId> elements = elements_in(mesh, handle, level.problem.pins);
  if (elements.empty()) {
    throw Error("handle", "no free element is within its radius", "use a larger radius, or another element");
  }
  std::vector<double> displacement;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    displacement.push_back(way[mesh.axes[std::size_t(k)]]);
  }
  const std::vector<double> none(elements.size() * displacement.size(), 0.0);
  ElasticSolver& solver = *level.solver;
  solver.reset();
  solver.hold(elements.size() == 1 ? ElasticHandle::of(elements.front()) : ElasticHandle{elements, none, none});
  solver.move(ElasticMotion::by(displacement), progress);
  if (!solver.remark().empty()) {
    throw Error(label(level.problem.law) + " FEM", solver.remark(), "drag less far, or use a finer mesh");
  }
  return solver.displacements();
}

ConvergedReference ConvergingReference::at(const Patch& handle, const Point& way, const Progress& progress) {
  const double begin = now();
  const MeshPointer own = levels_.front()->refinement.mesh;
  ConvergedReference result;
  std::vector<double> last;
  double spent = 0;
  for (std::size_t level = 0; result.end.empty(); ++level) {
    const double start = now();
    try {
      if (level == levels_.size()) {
        add_level();
      }
      std::vector<double> next = answer(*levels_[level], handle, way, progress);
      result.levels.push_back({levels_[level]->refinement.mesh->element_count(), std::nullopt});
      if (level > 0) {
        result.levels.back().change = change_between(next, last, own->rest.size());
      }
      last = std::move(next);
    } catch (const Error& error) {
      if (level == 0) {
        throw;
      }
      result.end = error.problem();
      break;
    }
    spent = now() - start;
    const auto& change = result.levels.back().change;
    result.converged = change && *change < options_.change;
    if (result.converged) {
      result.end = "it has converged";
    } else if (int(level) + 1 >= options_.most_levels) {
      result.end = "there are no further levels";
    } else if (now() - begin + growth_of_time * spent > options_.seconds) {
      result.end = "its time is used up";
    }
  }
  if (const std::size_t n = result.levels.size(); n > 2 && *result.levels[n - 1].change > 0) {
    result.order = std::log2(*result.levels[n - 2].change / *result.levels[n - 1].change);
  }
  result.solution.displacements.assign(last.begin(), last.begin() + std::ptrdiff_t(own->rest.size()));
  result.solution.handle_displacement = way.norm();
  result.solution.prescribed = levels_.front()->problem.pins;
  const auto grabbed = elements_in(*own, handle, levels_.front()->problem.pins);
  result.solution.prescribed.insert(result.solution.prescribed.end(), grabbed.begin(), grabbed.end());
  return result;
}

}  // namespace chainmail
