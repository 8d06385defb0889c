#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "elastic/energy.h"
#include "elastic/simplices.h"

namespace chainmail {

/// The unknowns of an object whose elements are free, or have their displacement prescribed: n an element that is free
/// and has a cell.
class Unknowns {
 public:
  /// Numbered in the order of `order`, all elements that have a cell, but for the prescribed ones.
  Unknowns(int dimension, ElementId elements, std::span<const ElementId> order, std::span<const ElementId> prescribed);

  static constexpr std::int32_t none = -1;
  /// The first unknown of an element, or none.
  std::int32_t of(ElementId element) const { return first_[element]; }
  Eigen::Index count() const { return count_; }

  /// The entries of all elements (n each) that are unknown, and back.
  Eigen::VectorXd gather(const std::vector<double>& all) const;
  void scatter(const Eigen::VectorXd& unknown, std::vector<double>& all) const;

 private:
  int dimension_;
  std::vector<std::int32_t> first_;
  Eigen::Index count_ = 0;
};

/// The lower triangle of the stiffness of the unknowns, put together from simplices: where each of their entries goes
/// is found once.
class Stiffness {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  Stiffness(const Simplices& simplices, const Unknowns& unknowns);

  const Sparse& matrix() const { return matrix_; }
  void clear();
  void add(std::size_t simplex, const CornerMatrix& stiffness);

 private:
  const Simplices& simplices_;
  std::vector<std::int32_t> places_;  // of each simplex's entries, column after column, among the matrix's; or none
  Sparse matrix_;
};

}  // namespace chainmail
