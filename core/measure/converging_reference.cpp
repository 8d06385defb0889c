#include "measure/converging_reference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "elastic/elimination.h"
#include "elastic/methods.h"
#include "elastic/nonlinear_fem.h"
#include "elastic/simplices.h"
#include "elastic/stiffening.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/refine.h"
#include "solver/algorithms.h"
#include "solver/elastic_deformation.h"

namespace chainmail {
namespace {

constexpr double growth_of_time = 12;  // of a level over the one before: eight times the cells, and more fill
constexpr double largest_turn = 0.25;  // of the handle in one load step (radians)

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

/// Returns elements of the level before and the new ones between two of them: those in the cells, faces and edges that
/// have no other corner.
std::vector<ElementId> with_middles(const std::vector<ElementId>& elements, const Refinement& refinement) {
  const auto first = refinement.mesh->element_count() - static_cast<ElementId>(refinement.parents.size());
  const auto has = [&](ElementId e) { return std::ranges::binary_search(elements, e); };
  std::vector<ElementId> all = elements;
  for (std::size_t i = 0; i < refinement.parents.size(); ++i) {
    if (has(refinement.parents[i][0]) && has(refinement.parents[i][1])) {
      all.push_back(first + static_cast<ElementId>(i));
    }
  }
  return all;
}

void add_pins(ElasticProblem& problem, const ElasticProblem& before, const Refinement& refinement) {
  const auto n = static_cast<std::size_t>(problem.mesh->space_dimension);
  std::vector<double> displacements(before.mesh->rest.size(), 0.0);
  for (std::size_t i = 0; i < before.pinned.size(); ++i) {
    displacements[before.pins[i / n] * n + i % n] = before.pinned[i];
  }
  problem.pins = with_middles(before.pins, refinement);
  const std::vector<double> finer = interpolated(refinement, displacements, problem.mesh->space_dimension);
  for (const ElementId pin : problem.pins) {
    const auto at = finer.begin() + static_cast<std::ptrdiff_t>(pin * n);
    problem.pinned.insert(problem.pinned.end(), at, at + static_cast<std::ptrdiff_t>(n));
  }
}

/// Returns a handle of elements at rest, with their arms from the mean of their positions.
ElasticHandle handle_about_middle(const Mesh& mesh, const std::vector<ElementId>& elements) {
  const Point middle = middle_of(mesh, elements);
  ElasticHandle handle{elements, {}, {}};
  for (const ElementId element : elements) {
    const Point arm = mesh.rest_position(element) - middle;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      handle.arms.push_back(arm[mesh.axes[std::size_t(k)]]);
    }
  }
  handle.displacements.assign(handle.arms.size(), 0.0);
  return handle;
}

/// Returns the rotation vector of a motion.
Point rotation_of(const RigidMotion& motion) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion.turn + Eigen::Matrix3d::Identity()));
  return turn.angle() * turn.axis();
}

/// The limit of the method is for people who wait. Where every level is asked for, however long it takes, that of the
/// options holds.
std::unique_ptr<ElasticSolver> solver_of_own_cells(const ElasticProblem& problem, const ConvergingOptions& options,
                                                   const Progress& progress) {
  const Mesh& mesh = *problem.mesh;
  const std::uint64_t usual = max_solid_elements(Algorithm::neo_hookean).value_or(0);
  if (options.every_level && mesh.has_cells() && mesh.element_count() > usual &&
      mesh.element_count() <= options.max_elements.back()) {
    check(problem.options);
    return make_neo_hookean(problem, progress);
  }
  return make_elastic(Algorithm::neo_hookean, problem, progress);
}

}  // namespace

Point middle_of(const Mesh& mesh, const std::vector<ElementId>& elements) {
  Point middle = Point::Zero();
  for (const ElementId element : elements) {
    middle += mesh.rest_position(element) / double(elements.size());
  }
  return middle;
}

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

/// The finite elements of one level, with the matrix of the last handle.
struct ConvergingReference::Level {
  ElasticProblem problem;
  Refinement refinement;  // of the level before; only its mesh on the first level
  Simplices simplices;
  std::vector<ElementId> order;           // of the unknowns
  std::vector<ElementId> handle;          // of `newton`
  std::unique_ptr<Newton> newton;         // not on the first level
  std::unique_ptr<ElasticSolver> solver;  // only on the first level: goes to the answer in load steps
};

ConvergingReference::ConvergingReference(const ElasticProblem& problem, const ConvergingOptions& options,
                                         const Progress& progress)
    : options_(options) {
  auto level = std::make_shared<Level>();
  level->problem = problem;
  level->refinement.mesh = cells_of(*problem.mesh, problem.cuts);
  level->problem.mesh = level->refinement.mesh;
  level->problem.cuts = Cuts(level->refinement.mesh);
  level->solver = solver_of_own_cells(level->problem, options, progress);
  levels_.push_back(std::move(level));
}

/// Throws Error if there would be too many elements.
void ConvergingReference::add_level() {
  const Level& before = *levels_.back();
  const Mesh& coarse = *before.refinement.mesh;
  const std::uint64_t count = std::uint64_t{coarse.element_count()} + coarse.link_count();
  const std::uint64_t most = options_.max_elements[static_cast<std::size_t>(coarse.space_dimension)];
  if (count > most) {
    throw Error("reference solution",
                "the next level has " + std::to_string(count) + " elements, more than " + std::to_string(most),
                "use a coarser mesh");
  }
  auto level = std::make_shared<Level>();
  level->refinement = refine(coarse);
  const MeshPointer& mesh = level->refinement.mesh;
  level->problem = {mesh, Cuts(mesh), {}, {}, before.problem.options};
  add_pins(level->problem, before.problem, level->refinement);
  level->simplices = build_simplices(*mesh, level->problem.cuts);
  level->order = elimination_order(level->simplices, *mesh);
  levels_.push_back(std::move(level));
}

std::vector<double> ConvergingReference::from_rest(Level& level, const std::vector<ElementId>& elements,
                                                   const RigidMotion& motion, const Progress& progress) {
  const Mesh& mesh = *level.refinement.mesh;
  ElasticSolver& solver = *level.solver;
  solver.reset();
  solver.hold(elements.size() == 1 ? ElasticHandle::of(elements.front()) : handle_about_middle(mesh, elements));
  const Point rotation = rotation_of(motion);
  const int steps = std::max(1, int(std::ceil(rotation.norm() / largest_turn)));
  for (int step = 1; step <= steps; ++step) {
    const double share = double(step) / steps;
    const RigidMotion part =
        step == steps ? motion : RigidMotion{turn_of(share * rotation), share * motion.translation};
    solver.move(elastic_motion(mesh, part), progress.part(double(step - 1) / steps, share));
    if (!solver.remark().empty()) {
      throw Error(label(level.problem.options.law) + " FEM", solver.remark(), "drag less far, or use a finer mesh");
    }
  }
  return solver.displacements();
}

/// Newton's method from the interpolated answer of the level before, which is close. The handle is there already.
std::vector<double> ConvergingReference::from_start(Level& level, const std::vector<ElementId>& elements,
                                                    std::vector<double> displacements, const Progress& progress) {
  if (!level.newton || level.handle != elements) {
    std::vector<ElementId> prescribed = level.problem.pins;
    prescribed.insert(prescribed.end(), elements.begin(), elements.end());
    level.newton = std::make_unique<Newton>(level.simplices, lame(level.problem.options.material),
                                            level.refinement.mesh->element_count(), level.order, prescribed,
                                            model_of(level.problem.options.law));
    level.handle = elements;
  }
  if (!level.newton->solve(displacements, std::vector<double>(displacements.size(), 0.0), progress)) {
    throw Error("reference solution", "Newton did not converge on the next level", "drag less far");
  }
  return displacements;
}

/// Decides after each level, and says why it is the last one. `expected` is when the next one would be done (s).
bool ConvergingReference::is_last(ConvergedReference& result, double expected) const {
  const auto& change = result.levels.back().change;
  result.converged = change && *change < options_.change;
  const bool is_highest = int(result.levels.size()) >= options_.max_levels;
  if (result.converged && (is_highest || !options_.every_level)) {
    result.end = "it has converged";
  } else if (is_highest) {
    result.end = "there are no further levels";
  } else if (expected > options_.seconds) {
    result.end = "its time is used up";
  }
  return !result.end.empty();
}

ConvergedReference ConvergingReference::at(const Patch& patch, const Point& displacement, const Progress& progress) {
  const Level& own = *levels_.front();
  const std::vector<ElementId> grabbed = elements_in(*own.refinement.mesh, patch, own.problem.pins);
  if (grabbed.empty()) {
    throw Error("handle", "no free element is within its radius", "use a larger radius, or another element");
  }
  return at(grabbed, {Eigen::Matrix3d::Zero(), displacement}, progress);
}

ConvergedReference ConvergingReference::at(const std::vector<ElementId>& grabbed, const RigidMotion& motion,
                                           const Progress& progress) {
  const double begin = now();
  const MeshPointer own = levels_.front()->refinement.mesh;
  const std::vector<ElementId>& pins = levels_.front()->problem.pins;
  ConvergedReference result;
  std::vector<ElementId> handle = grabbed;
  std::vector<double> last = from_rest(*levels_.front(), handle, motion, progress);
  result.levels.push_back({own->element_count(), std::nullopt});
  double spent = now() - begin;
  for (std::size_t level = 1; !is_last(result, now() - begin + growth_of_time * spent); ++level) {
    const double start = now();
    try {
      if (level == levels_.size()) {
        add_level();
      }
      const Refinement& refinement = levels_[level]->refinement;
      handle = with_middles(handle, refinement);
      std::vector<double> next =
          from_start(*levels_[level], handle, interpolated(refinement, last, own->space_dimension), progress);
      result.levels.push_back({refinement.mesh->element_count(), change_between(next, last, own->rest.size())});
      last = std::move(next);
    } catch (const Error& error) {
      result.end = error.problem();
      break;
    }
    spent = now() - start;
  }
  if (const std::size_t n = result.levels.size(); n > 2 && *result.levels[n - 1].change > 0) {
    result.order = std::log2(*result.levels[n - 2].change / *result.levels[n - 1].change);
  }
  result.solution.displacements.assign(last.begin(), last.begin() + std::ptrdiff_t(own->rest.size()));
  const Point middle = middle_of(*own, grabbed);
  for (const ElementId element : grabbed) {
    const double displacement = motion.of(own->rest_position(element) - middle).norm();
    result.solution.handle_displacement = std::max(result.solution.handle_displacement, displacement);
  }
  result.solution.only_free = true;
  result.solution.prescribed = pins;
  result.solution.prescribed.insert(result.solution.prescribed.end(), grabbed.begin(), grabbed.end());
  return result;
}

}  // namespace chainmail
