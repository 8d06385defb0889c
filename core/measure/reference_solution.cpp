#include "measure/reference_solution.h"

#include <cmath>
#include <utility>

#include "mesh/error.h"

namespace chainmail {

ReferenceSolver::ReferenceSolver(const ElasticProblem& problem, const Progress& progress)
    : mesh_(problem.mesh), pins_(problem.pins), solver_(make_elastic(ElasticMethod::neo_hookean, problem, progress)) {}

ReferenceSolution ReferenceSolver::at(ElementId hand, const Point& target, const Progress& progress) {
  std::vector<double> displacement;
  double square = 0;
  for (int k = 0; k < mesh_->space_dimension; ++k) {
    const double rest = mesh_->rest[std::size_t{hand} * static_cast<std::size_t>(mesh_->space_dimension) + k];
    displacement.push_back(target[mesh_->axes[k]] - rest);
    square += displacement.back() * displacement.back();
  }
  solver_->reset();
  solver_->hold(hand, progress.part(0, 0.2));
  solver_->move(displacement, progress.part(0.2, 1));
  if (const std::string& remark = solver_->remark(); !remark.empty()) {
    throw Error("neo-Hookean FEM", remark, "drag less far, or use a finer mesh");
  }
  std::vector<ElementId> prescribed = pins_;
  prescribed.push_back(hand);
  return {solver_->displacements(), std::sqrt(square), std::move(prescribed)};
}

}  // namespace chainmail
