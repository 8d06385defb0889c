#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "equilibrium/block_vectors.h"
#include "equilibrium/multigrid.h"

namespace chainmail {

/// A matrix in float with its multigrid, both brought up to date when they are used.
template <int D>
class Preconditioner {
 public:
  using Matrix = LinkMatrix<double, D>;
  using Vectors = typename Matrix::Vectors;

  void reset() { *this = Preconditioner(); }
  /// Notes that the blocks in these rows, or whether they are fixed, have changed. `cut`: because links were cut.
  void outdate(std::span<const ElementId> rows, bool cut) {
    if (grid_.is_built()) {
      outdated_.insert(outdated_.end(), rows.begin(), rows.end());
      cut_ = cut_ || cut;
    }
    if (outdated_.size() > std::size_t{matrix_.size()}) {
      reset();  // it is built anew when it is needed
    }
  }

  /// `change` makes the blocks of the approximated matrix from those of `matrix`. Returns true if it built a multigrid.
  template <class Change>
  bool update(const MeshPointer& mesh, const Matrix& matrix, Change change, const Progress& progress) {
    const bool builds = !grid_.is_built() || outdated_.size() > matrix.size() / 4;
    if (builds) {
      build(mesh, matrix, change, progress);
    } else if (!outdated_.empty()) {
      for (const ElementId row : outdated_) {
        copy_row(matrix, row, change);
      }
      grid_.update(matrix_, outdated_, cut_);
    }
    outdated_.clear();
    cut_ = false;
    return builds;
  }

  void apply(const Vectors& right, Vectors& result, const SharedLoop& /*shared*/ = {}) {
    double largest = 0;
    for (const auto& one : right) {
      largest = std::max(largest, one.largest());
    }
    const double scale = largest > 0 ? 1 / largest : 1;
    right_.resize(right.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
      right_[i] = rounded<float>(right[i] * scale);
    }
    grid_.cycle(matrix_, right_, result_);
    result.resize(right.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
      result[i] = rounded<double>(result_[i]) / scale;
    }
  }

 private:
  static LinkBlock<float, D> in_float(const LinkBlock<double, D>& block) {
    return {rounded<float>(block.along), static_cast<float>(block.across)};
  }

  template <class Change>
  void build(const MeshPointer& mesh, const Matrix& matrix, Change change, const Progress& progress) {
    matrix_ = LinkMatrix<float, D>(mesh);
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      matrix_.set_link(link, in_float(change(matrix.link(link))));
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      matrix_.set_fixed(e, matrix.is_fixed(e));
    }
    grid_.build(matrix_, progress);
  }

  template <class Change>
  void copy_row(const Matrix& matrix, ElementId row, Change change) {
    const Mesh& mesh = matrix.mesh();
    matrix_.set_fixed(row, matrix.is_fixed(row));
    for (EntryId entry = mesh.first_entry[row]; entry < mesh.first_entry[row + 1]; ++entry) {
      matrix_.set_link(mesh.entry_link[entry], in_float(change(matrix.link(mesh.entry_link[entry]))));
    }
  }

  LinkMatrix<float, D> matrix_;
  Multigrid<LinkMatrix<float, D>> grid_;
  std::vector<ElementId> outdated_;
  bool cut_ = false;
  BlockVectors<float, D> right_, result_;
};

/// Conjugate gradients with a preconditioner, one step at a time. The iterate belongs to the caller.
template <int D>
class ConjugateGradients {
 public:
  using Matrix = LinkMatrix<double, D>;
  using Vectors = typename Matrix::Vectors;

  /// Begins with this negative gradient.
  Vectors& begin() {
    is_first_step_ = true;
    return residual_;
  }

  /// Runs a step. Returns by how much the energy decreases.
  double step(const Matrix& matrix, Preconditioner<D>& preconditioner, Vectors& x) {
    preconditioner.apply(residual_, preconditioned_);
    const double slope = dot(residual_, preconditioned_);
    if (!(slope > 0)) {
      slope_ = 0;
      return 0;
    }
    // After Polak and Ribière, which forgives a preconditioner in float.
    const double beta = is_first_step_ ? 0 : std::max(0.0, -step_ * dot(product_, preconditioned_) / slope_);
    direction_.resize(residual_.size());
    for (std::size_t i = 0; i < direction_.size(); ++i) {
      direction_[i] = is_first_step_ ? preconditioned_[i] : preconditioned_[i] + beta * direction_[i];
    }
    slope_ = slope;
    is_first_step_ = false;
    matrix.apply(direction_, product_);
    const double curvature = dot(direction_, product_), along = dot(residual_, direction_);
    if (!(curvature > 0)) {
      return 0;
    }
    step_ = along / curvature;
    const double before = dot(residual_, residual_);
    double after = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += step_ * direction_[i];
      residual_[i] -= step_ * product_[i];
      after += residual_[i].squaredNorm();
    }
    shrunk_ = before > 0 ? std::sqrt(after / before) : 0;
    return step_ * along / 2;
  }

  /// Estimates the distance of the iterate from the minimum after the last step: √(twice the energy of the distance).
  double distance() const { return std::sqrt(std::max(0.0, slope_)) * shrunk_; }

 private:
  bool is_first_step_ = true;
  double slope_ = 0, step_ = 0, shrunk_ = 1;
  Vectors residual_, preconditioned_, direction_, product_;
};

}  // namespace chainmail
