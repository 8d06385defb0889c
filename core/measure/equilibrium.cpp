#include "measure/equilibrium.h"

#include <Eigen/OrderingMethods>
#include <Eigen/Sparse>
#include <utility>

#include "elastic/cholesky.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/link_energy.h"
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

/// The linear system of the equilibrium. In displacements u the isotropic energy is ½ Σ |u_j − u_i|². At its minimum,
/// the displacement of each free element is the mean of its neighbours', on each axis alone. The matrix is the
/// Laplacian of the free elements; the fixed elements are on the right-hand side. Axial energy couples the axes: each
/// element has one unknown per axis, each link a block, and there is one right-hand side.
class System {
 public:
  System(const Mesh& mesh, const Softness& softness, const Cuts& cuts, std::span<const ElementId> fixed,
         Equilibrium& equilibrium)
      : mesh_(mesh),
        softness_(softness),
        cuts_(cuts),
        equilibrium_(equilibrium),
        width_(softness.energy == EnergyKind::isotropic ? 1 : mesh.space_dimension),
        unknown_(mesh.element_count(), none) {
    std::vector<bool> is_fixed(mesh.element_count());
    for (const ElementId element : fixed) {
      is_fixed[element] = true;
    }
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      if (equilibrium.defined[e] && !is_fixed[e]) {
        unknown_[e] = static_cast<Eigen::Index>(elements_.size()) * width_;
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
    const auto size = static_cast<Eigen::Index>(elements_.size()) * width_;
    matrix_.resize(size, size);
    right_ = Columns::Zero(size, mesh_.space_dimension / width_);
    Eigen::VectorXi counts(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      counts[i] = width_ * (1 + static_cast<int>(mesh_.neighbours_of(elements_[i / width_]).size()));
    }
    matrix_.reserve(counts);
    for (Eigen::Index i = 0; i < size; i += width_) {
      width_ == 1 && softness_.energy == EnergyKind::isotropic ? add_row(i) : add_blocks(i);
    }
    matrix_.makeCompressed();
  }

  /// Returns the element and the axis of a row and a right-hand side.
  ElementId element_of(Eigen::Index row) const { return elements_[row / width_]; }
  int axis_of(Eigen::Index row, int column) const { return width_ == 1 ? column : static_cast<int>(row % width_); }

  /// Writes the blocks of an element whose first row is `row`, only the lower half of each column.
  void add_blocks(Eigen::Index row) {
    const int dimension = mesh_.space_dimension;
    Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(dimension, dimension);
    for_each_neighbour(mesh_, cuts_, element_of(row), [&](ElementId neighbour, EntryId entry) {
      const Eigen::MatrixXd block = block_of(mesh_.entry_link[entry]);
      diagonal += block;
      const Eigen::Index other = unknown_[neighbour];
      for (int i = 0; i < dimension; ++i) {
        for (int k = 0; k < dimension; ++k) {
          if (other == none) {
            right_(row + i, 0) += block(i, k) * displacement(neighbour, k);
          } else if (other > row) {
            matrix_.insert(other + k, row + i) = -block(k, i);
          }
        }
      }
    });
    for (int i = 0; i < dimension; ++i) {
      for (int k = i; k < dimension; ++k) {
        matrix_.insert(row + k, row + i) = diagonal(k, i);
      }
    }
  }

  /// Returns the stiffness of a link, axial · r̂ r̂ᵀ + lateral.
  Eigen::MatrixXd block_of(LinkId link) const {
    const int dimension = mesh_.space_dimension;
    const auto [a, b] = mesh_.links[link];
    const Eigen::Map<const Eigen::VectorXd> from(mesh_.rest.data() + std::size_t{a} * dimension, dimension),
        to(mesh_.rest.data() + std::size_t{b} * dimension, dimension);
    const auto [axial, lateral] = link_weights(mesh_, softness_, link);
    Eigen::MatrixXd block = lateral * Eigen::MatrixXd::Identity(dimension, dimension);
    if (axial > 0) {
      const Eigen::VectorXd direction = (to - from).normalized();
      block += axial * direction * direction.transpose();
    }
    return block;
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
    const int columns = static_cast<int>(right_.cols());
    for (int k = 0; k < columns; ++k) {
      Eigen::VectorXd along(right_.rows());
      for (Eigen::Index i = 0; i < along.rows(); ++i) {
        along[i] = displacement(element_of(i), axis_of(i, k));
      }
      const Progress part = progress.part(double(k) / columns, double(k + 1) / columns);
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
    const Eigen::Index max_iterations = 2 * right.rows();
    Eigen::VectorXd residual = right - matrix * x;
    Eigen::VectorXd gradient = preconditioner.solve(residual), direction = gradient;
    double slope = residual.dot(gradient);
    for (Eigen::Index i = 0; residual.norm() > enough; ++i) {
      if (i == max_iterations || !(slope > 0)) {
        return false;
      }
      progress.report(double(i) / double(max_iterations));
      const Eigen::VectorXd product = matrix * direction;
      const double step = slope / direction.dot(product);
      x += step * direction;
      residual -= step * product;
      gradient = preconditioner.solve(residual);
      const double before = std::exchange(slope, residual.dot(gradient));
      direction = gradient + slope / before * direction;
    }
    return true;
  }

  bool take(const Columns& solution) {
    for (Eigen::Index i = 0; i < solution.rows(); ++i) {
      for (int k = 0; k < static_cast<int>(solution.cols()); ++k) {
        displacement(element_of(i), axis_of(i, k)) = solution(i, k);
      }
    }
    return solution.allFinite();
  }

  const Mesh& mesh_;
  const Softness& softness_;
  const Cuts& cuts_;
  Equilibrium& equilibrium_;
  int width_;                          // unknowns per element in a column
  std::vector<Eigen::Index> unknown_;  // index of the first unknown of each element, or none
  std::vector<ElementId> elements_;    // the elements with unknowns
  Matrix matrix_;
  Columns right_;
};

/// The energies of corotated links and of the material are not quadratic: their minimum is found by iterations from the
/// present positions on.
bool settle(const Mesh& mesh, const Softness& softness, const ElasticOptions& elastic, const Cuts& cuts,
            std::span<const ElementId> fixed, const PositionView& positions, Equilibrium& equilibrium,
            const Progress& progress) {
  constexpr double enough = 1e-8;
  constexpr int max_iterations = 1000;
  Body body(MeshPointer(std::shared_ptr<void>(), &mesh), Precision::double_precision);
  std::vector<double> at(mesh.rest.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = positions(ElementId(i / std::size_t(mesh.space_dimension)), int(i % std::size_t(mesh.space_dimension)));
  }
  body.store_displacements(true);
  body.set_positions(at);
  body.set_softness(softness);
  body.set_elastic(elastic);
  body.cut(cuts.links());
  body.pin(fixed);
  if (!EquilibriumSolver::make(mesh.space_dimension, false)->solve(body, {}, enough, max_iterations, progress)) {
    return false;
  }
  const std::vector<double> found = displacements_of(mesh, body.positions());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (equilibrium.defined[i / std::size_t(mesh.space_dimension)]) {
      equilibrium.displacements[i] = found[i];
    }
  }
  return true;
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
                                       const ElasticOptions& elastic, std::uint64_t limit, const Progress& progress) {
  if (fixed.empty()) {
    return std::nullopt;
  }
  Equilibrium result{displacements_of(mesh, positions), joined_to(mesh, cuts, fixed)};
  const bool is_solved = energy_in(mesh, softness.energy) == EnergyKind::corotated ||
                                 energy_in(mesh, softness.energy) == EnergyKind::material
                             ? settle(mesh, softness, elastic, cuts, fixed, positions, result, progress)
                             : System(mesh, softness, cuts, fixed, result).solve(limit, progress);
  if (!is_solved) {
    return std::nullopt;
  }
  result.binds = binds(mesh, softness, cuts, result);
  return result;
}

}  // namespace chainmail
