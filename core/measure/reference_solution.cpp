#include "measure/reference_solution.h"

#include <cmath>
#include <utility>

#include "mesh/error.h"

namespace chainmail {

ReferenceSolver::ReferenceSolver(const ElasticProblem& problem, const Progress& progress)
    : mesh_(problem.mesh), pins_(problem.pins), solver_(make_elastic(ElasticMethod::neo_hookean, problem, progress)) {}

ReferenceSolution ReferenceSolver::at(ElementId handle, const Point& target, const Progress& progress) {
  std::vector<double> displacement;
  double square = 0;
  for (int k = 0; k < mesh_->space_dimension; ++k) {
    const double rest = mesh_->rest[std::size_t{handle} * static_cast<std::size_t>(mesh_->space_dimension) + k];
    displacement.push_back(target[mesh_->axes[k]] - rest);
    square += displacement.back() * displacement.back();
  }
  solver_->reset();
  solver_->hold(handle, progress.part(0, 0.2));
  solver_->move(displacement, progress.part(0.2, 1));
  if (const std::string& remark = solver_->remark(); !remark.empty()) {
    throw Error("neo-Hookean FEM", remark, "drag less far, or use a finer mesh");
  }
  std::vector<ElementId> prescribed = pins_;
  prescribed.push_back(handle);
  return {solver_->displacements(), std::sqrt(square), std::move(prescribed)};
}

}  // namespace chainmail
