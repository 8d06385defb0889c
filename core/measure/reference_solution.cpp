#include "measure/reference_solution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/handle.h"
#include "mesh/error.h"
#include "solver/algorithms.h"

namespace chainmail {

ReferenceSolver::ReferenceSolver(const ElasticProblem& problem, const Progress& progress)
    : mesh_(problem.mesh),
      law_(problem.options.law),
      pins_(problem.pins),
      solver_(make_elastic(Algorithm::neo_hookean, problem, progress)) {}

ReferenceSolution ReferenceSolver::at(ElementId handle, const Point& target, const Progress& progress) {
  std::vector<double> displacement;
  for (int k = 0; k < mesh_->space_dimension; ++k) {
    const double rest = mesh_->rest[std::size_t{handle} * static_cast<std::size_t>(mesh_->space_dimension) + k];
    displacement.push_back(target[mesh_->axes[k]] - rest);
  }
  return at({handle}, displacement, progress);
}

/// The targets are reached from rest along straight lines: the shape of the handle is what its displacements say.
ReferenceSolution ReferenceSolver::at(const std::vector<ElementId>& handle, const std::vector<double>& displacements,
                                      const Progress& progress) {
  const auto n = static_cast<std::size_t>(mesh_->space_dimension);
  double largest = 0;
  for (std::size_t i = 0; i < handle.size(); ++i) {
    double square = 0;
    for (std::size_t k = 0; k < n; ++k) {
      square += displacements[n * i + k] * displacements[n * i + k];
    }
    largest = std::max(largest, std::sqrt(square));
  }
  solver_->reset();
  const std::vector<double> none(displacements.size(), 0.0);
  const bool is_one = handle.size() == 1;
  solver_->hold(is_one ? ElasticHandle::of(handle.front()) : ElasticHandle{handle, displacements, none},
                progress.part(0, 0.2));
  solver_->move(ElasticMotion::by(is_one ? displacements : std::vector<double>(n, 0.0)), progress.part(0.2, 1));
  if (const std::string& remark = solver_->remark(); !remark.empty()) {
    throw Error(label(law_) + " FEM", remark, "drag less far, or use a finer mesh");
  }
  std::vector<ElementId> prescribed = pins_;
  prescribed.insert(prescribed.end(), handle.begin(), handle.end());
  return {solver_->displacements(), largest, std::move(prescribed)};
}

ReferenceSolution reference_solution(const Body& body, std::vector<ElementId> handle, const Progress& progress) {
  constexpr double preparation_share = 0.3;  // of the time, roughly
  const Handle grabbed(body, std::move(handle));
  const std::vector<ElementId> elements(grabbed.elements().begin(), grabbed.elements().end());
  const std::vector<double> displacements = displacements_of(body.mesh(), body.positions(), elements);
  if (std::ranges::all_of(displacements, [](double one) { return one == 0; })) {
    throw Error("handle", "it is at rest, so there is nothing to compare with", "move it first");
  }
  const auto pins = body.pins();
  if (pins.empty()) {
    throw Error("pins", "nothing pins the object, so physics has no solution", "pin a side or some elements");
  }
  ReferenceSolver solver({.mesh = body.mesh_pointer(),
                          .cuts = body.cuts(),
                          .pins = {pins.begin(), pins.end()},
                          .pinned = displacements_of(body.mesh(), body.positions(), pins),
                          .options = body.elastic()},
                         progress.part(0, preparation_share));
  return solver.at(elements, displacements, progress.part(preparation_share, 1));
}

}  // namespace chainmail
