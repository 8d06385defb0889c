#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "elastic/energy.h"
#include "elastic/simplices.h"
#include "mesh/progress.h"

namespace chainmail {

/// The unknowns of an object: one per coordinate of each element (a point, not a cell) that has a cell and no
/// prescribed displacement.
class Unknowns {
 public:
  /// Numbers the unknowns in the order of elimination, which keeps the factor of their matrix sparse (see
  /// elimination.h) and lists all elements that have a cell.
  Unknowns(int dimension, ElementId elements, std::span<const ElementId> elimination,
           std::span<const ElementId> prescribed);

  static constexpr std::int32_t none = -1;
  /// Returns the first unknown of an element, or `none`.
  std::int32_t of(ElementId element) const { return first_[element]; }
  Eigen::Index count() const { return count_; }
  /// Number of elements, whether they have unknowns or not.
  ElementId elements() const { return static_cast<ElementId>(first_.size()); }

  /// Copies the unknown entries out of a field of all elements (`dimension` each), and back.
  Eigen::VectorXd gather(const std::vector<double>& all) const;
  void scatter(const Eigen::VectorXd& unknown, std::vector<double>& all) const;
  /// The same for several fields, one per column.
  void scatter(const Eigen::MatrixXd& unknown, Eigen::Ref<Eigen::MatrixXd> all) const;

 private:
  int dimension_;
  std::vector<std::int32_t> first_;
  Eigen::Index count_ = 0;
};

/// The lower triangle of the stiffness matrix of the unknowns, assembled from simplices. The target of each of their
/// entries is found only once.
class Stiffness {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  /// Simplices and unknowns must outlive it. Throws Cancelled.
  Stiffness(const Simplices& simplices, const Unknowns& unknowns, const Progress& progress = {});

  const Sparse& matrix() const { return matrix_; }
  void clear();
  void add(std::size_t simplex, const CornerMatrix& stiffness);
  /// The same for some columns of the matrix only.
  void clear(const std::vector<bool>& columns);
  void add(std::size_t simplex, const CornerMatrix& stiffness, const std::vector<bool>& columns);
  /// Gives an unknown that nothing resists a unit of its own.
  void add_unit(Eigen::Index unknown) { matrix_.valuePtr()[matrix_.outerIndexPtr()[unknown]] += 1; }

 private:
  const Simplices& simplices_;
  const Unknowns& unknowns_;
  std::vector<std::int32_t> indices_;  // index in the matrix of each entry of each simplex, column by column, or none
  Sparse matrix_;
};

}  // namespace chainmail
