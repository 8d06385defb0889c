#include "equilibrium/multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "equilibrium/multigrid_stage.h"

namespace chainmail {
namespace {

/// A coarsest level with at most this many unknowns is solved directly. A Laplacian's other levels cost less.
template <class Matrix>
constexpr std::uint32_t max_direct_unknowns = Matrix::columns == 1 ? 240 : 80;

}  // namespace

template <class Matrix>
class Multigrid<Matrix>::Levels {
 public:
  static constexpr int Dimension = Matrix::dimension, modes = rigid_modes<Dimension>, columns = Matrix::columns;
  using Coarse = CoarseMatrix<modes, columns>;

  Levels(const Matrix& matrix, const Progress& progress) {
    finest_.build_smoother(matrix);
    progress.report(0);
    std::uint32_t count = finest_.aggregate(matrix, element_frames(matrix.mesh()));
    add_level(finest_, matrix, progress);
    while (!is_coarsest(count)) {
      Level& last = *levels_.back();
      last.stage.build_smoother(last.matrix);
      const std::uint32_t next = last.stage.aggregate(last.matrix, frames_);
      if (next == 0 || next > 0.8 * count) {
        break;
      }
      count = next;
      add_level(last.stage, last.matrix, progress);
    }
    factor();
    was_direct_ = is_direct_;
  }

  void update(const Matrix& matrix, std::span<const ElementId> rows, bool cut) {
    std::vector<std::uint32_t> changed(rows.begin(), rows.end());
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    auto [next, like] = finest_.update(matrix, changed, cut, levels_.front()->matrix);
    const std::vector<RigidFrame<Dimension>>* frames = &finest_.frames_of_aggregates();
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      Level& level = *levels_[l];
      level.stage.append(like, *frames);
      auto changes = level.stage.update(level.matrix, next, cut, levels_[l + 1]->matrix);
      next = std::move(changes.rows);
      like = std::move(changes.like);
      frames = &level.stage.frames_of_aggregates();
    }
    factor();
  }

  void update_finest(const Matrix& matrix, std::span<const ElementId> rows) {
    for (const ElementId row : rows) {
      finest_.update_inverse(matrix, row);
    }
  }

  /// True if cuts have split so many aggregates that the coarsest level cannot be solved directly any more.
  bool has_outgrown() const { return was_direct_ && !is_direct_; }

  void cycle(const Matrix& matrix, const Vectors& right, Vectors& x, const SharedLoop& shared) {
    finest_.smooth(matrix, right, x, true, shared);
    finest_.restrict_residual(matrix, right, x, levels_.front()->right, shared);
    solve(0, shared);
    finest_.prolong(levels_.front()->x, x, shared);
    finest_.smooth(matrix, right, x, false, shared);
  }

 private:
  struct Level {
    Coarse matrix;
    MultigridStage<modes, Dimension, columns> stage;  // to the next level
    typename Coarse::Vectors right, x;
  };

  static bool is_coarsest(std::uint32_t count) { return count * modes <= max_direct_unknowns<Matrix>; }
  /// After cuts, the coarsest level may have grown.
  static bool can_be_factored(std::uint32_t count) { return count * modes <= 2 * max_direct_unknowns<Matrix>; }

  static std::vector<RigidFrame<Dimension>> element_frames(const Mesh& mesh) {
    std::vector<RigidFrame<Dimension>> frames(mesh.element_count());
    const double length = mesh.mean_link_length > 0 ? mesh.mean_link_length : 1;
    for (ElementId e = 0; Dimension == mesh.space_dimension && e < frames.size(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        const double from_corner =
            mesh.rest[std::size_t{e} * Dimension + std::size_t(k)] - mesh.box[0][mesh.axes[std::size_t(k)]];
        frames[e].centre[k] = float(from_corner / length);
      }
    }
    return frames;
  }

  template <class Finer, class FinerMatrix>
  void add_level(Finer& finer, const FinerMatrix& matrix, const Progress& progress) {
    levels_.push_back(std::make_unique<Level>());
    finer.build_coarse(matrix, levels_.back()->matrix, progress);
    frames_ = finer.frames_of_aggregates();
  }

  /// Factors the coarsest matrix, if it is small. Otherwise only the smoother works on it.
  void factor() {
    const Coarse& coarsest = levels_.back()->matrix;
    is_direct_ = can_be_factored(coarsest.size());
    if (!is_direct_) {
      levels_.back()->stage.build_smoother(coarsest);
      return;
    }
    const Eigen::Index size = Eigen::Index{coarsest.size()} * modes;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    for (std::uint32_t row = 0; row < coarsest.size(); ++row) {
      coarsest.for_each_in_row(row, [&](std::uint32_t column, const typename Coarse::Square& block) {
        for (int i = 0; i < modes; ++i) {
          for (int j = 0; j < modes; ++j) {
            dense(Eigen::Index{row} * modes + i, Eigen::Index{column} * modes + j) = block(i, j);
          }
        }
      });
    }
    // The matrix may be singular: free parts, and aggregates of elements in a row or of fixed elements.
    dense.diagonal().array() += size == 0 ? 0 : 1e-6 * std::max(dense.diagonal().maxCoeff(), 1e-30);
    direct_.compute(dense);
  }

  void solve(std::size_t l, const SharedLoop& shared) {
    Level& level = *levels_[l];
    if (l + 1 == levels_.size()) {
      is_direct_ ? solve_directly(level) : level.stage.smooth(level.matrix, level.right, level.x, true, shared);
      return;
    }
    level.stage.smooth(level.matrix, level.right, level.x, true, shared);
    level.stage.restrict_residual(level.matrix, level.right, level.x, levels_[l + 1]->right, shared);
    solve(l + 1, shared);
    level.stage.prolong(levels_[l + 1]->x, level.x, shared);
    level.stage.smooth(level.matrix, level.right, level.x, false, shared);
  }

  void solve_directly(Level& level) {
    const Eigen::Index size = Eigen::Index(level.right.size()) * modes;
    level.x.resize(level.right.size());
    Eigen::MatrixXd numbers(size, Eigen::Index{columns});
    const auto for_each = [&](auto visit) {
      for (Eigen::Index i = 0; i < size; ++i) {
        for (int k = 0; k < columns; ++k) {
          visit(std::size_t(i / modes), int(i % modes), k, numbers(i, k));
        }
      }
    };
    for_each([&](std::size_t row, int i, int k, double& number) { number = double(level.right[row](i, k)); });
    if (size > 0) {
      numbers = direct_.solve(numbers);
    }
    for_each([&](std::size_t row, int i, int k, double number) { level.x[row](i, k) = float(number); });
  }

  MultigridStage<Matrix::rows, Dimension, columns> finest_;
  std::vector<std::unique_ptr<Level>> levels_;  // all but the finest
  std::vector<RigidFrame<Dimension>> frames_;   // of the last level, while levels are built
  Eigen::LDLT<Eigen::MatrixXd> direct_;
  bool is_direct_ = true, was_direct_ = true;  // the coarsest level is solved directly: now, after the build
};

template <class Matrix>
Multigrid<Matrix>::Multigrid() = default;
template <class Matrix>
Multigrid<Matrix>::Multigrid(Multigrid&&) noexcept = default;
template <class Matrix>
Multigrid<Matrix>& Multigrid<Matrix>::operator=(Multigrid&&) noexcept = default;
template <class Matrix>
Multigrid<Matrix>::~Multigrid() = default;

template <class Matrix>
void Multigrid<Matrix>::build(const Matrix& matrix, const Progress& progress) {
  // Aggregates do not depend on what is fixed: another handle or pin changes little then.
  Matrix bare = matrix;
  std::vector<ElementId> rows;
  for (ElementId e = 0; e < matrix.size(); ++e) {
    if (matrix.is_fixed(e)) {
      bare.set_fixed(e, false);
      const auto neighbours = matrix.mesh().neighbours_of(e);
      rows.insert(rows.end(), neighbours.begin(), neighbours.end());
      rows.push_back(e);
    }
  }
  auto levels = std::make_unique<Levels>(bare, progress);
  levels->update(matrix, rows, false);
  levels_ = std::move(levels);
}

template <class Matrix>
void Multigrid<Matrix>::update(const Matrix& matrix, std::span<const ElementId> rows, bool cut) {
  levels_->update(matrix, rows, cut);
  if (levels_->has_outgrown()) {
    build(matrix);
  }
}

template <class Matrix>
void Multigrid<Matrix>::update_finest(const Matrix& matrix, std::span<const ElementId> rows) {
  levels_->update_finest(matrix, rows);
}

template <class Matrix>
void Multigrid<Matrix>::cycle(const Matrix& matrix, const Vectors& right, Vectors& solution, const SharedLoop& shared) {
  levels_->cycle(matrix, right, solution, shared);
}

template class Multigrid<LinkMatrix<float, 1>>;
template class Multigrid<LinkMatrix<float, 2>>;
template class Multigrid<LinkMatrix<float, 3>>;
template class Multigrid<LinkLaplacian<1>>;
template class Multigrid<LinkLaplacian<2>>;
template class Multigrid<LinkLaplacian<4>>;

}  // namespace chainmail
