#include "measure/equilibrium.h"

#include <Eigen/OrderingMethods>
#include <Eigen/Sparse>
#include <utility>

#include "elastic/cholesky.h"
#include "measure/violation.h"

namespace chainmail {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
/// One row per unknown, one column per axis.
using Columns = Eigen::MatrixXd;

// Limit of the residual's norm, divided by that of the right-hand side. The relative error of the positions can be
// larger by the condition number, which is about the number of elements: 1e-6 for a million elements.
constexpr double residual = 1e-12;

constexpr Eigen::Index none = -1;

/// Returns, per element, true if it is one of `fixed` or if uncut links connect it to one.
std::vector<bool> joined_to(const Mesh& mesh, const Cuts& cuts, std::span<const ElementId> fixed) {
  std::vector<bool> joined(mesh.element_count());
  std::vector<ElementId> open(fixed.begin(), fixed.end());
  for (const ElementId element : fixed) {
    joined[element] = true;
  }
  while (!open.empty()) {
    const ElementId element = open.back();
    open.pop_back();
    for_each_neighbour(mesh, cuts, element, [&](ElementId neighbour, EntryId) {
      if (!joined[neighbour]) {
        joined[neighbour] = true;
        open.push_back(neighbour);
      }
    });
  }
  return joined;
}

/// The linear system of the equilibrium. In displacements u the energy is ½ Σ |u_j − u_i|². At its minimum, the
/// displacement of each free element is the mean of its neighbours'. The matrix is the Laplacian of the free elements;
/// the fixed elements are on the right-hand side.
class System {
 public:
  System(const Mesh& mesh, const Cuts& cuts, std::span<const ElementId> fixed, Equilibrium& equilibrium)
      : mesh_(mesh), cuts_(cuts), equilibrium_(equilibrium), unknown_(mesh.element_count(), none) {
    std::vector<bool> is_fixed(mesh.element_count());
    for (const ElementId element : fixed) {
      is_fixed[element] = true;
    }
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      if (equilibrium.defined[e] && !is_fixed[e]) {
        unknown_[e] = static_cast<Eigen::Index>(elements_.size());
        elements_.push_back(e);
      }
    }
  }

  bool solve(std::uint64_t limit, const Progress& progress) {
    if (elements_.empty()) {
      return true;  // Eigen cannot compress a matrix without columns
    }
    build();
    return elements_.size() <= limit ? solve_directly(progress) : solve_by_gradients(progress);
  }

 private:
  double& displacement(ElementId element, int k) {
    return equilibrium_.displacements[std::size_t{element} * mesh_.space_dimension + k];
  }

  void build() {
    const auto size = static_cast<Eigen::Index>(elements_.size());
    matrix_.resize(size, size);
    right_ = Columns::Zero(size, mesh_.space_dimension);
    Eigen::VectorXi counts(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      counts[i] = 1 + static_cast<int>(mesh_.neighbours_of(elements_[i]).size());
    }
    matrix_.reserve(counts);
    for (Eigen::Index i = 0; i < size; ++i) {
      add_row(i);
    }
    matrix_.makeCompressed();
  }

  /// Writes only the lower half of the row: the matrix is symmetric.
  void add_row(Eigen::Index i) {
    int degree = 0;
    for_each_neighbour(mesh_, cuts_, elements_[i], [&](ElementId neighbour, EntryId) {
      ++degree;
      if (const Eigen::Index j = unknown_[neighbour]; j > i) {
        matrix_.insert(j, i) = -1;
      } else if (j == none) {
        for (int k = 0; k < mesh_.space_dimension; ++k) {
          right_(i, k) += displacement(neighbour, k);
        }
      }
    });
    matrix_.insert(i, i) = degree;
  }

  bool solve_directly(const Progress& progress) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(matrix_.selfadjointView<Eigen::Lower>(), order);
    Matrix ordered(matrix_.rows(), matrix_.cols());
    ordered.selfadjointView<Eigen::Lower>() = matrix_.selfadjointView<Eigen::Lower>().twistedBy(order.inverse());
    Cholesky cholesky;
    cholesky.analyze(ordered);
    return cholesky.factor(ordered, progress) && take(order * cholesky.solve(order.inverse() * right_));
  }

  bool solve_by_gradients(const Progress& progress) {
    const Eigen::IncompleteCholesky<double> preconditioner(matrix_);
    Columns solution(right_.rows(), right_.cols());
    for (int k = 0; k < mesh_.space_dimension; ++k) {
      Eigen::VectorXd along(right_.rows());
      for (Eigen::Index i = 0; i < along.rows(); ++i) {
        along[i] = displacement(elements_[i], k);
      }
      const Progress part = progress.part(double(k) / mesh_.space_dimension, double(k + 1) / mesh_.space_dimension);
      if (preconditioner.info() != Eigen::Success || !descend(preconditioner, right_.col(k), along, part)) {
        return false;
      }
      solution.col(k) = along;
    }
    return take(solution);
  }

  /// Runs conjugate gradients along one axis, starting from `x`. Eigen's own implementation cannot be cancelled.
  /// Returns false if it does not converge.
  bool descend(const Eigen::IncompleteCholesky<double>& preconditioner, const Eigen::VectorXd& right,
               Eigen::VectorXd& x, const Progress& progress) const {
    const auto matrix = matrix_.selfadjointView<Eigen::Lower>();
    const double enough = residual * right.norm();
    if (enough == 0) {
      x.setZero();
      return true;
    }
    const Eigen::Index most = 2 * right.rows();
    Eigen::VectorXd rest = right - matrix * x;
    Eigen::VectorXd gradient = preconditioner.solve(rest), way = gradient;
    double slope = rest.dot(gradient);
    for (Eigen::Index i = 0; rest.norm() > enough; ++i) {
      if (i == most || !(slope > 0)) {
        return false;
      }
      progress.report(double(i) / double(most));
      const Eigen::VectorXd pull = matrix * way;
      const double step = slope / way.dot(pull);
      x += step * way;
      rest -= step * pull;
      gradient = preconditioner.solve(rest);
      const double before = std::exchange(slope, rest.dot(gradient));
      way = gradient + slope / before * way;
    }
    return true;
  }

  bool take(const Columns& solution) {
    for (Eigen::Index i = 0; i < solution.rows(); ++i) {
      for (int k = 0; k < mesh_.space_dimension; ++k) {
        displacement(elements_[i], k) = solution(i, k);
      }
    }
    return solution.allFinite();
  }

  const Mesh& mesh_;
  const Cuts& cuts_;
  Equilibrium& equilibrium_;
  std::vector<Eigen::Index> unknown_;  // index of the unknown of each element, or none
  std::vector<ElementId> elements_;    // element of each unknown
  Matrix matrix_;
  Columns right_;
};

bool binds(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const Equilibrium& equilibrium) {
  const PositionView positions = equilibrium.positions(mesh);
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (equilibrium.defined[mesh.links[link][0]] && !cuts.is_cut(link) &&
        link_violation(mesh, softness, positions, link) > counts_as_violated) {
      return true;
    }
  }
  return false;
}

}  // namespace

PositionView Equilibrium::positions(const Mesh& mesh) const {
  return {displacements.data(), mesh.space_dimension * sizeof(double), Precision::double_precision, &mesh};
}

std::optional<Equilibrium> equilibrium(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                       std::span<const ElementId> fixed, const PositionView& positions,
                                       std::uint64_t limit, const Progress& progress) {
  if (fixed.empty()) {
    return std::nullopt;
  }
  Equilibrium result{displacements_of(mesh, positions), joined_to(mesh, cuts, fixed)};
  if (!System(mesh, cuts, fixed, result).solve(limit, progress)) {
    return std::nullopt;
  }
  result.binds = binds(mesh, softness, cuts, result);
  return result;
}

}  // namespace chainmail
