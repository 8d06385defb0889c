#include "equilibrium/multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "equilibrium/multigrid_stage.h"
#include "equilibrium/unique_ids.h"

namespace chainmail {
namespace {

/// The matrix of links, as its stage sees it.
template <class Matrix>
class LinkRows final : public LevelMatrix<Matrix::rows, Matrix::columns> {
 public:
  using Square = typename Matrix::Square;
  using Vectors = typename Matrix::Vectors;

  explicit LinkRows(const Matrix& matrix) : matrix_(matrix) {}

  std::uint32_t size() const override { return matrix_.size(); }
  BlockRow<Matrix::rows> row(std::uint32_t row) override {
    columns_.clear();
    blocks_.clear();
    matrix_.for_each_in_row(row, [&](std::uint32_t column, const Square& block) {
      columns_.push_back(column);
      blocks_.push_back(block);
    });
    return {columns_, blocks_};
  }
  void apply(const Vectors& x, Vectors& product, const SharedLoop& shared) const override {
    matrix_.apply(x, product, shared);
  }

 private:
  const Matrix& matrix_;
  std::vector<std::uint32_t> columns_;  // of one row
  std::vector<Square> blocks_;
};

/// The factors of a coarsest matrix.
class DenseFactors {
 public:
  void factor(Eigen::MatrixXd& matrix) {
    const bool is_empty = matrix.size() == 0;
    // The matrix may be singular: free parts, and aggregates of elements in a row or of fixed elements.
    matrix.diagonal().array() += is_empty ? 0 : 1e-6 * std::max(matrix.diagonal().maxCoeff(), 1e-30);
    factors_.compute(matrix);
  }
  void solve(Eigen::VectorXd& right) const {
    if (right.size() > 0) {
      right = factors_.solve(right);
    }
  }

 private:
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

/// All levels but the finest, which may be that of different matrices.
template <int Dimension, int Columns>
class CoarseLevels {
 public:
  static constexpr int modes = rigid_modes<Dimension>;
  using Coarse = CoarseMatrix<modes, Columns>;
  using Vectors = typename Coarse::Vectors;
  using Frames = std::vector<RigidFrame<Dimension>>;
  using Ids = Aggregates::Ids;

  CoarseLevels() { levels_.push_back(std::make_unique<Level>()); }
  Coarse& matrix() { return levels_.front()->matrix; }
  Vectors& right() { return levels_.front()->right; }

  /// Builds the levels below the first, whose matrix is there. `frames`: of its rows.
  void build(Frames frames, const Progress& progress) {
    std::uint32_t count = matrix().size();
    while (!is_coarsest(count)) {
      Level& last = *levels_.back();
      last.stage.build_smoother(last.matrix);
      const std::uint32_t next = last.stage.aggregate(last.matrix, std::move(frames));
      if (next == 0 || next > 0.8 * count) {
        break;
      }
      count = next;
      levels_.push_back(std::make_unique<Level>());
      last.stage.build_coarse(last.matrix, levels_.back()->matrix, progress);
      frames = last.stage.frames_of_aggregates();
    }
    factor();
    was_direct_ = is_direct_;
  }

  /// Updates what depends on changes of the first level. `frames`: of its rows.
  void update(LevelChanges changes, const Frames& frames, bool cut) {
    const Frames* all_frames = &frames;
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
      Level& level = *levels_[l];
      level.stage.append(changes.like, *all_frames);
      changes = level.stage.update(level.matrix, changes.rows, cut, levels_[l + 1]->matrix);
      all_frames = &level.stage.frames_of_aggregates();
    }
    factor();
  }

  /// True if cuts have split so many aggregates that the coarsest level cannot be solved directly any more.
  bool has_outgrown() const { return was_direct_ && !is_direct_; }

  /// Returns one cycle's approximation of the first level's matrix's inverse times its right-hand side.
  const Vectors& cycle(const SharedLoop& shared) {
    solve(0, shared);
    return levels_.front()->x;
  }

 private:
  struct Level {
    Coarse matrix;
    MultigridStage<modes, Dimension, Columns> stage;  // to the next level
    Vectors right, x;
  };

  /// A coarsest level with at most this many unknowns is solved directly. A Laplacian's other levels cost less.
  static constexpr std::uint32_t max_direct_unknowns = Columns == 1 ? 240 : 80;

  static bool is_coarsest(std::uint32_t count) { return count * modes <= max_direct_unknowns; }
  /// After cuts, the coarsest level may have grown.
  static bool can_be_factored(std::uint32_t count) { return count * modes <= 2 * max_direct_unknowns; }

  /// Factors the coarsest matrix, if it is small. Otherwise only the smoother works on it.
  void factor() {
    Level& coarsest = *levels_.back();
    is_direct_ = can_be_factored(coarsest.matrix.size());
    if (!is_direct_) {
      coarsest.stage.build_smoother(coarsest.matrix);
      return;
    }
    const Eigen::Index size = Eigen::Index{coarsest.matrix.size()} * modes;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    for (std::uint32_t row = 0; row < coarsest.matrix.size(); ++row) {
      const auto [columns, blocks] = coarsest.matrix.row(row);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        for (int k = 0; k < modes * modes; ++k) {
          const Eigen::Index i = k % modes, j = k / modes;
          dense(Eigen::Index{row} * modes + i, Eigen::Index{columns[c]} * modes + j) = blocks[c][k];
        }
      }
    }
    direct_.factor(dense);
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

  [[gnu::noinline]] void solve_directly(Level& level) {
    numbers_.resize(Eigen::Index(level.right.size()) * modes);
    level.x.resize(level.right.size());
    for (int column = 0; column < Columns; ++column) {
      for (Eigen::Index i = 0; i < numbers_.size(); ++i) {
        numbers_[i] = double(level.right[std::size_t(i / modes)](int(i % modes), column));
      }
      direct_.solve(numbers_);
      for (Eigen::Index i = 0; i < numbers_.size(); ++i) {
        level.x[std::size_t(i / modes)](int(i % modes), column) = float(numbers_[i]);
      }
    }
  }

  std::vector<std::unique_ptr<Level>> levels_;
  DenseFactors direct_;
  Eigen::VectorXd numbers_;                    // one column of the coarsest level
  bool is_direct_ = true, was_direct_ = true;  // the coarsest level is solved directly: now, after the build
};

}  // namespace

template <class Matrix>
class Multigrid<Matrix>::Levels {
 public:
  static constexpr int Dimension = Matrix::dimension;

  Levels(const Matrix& matrix, const Progress& progress) {
    LinkRows<Matrix> rows(matrix);
    // A bound of the radius for every energy of links, since |a − b|² ≤ 2|a|² + 2|b|².
    finest_.build_smoother(rows, 2);
    finest_.aggregate(rows, element_frames(matrix.mesh()));
    finest_.build_coarse(rows, coarse_.matrix(), progress);
    coarse_.build(finest_.frames_of_aggregates(), progress);
  }

  void update(const Matrix& matrix, std::span<const ElementId> rows, bool cut) {
    std::vector<std::uint32_t> changed(rows.begin(), rows.end());
    make_unique(changed);
    LinkRows<Matrix> reader(matrix);
    coarse_.update(finest_.update(reader, changed, cut, coarse_.matrix()), finest_.frames_of_aggregates(), cut);
  }

  void update_finest(const Matrix& matrix, std::span<const ElementId> rows) {
    LinkRows<Matrix> reader(matrix);
    for (const ElementId row : rows) {
      finest_.update_inverse(reader, row);
    }
  }

  bool has_outgrown() const { return coarse_.has_outgrown(); }

  void cycle(const Matrix& matrix, const Vectors& right, Vectors& x, const SharedLoop& shared) {
    const LinkRows<Matrix> rows(matrix);
    finest_.smooth(rows, right, x, true, shared);
    finest_.restrict_residual(rows, right, x, coarse_.right(), shared);
    finest_.prolong(coarse_.cycle(shared), x, shared);
    finest_.smooth(rows, right, x, false, shared);
  }

 private:
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

  MultigridStage<Matrix::rows, Dimension, Matrix::columns> finest_;
  CoarseLevels<Dimension, Matrix::columns> coarse_;
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
