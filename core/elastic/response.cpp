#include "elastic/response.h"

#include <algorithm>
#include <utility>

#include "elastic/simplices.h"

namespace chainmail {

LinearResponse::LinearResponse(const ElasticProblem& problem)
    : dimension_(problem.mesh->space_dimension),
      held_(0),
      base_(problem.mesh->rest.size(), 0.0),
      displacements_(base_) {
  const auto n = static_cast<std::size_t>(dimension_);
  for (std::size_t i = 0; i < problem.pins.size(); ++i) {
    std::copy_n(problem.pinned.begin() + static_cast<std::ptrdiff_t>(n * i), n,
                base_.begin() + static_cast<std::ptrdiff_t>(n * problem.pins[i]));
  }
  displacements_ = base_;
}

void LinearResponse::set_base(std::vector<double> displacements) {
  base_ = std::move(displacements);
  displacements_ = base_;
}

void LinearResponse::hold(ElementId element, const Progress& progress) {
  if (response_.size() == 0 || element != held_) {
    response_.resize(0, 0);
    response_ = respond(element, progress);
    held_ = element;
  }
}

void LinearResponse::move(std::span<const double> displacement, const Progress& /*progress*/) {
  const Eigen::Index at = Eigen::Index{held_} * dimension_;
  Eigen::Map<Eigen::VectorXd> all(displacements_.data(), static_cast<Eigen::Index>(displacements_.size()));
  const Eigen::Map<const Eigen::VectorXd> base(base_.data(), all.size());
  const Eigen::Map<const Eigen::VectorXd> to(displacement.data(), dimension_);
  const SmallVector way = to - base.segment(at, dimension_);
  all = base;
  all.noalias() += response_ * way;
}

void LinearResponse::reset() { displacements_ = base_; }

}  // namespace chainmail
