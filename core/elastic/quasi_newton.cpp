#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "elastic/cholesky.h"
#include "elastic/elimination.h"
#include "elastic/energy.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"
#include "elastic/stiffness.h"
#include "mesh/error.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {
namespace {

/// Stable neo-Hookean finite elements (Smith et al. 2018), minimised by a quasi-Newton method whose first estimate of
/// the curvature is a Laplacian that never changes, factored once per grab (Liu et al. 2017).
///
/// The energy density is μ/2 (tr FᵀF − n) + λ'/2 ((J − α)² − (1 − α)²), with J = det F, λ' = λ + μ and α = 1 + μ/λ'. At
/// small strains it equals linear elasticity. Inverted cells have an energy too. Steps and changes of the gradient are
/// kept from move to move.
template <int N>
class QuasiNewton final : public IteratedSolver {
 public:
  QuasiNewton(const ElasticProblem& problem, const Simplices& cells, const Progress& progress)
      : IteratedSolver(problem, cells),
        elements_(problem.mesh->element_count()),
        iterations_(problem.options.iterations),
        length_(problem.mesh->mean_link_length),
        order_(elimination_order(cells, *problem.mesh, progress.part(0, 0.2))),
        gradient_(problem.mesh->rest.size()) {
    check_held(cells, *problem.mesh, problem.pins);
    const Lame material = lame_of_dimension(lame(problem.options.material), N);
    mu_ = material.mu;
    lambda_ = material.lambda + material.mu;
    alpha_ = 1 + mu_ / lambda_;
    for (std::size_t s = 0; s < cells.count(); ++s) {
      Cell cell{{}, Corners::from(cells.gradients_of(s).data()), cells.volumes[s]};
      std::ranges::copy(cells.corners_of(s), cell.corners.begin());
      cells_.push_back(cell);
    }
    find_base(progress.part(0.2, 1));
  }

 private:
  // An answer has converged if the next step is below this share of the mean link length.
  static constexpr double last_step_below = 1e-9;
  // Pairs of steps and changes of the gradient from which L-BFGS estimates the curvature.
  static constexpr std::size_t most_pairs = 6;
  // Pairs of less curvature than this, over the lengths of both, are left out.
  static constexpr double least_curvature = 1e-12;
  static constexpr int most_halvings = 12;
  // Armijo condition: the energy must fall by at least this share of what the slope predicts, but for rounding.
  static constexpr double share_of_slope = 1e-4;
  // Rounding error of the energy, as a share of the magnitude of its terms.
  static constexpr double rounding_share = 1e-15;

  using Vector = FixedMatrix<double, N>;
  using Square = FixedMatrix<double, N, N>;
  using Corners = FixedMatrix<double, N, N + 1>;
  using Unknown = Eigen::MatrixXd;  // a row of N for each element that moves
  struct Cell {
    std::array<ElementId, N + 1> corners;
    Corners gradients;  // of the shape functions
    double volume = 0;
  };
  struct Pair {
    Unknown step, change;
    double product = 0;  // sum of the products of their entries
  };

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& progress) override {
    unknowns_ = Unknowns(1, elements_, order_, prescribed);
    if (unknowns_.count() == 0) {
      return;
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const Cell& cell : cells_) {
      add_to_matrix(cell, entries);
    }
    Cholesky::Sparse matrix(unknowns_.count(), unknowns_.count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.analyze(matrix);
    if (!factor_.factor(matrix, progress)) {
      throw Error("quasi-Newton FEM", "its matrix is not positive definite: cells are too thin",
                  "mesh the object again");
    }
  }

  /// Adds the Laplacian of a cell, of modulus 2μ + λ, to the lower triangle of the matrix.
  void add_to_matrix(const Cell& cell, std::vector<Eigen::Triplet<double>>& entries) const {
    const double modulus = cell.volume * (mu_ + lambda_);
    for (int a = 0; a <= N; ++a) {
      for (int b = 0; b <= N; ++b) {
        const std::int32_t i = unknowns_.of(cell.corners[std::size_t(a)]),
                           j = unknowns_.of(cell.corners[std::size_t(b)]);
        if (i != Unknowns::none && j != Unknowns::none && i >= j) {
          entries.emplace_back(i, j, modulus * column(cell.gradients, a).dot(column(cell.gradients, b)));
        }
      }
    }
  }

  /// Returns the energy, and leaves its derivatives in gradient_ and the magnitude of its terms in magnitude_.
  double evaluate(const std::vector<double>& displacements) {
    std::ranges::fill(gradient_, 0.0);
    double sum = 0;
    magnitude_ = 0;
    for (const Cell& cell : cells_) {
      Corners at;
      for (int k = 0; k <= N; ++k) {
        set_column(at, k, Vector::from(displacements.data() + std::size_t{cell.corners[std::size_t(k)]} * N));
      }
      const Square f = Square::Identity() + at * transposed(cell.gradients), adjoint = adjugate(f);
      const double beyond = determinant(f, adjoint) - alpha_;
      const double shape = mu_ * f.squaredNorm(), size = lambda_ * beyond * beyond;
      const double shape_at_rest = mu_ * N, size_at_rest = lambda_ * (1 - alpha_) * (1 - alpha_);
      sum += cell.volume / 2 * (shape - shape_at_rest + size - size_at_rest);
      magnitude_ += cell.volume / 2 * (shape + shape_at_rest + size + size_at_rest);
      const Corners forces = cell.volume * (mu_ * f + lambda_ * beyond * transposed(adjoint)) * cell.gradients;
      for (int k = 0; k <= N; ++k) {
        for (int i = 0; i < N; ++i) {
          gradient_[std::size_t{cell.corners[std::size_t(k)]} * N + std::size_t(i)] += forces(i, k);
        }
      }
    }
    return sum;
  }

  Unknown gather(std::span<const double> all) const {
    Unknown unknown(unknowns_.count(), N);
    for (ElementId e = 0; e < elements_; ++e) {
      for (int k = 0; k < N && unknowns_.of(e) != Unknowns::none; ++k) {
        unknown(unknowns_.of(e), k) = all[std::size_t{e} * N + std::size_t(k)];
      }
    }
    return unknown;
  }
  void scatter(const Unknown& unknown, std::vector<double>& all) const {
    for (ElementId e = 0; e < elements_; ++e) {
      for (int k = 0; k < N && unknowns_.of(e) != Unknowns::none; ++k) {
        all[std::size_t{e} * N + std::size_t(k)] = unknown(unknowns_.of(e), k);
      }
    }
  }

  /// The step of L-BFGS by the two loops of Nocedal (1980).
  Unknown step_of(const Unknown& slope) const {
    Unknown rest = -slope;
    std::array<double, most_pairs> shares{};
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      shares[i] = pairs_[i].step.cwiseProduct(rest).sum() / pairs_[i].product;
      rest -= shares[i] * pairs_[i].change;
    }
    Unknown step = factor_.solve(rest);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      step += (shares[i] - pairs_[i].change.cwiseProduct(step).sum() / pairs_[i].product) * pairs_[i].step;
    }
    return step;
  }

  void add_pair(Unknown step, Unknown change) {
    const double product = step.cwiseProduct(change).sum();
    if (product > least_curvature * step.norm() * change.norm()) {
      if (pairs_.size() == most_pairs) {
        pairs_.erase(pairs_.begin());
      }
      pairs_.push_back({std::move(step), std::move(change), product});
    }
  }

  std::string relax(std::vector<double>& displacements, const Progress& progress) override {
    if (unknowns_.count() == 0) {
      return {};
    }
    take_pairs(displacements);
    energy_ = evaluate(displacements);
    Unknown slope = gather(gradient_);
    double longest = 0;
    bool converged = false;
    for (std::uint32_t i = 0; i < iterations_ && !converged; ++i) {
      progress.report(double(i) / iterations_);
      Unknown step = step_of(slope);
      if (!(slope.cwiseProduct(step).sum() < 0)) {
        pairs_.clear();
        step = step_of(slope);
      }
      longest = step.lpNorm<Eigen::Infinity>();
      converged = longest <= last_step_below * length_;
      if (!converged && !descend(displacements, slope, step)) {
        if (pairs_.empty()) {
          break;
        }
        pairs_.clear();
      }
    }
    keep_pairs(displacements);
    return converged ? std::string() : not_converged(iterations_, longest / length_);
  }

  /// Moves along a step: the whole of it, or its first half, quarter, … for which the energy falls enough. Returns
  /// false if there is none; then nothing has moved.
  bool descend(std::vector<double>& displacements, Unknown& slope, Unknown step) {
    const double expected = slope.cwiseProduct(step).sum();
    const Unknown from = gather(displacements);
    for (int halving = 0; halving < most_halvings; ++halving, step /= 2) {
      scatter(from + step, displacements);
      const double energy = evaluate(displacements), share = std::ldexp(1.0, -halving);
      if (energy <= energy_ + share_of_slope * share * expected + rounding_share * magnitude_) {
        energy_ = energy;
        Unknown next = gather(gradient_);
        add_pair(std::move(step), next - slope);
        slope = std::move(next);
        return true;
      }
    }
    scatter(from, displacements);
    evaluate(displacements);
    return false;
  }

  /// The pairs of the last move, for the elements that move now; none after the object was moved in another way.
  void take_pairs(const std::vector<double>& displacements) {
    pairs_.clear();
    if (!is_where_it_was(displacements)) {
      return;
    }
    const std::size_t size = displacements.size();
    for (std::size_t at = 0; at < kept_.size(); at += 2 * size) {
      add_pair(gather(std::span(kept_).subspan(at, size)), gather(std::span(kept_).subspan(at + size, size)));
    }
  }
  void keep_pairs(const std::vector<double>& displacements) {
    last_ = displacements;
    kept_.clear();
    std::vector<double> all(displacements.size(), 0.0);
    for (const Pair& pair : pairs_) {
      for (const Unknown* one : {&pair.step, &pair.change}) {
        scatter(*one, all);
        kept_.insert(kept_.end(), all.begin(), all.end());
      }
    }
  }

  /// True if the pairs are those of the move to these displacements. Those of prescribed elements may differ.
  bool is_where_it_was(const std::vector<double>& displacements) const {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (unknowns_.of(ElementId(i / N)) != Unknowns::none && displacements[i] != last_[i]) {
        return false;
      }
    }
    return true;
  }

  ElementId elements_;
  std::uint32_t iterations_;
  double length_;  // mean of the links, the unit of steps (mesh units)
  double mu_ = 0, lambda_ = 0, alpha_ = 0;
  std::vector<Cell> cells_;
  std::vector<ElementId> order_;  // of the unknowns
  Unknowns unknowns_{1, 0, {}, {}};
  Cholesky factor_;
  std::vector<double> gradient_;  // of the energy, by all coordinates
  double energy_ = 0;             // of the last iterate
  double magnitude_ = 0;          // of the terms whose difference is the last energy
  std::vector<Pair> pairs_;       // of this move
  std::vector<double> kept_;      // pairs of the last move, by all coordinates: step, change, step, …
  std::vector<double> last_;      // displacements after the last move
};

}  // namespace

std::unique_ptr<ElasticSolver> make_quasi_newton(const ElasticProblem& problem, const Progress& progress) {
  const Simplices cells = build_simplices(*problem.mesh, problem.cuts, progress.part(0, 0.1));
  switch (cells.dimension) {
    case 1:
      return std::make_unique<QuasiNewton<1>>(problem, cells, progress.part(0.1, 1));
    case 2:
      return std::make_unique<QuasiNewton<2>>(problem, cells, progress.part(0.1, 1));
    default:
      return std::make_unique<QuasiNewton<3>>(problem, cells, progress.part(0.1, 1));
  }
}

}  // namespace chainmail
