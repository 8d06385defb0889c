#include "measure/equilibrium.h"

#include <Eigen/Sparse>

#include "measure/violation.h"

namespace chainmail {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
/// A row an unknown, a column an axis.
using Columns = Eigen::MatrixXd;

// Of the residual over the right-hand side. The error in the positions is up to the condition number times
// as large, about the number of elements: 1e-6 of the deflection for a million.
constexpr double residual = 1e-12;

constexpr Eigen::Index none = -1;

/// The elements that uncut links join to one of these, and these.
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

/// In displacements u the energy is ½ Σ |u_j − u_i|², least where each free element has the mean of its
/// neighbours: a Laplacian over the free elements, the fixed ones on the right-hand side.
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

  bool solve(std::uint64_t limit) {
    if (elements_.empty()) {
      return true;  // and Eigen cannot compress a matrix without columns
    }
    build();
    return elements_.size() <= limit ? solve_directly() : solve_by_gradients();
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

  /// The matrix is symmetric: its lower half says all.
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

  bool solve_directly() {
    const Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver(matrix_);
    return solver.info() == Eigen::Success && take(solver.solve(right_));
  }

  bool solve_by_gradients() {
    Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>> solver(matrix_);
    solver.setTolerance(residual);
    Columns start(right_.rows(), right_.cols());
    for (Eigen::Index i = 0; i < start.rows(); ++i) {
      for (int k = 0; k < mesh_.space_dimension; ++k) {
        start(i, k) = displacement(elements_[i], k);
      }
    }
    const Columns solution = solver.solveWithGuess(right_, start);
    return solver.info() == Eigen::Success && take(solution);
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
  std::vector<Eigen::Index> unknown_;  // of each element
  std::vector<ElementId> elements_;    // of each unknown
  Matrix matrix_;
  Columns right_;
};

std::vector<double> displacements_of(const Mesh& mesh, const PositionView& positions) {
  std::vector<double> result(mesh.rest.size());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const std::size_t i = std::size_t{e} * mesh.space_dimension + k;
      result[i] = positions(e, k) - mesh.rest[i];
    }
  }
  return result;
}

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
                                       std::uint64_t limit) {
  if (fixed.empty()) {
    return std::nullopt;
  }
  Equilibrium result{displacements_of(mesh, positions), joined_to(mesh, cuts, fixed)};
  if (!System(mesh, cuts, fixed, result).solve(limit)) {
    return std::nullopt;
  }
  result.binds = binds(mesh, softness, cuts, result);
  return result;
}

}  // namespace chainmail
