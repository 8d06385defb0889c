#include "elastic/response.h"

#include <algorithm>
#include <utility>

#include "elastic/simplices.h"

namespace chainmail {
namespace {

// The factors of the columns of a handle: its translation, the entries of its turn column by column, and 1.
using Factors = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 13, 1>;

}  // namespace

LinearResponse::LinearResponse(const ElasticProblem& problem)
    : dimension_(problem.mesh->space_dimension), base_(problem.mesh->rest.size(), 0.0), displacements_(base_) {
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

void LinearResponse::hold(const ElasticHandle& handle, const Progress& progress) {
  if (response_.size() == 0 || !(handle == handle_)) {
    response_.resize(0, 0);
    response_ = respond(handle.elements, columns(handle), progress);
    handle_ = handle;
  }
}

Eigen::MatrixXd LinearResponse::columns(const ElasticHandle& handle) const {
  const Eigen::Index n = dimension_, count = static_cast<Eigen::Index>(handle.elements.size());
  if (count == 1) {
    return Eigen::MatrixXd::Identity(n, n);
  }
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n * count, n + n * n + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index at = n * handle.elements[static_cast<std::size_t>(i)];
    columns.block(n * i, 0, n, n).setIdentity();
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto from = static_cast<std::size_t>(n * i + k);
      columns.block(n * i, n + n * k, n, n).diagonal().setConstant(handle.arms[from]);
      columns(n * i + k, n + n * n) = handle.displacements[from] - base_[static_cast<std::size_t>(at + k)];
    }
  }
  return columns.rightCols<1>().isZero(0) ? Eigen::MatrixXd(columns.leftCols(n + n * n)) : columns;
}

void LinearResponse::move(const ElasticMotion& motion, const Progress& /*progress*/) {
  const Eigen::Index n = dimension_;
  Eigen::Map<Eigen::VectorXd> all(displacements_.data(), static_cast<Eigen::Index>(displacements_.size()));
  const Eigen::Map<const Eigen::VectorXd> base(base_.data(), all.size());
  all = base;
  if (handle_.elements.size() == 1) {
    const SmallVector displacement = motion.translation - base.segment(n * handle_.elements[0], n);
    all.noalias() += response_ * displacement;
    return;
  }
  Factors factors = Factors::Ones(response_.cols());
  factors.head(n) = motion.translation;
  factors.segment(n, n * n) = motion.turn.reshaped();
  all.noalias() += response_ * factors;
  for (std::size_t i = 0; i < handle_.elements.size(); ++i) {
    all.segment(n * handle_.elements[i], n) = displacement_of(handle_, i, motion);  // exact, without rounding
  }
}

void LinearResponse::reset() { displacements_ = base_; }

}  // namespace chainmail
