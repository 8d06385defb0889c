#include "elastic/boundary_system.h"

#include <algorithm>
#include <utility>

#include "elastic/dense.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr Eigen::Index block = 128;  // columns; most of the work is products of matrices of this width
constexpr Eigen::Index slab = 512;   // columns of the remainder between two progress reports

}  // namespace

DenseLu::DenseLu(Eigen::MatrixXd&& matrix, const Progress& progress)
    : factors_(std::move(matrix)), swapped_(std::size_t(factors_.rows())) {
  const Eigen::Index size = factors_.rows();
  for (Eigen::Index first = 0; first < size; first += block) {
    const Eigen::Index width = std::min(block, size - first);
    factor_block(first, width);
    swap_rows(first, width, 0, first);
    // The remaining work shrinks with the cube of the remaining size.
    const double before = double(size - first) / double(size), after = double(size - first - width) / double(size);
    update_rest(first, width, progress.part(1 - before * before * before, 1 - after * after * after));
  }
}

void DenseLu::factor_block(Eigen::Index first, Eigen::Index width) {
  const Eigen::Index size = factors_.rows();
  for (Eigen::Index i = first; i < first + width; ++i) {
    Eigen::Index pivot = 0;
    const double largest = factors_.col(i).tail(size - i).cwiseAbs().maxCoeff(&pivot);
    if (!(largest > 0)) {
      throw Error("BEM", "the equations of this surface have no single answer", "check that it does not cross itself");
    }
    swapped_[std::size_t(i)] = i + pivot;
    if (pivot != 0) {
      factors_.row(i).segment(first, width).swap(factors_.row(i + pivot).segment(first, width));
    }
    const auto below = factors_.col(i).tail(size - i - 1);
    factors_.col(i).tail(size - i - 1) /= factors_(i, i);
    for (Eigen::Index column = i + 1; column < first + width; ++column) {
      factors_.col(column).tail(size - i - 1) -= factors_(i, column) * below;
    }
  }
}

void DenseLu::swap_rows(Eigen::Index first, Eigen::Index width, Eigen::Index from_column, Eigen::Index columns) {
  for (Eigen::Index column = from_column; column < from_column + columns; ++column) {
    double* const values = factors_.col(column).data();
    for (Eigen::Index i = first; i < first + width; ++i) {
      std::swap(values[i], values[swapped_[std::size_t(i)]]);
    }
  }
}

void DenseLu::update_rest(Eigen::Index first, Eigen::Index width, const Progress& progress) {
  const Eigen::Index size = factors_.rows(), next = first + width, below = size - next;
  for (Eigen::Index column = next; column < size; column += slab) {
    progress.report(double(column - next) / double(below));
    const Eigen::Index columns = std::min(slab, size - column);
    swap_rows(first, width, column, columns);
    Dense top = factors_.block(first, column, width, columns);
    factors_.block(first, first, width, width).triangularView<Eigen::UnitLower>().solveInPlace(top);
    add_product(factors_.block(next, column, below, columns), -1, factors_.block(next, first, below, width), top);
  }
}

void DenseLu::solve(Eigen::MatrixXd& columns) const {
  for (std::size_t i = 0; i < swapped_.size(); ++i) {
    columns.row(Eigen::Index(i)).swap(columns.row(swapped_[i]));
  }
  factors_.triangularView<Eigen::UnitLower>().solveInPlace(columns);
  factors_.triangularView<Eigen::Upper>().solveInPlace(columns);
}

namespace {

Eigen::Index row_of(std::size_t facet) { return Eigen::Index(3 * facet); }

}  // namespace

BoundarySystem::BoundarySystem(std::vector<Facet> facets, std::vector<bool> displacement_known, double poisson,
                               const Progress& progress)
    : facets_(std::move(facets)),
      displacement_known_(std::move(displacement_known)),
      poisson_(poisson),
      own_traction_(facets_.size()) {
  // The time for the integrals grows with the square of the number of facets, the time for the factors with its cube.
  // They are equal at about 300 facets.
  const double size = double(facets_.size()), share = 300 / (300 + size);
  Eigen::MatrixXd matrix(row_of(facets_.size()), row_of(facets_.size()));
  assemble(matrix, progress.part(0, share));
  factors_ = DenseLu(std::move(matrix), progress.part(share, 1));
}

/// Assembles Σ_j H_ij u_j = Σ_j G_ij t_j with the unknowns on the left. The diagonal of H includes the jump of ½. A
/// displacement of the whole solid causes no tractions, so each row of H adds up to 0, and its diagonal follows from
/// its other entries.
void BoundarySystem::assemble(Eigen::MatrixXd& matrix, const Progress& progress) {
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    progress.report(double(i) / double(facets_.size()));
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    for (std::size_t j = 0; j < facets_.size(); ++j) {
      const auto [displacement, traction] = integrate_kelvin(facets_[j], facets_[i].centroid, poisson_);
      if (displacement_known_[j]) {
        matrix.block<3, 3>(row_of(i), row_of(j)) = -displacement;
      } else if (i != j) {
        matrix.block<3, 3>(row_of(i), row_of(j)) = traction;
      }
      if (i != j) {
        own -= traction;
      }
    }
    own_traction_[i] = own;
    if (!displacement_known_[i]) {
      matrix.block<3, 3>(row_of(i), row_of(i)) = own;
    }
  }
}

Eigen::MatrixXd BoundarySystem::right_sides(const Eigen::MatrixXd& known) const {
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(known.rows(), known.cols());
  for (std::size_t j = 0; j < facets_.size(); ++j) {
    const auto of_facet = known.middleRows<3>(row_of(j));
    if (of_facet.isZero(0)) {
      continue;  // most displacements are 0, and integrals are slow
    }
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      Eigen::Matrix3d factor = -own_traction_[i];
      if (i != j || !displacement_known_[j]) {
        const auto [displacement, traction] = integrate_kelvin(facets_[j], facets_[i].centroid, poisson_);
        factor = displacement_known_[j] ? Eigen::Matrix3d(-traction) : displacement;
      }
      sides.middleRows<3>(row_of(i)).noalias() += factor * of_facet;
    }
  }
  return sides;
}

BoundarySystem::Fields BoundarySystem::solve(const Eigen::MatrixXd& known) const {
  Eigen::MatrixXd found = right_sides(known);
  factors_.solve(found);
  Fields fields{known, std::move(found)};
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    if (!displacement_known_[i]) {
      fields.displacements.middleRows<3>(row_of(i)).swap(fields.tractions.middleRows<3>(row_of(i)));
    }
  }
  return fields;
}

Eigen::Matrix3Xd BoundarySystem::displacement_inside(const Point& point, const Fields& fields) const {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, fields.displacements.cols());
  for (std::size_t j = 0; j < facets_.size(); ++j) {
    const auto [displacement, traction] = integrate_kelvin(facets_[j], point, poisson_);
    sum += displacement * fields.tractions.middleRows<3>(row_of(j)) -
           traction * fields.displacements.middleRows<3>(row_of(j));
  }
  return sum;
}

}  // namespace chainmail
