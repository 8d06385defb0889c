#include "elastic/dense_lu.h"

#include <algorithm>
#include <utility>

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
    const Eigen::Index below = size - i - 1, right = first + width - i - 1;
    factors_.col(i).tail(below) /= factors_(i, i);
    factors_.block(i + 1, i + 1, below, right).noalias() -=
        factors_.col(i).tail(below) * factors_.row(i).segment(i + 1, right);
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
    auto top = factors_.block(first, column, width, columns);
    factors_.block(first, first, width, width).triangularView<Eigen::UnitLower>().solveInPlace(top);
    factors_.block(next, column, below, columns).noalias() -= factors_.block(next, first, below, width) * top;
  }
}

void DenseLu::solve(Eigen::MatrixXd& columns) const {
  for (std::size_t i = 0; i < swapped_.size(); ++i) {
    columns.row(Eigen::Index(i)).swap(columns.row(swapped_[i]));
  }
  factors_.triangularView<Eigen::UnitLower>().solveInPlace(columns);
  factors_.triangularView<Eigen::Upper>().solveInPlace(columns);
}

}  // namespace chainmail
