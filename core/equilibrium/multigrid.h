#pragma once

#include <memory>
#include <span>

#include "equilibrium/link_matrix.h"
#include "equilibrium/shared_loop.h"
#include "mesh/progress.h"

namespace chainmail {

/// An approximate inverse of the matrix of an energy: one V-cycle of algebraic multigrid by smoothed
/// aggregation (Vaněk, Mandel and Brezina 1996). It is symmetric, so that conjugate gradients can use it.
///
/// Neighbouring elements form aggregates. On the next coarser level an aggregate moves as a rigid body, so that the
/// iterations do not grow in number if the lateral stiffness is small. Numbers are float: the result is only a
/// preconditioner.
///
/// `Matrix` is a LinkMatrix in float, or a LinkLaplacian. The aggregates of a Laplacian do not turn: it has no other
/// motions without energy than translations.
template <class Matrix>
class Multigrid {
 public:
  using Vectors = typename Matrix::Vectors;

  Multigrid();
  Multigrid(Multigrid&&) noexcept;
  Multigrid& operator=(Multigrid&&) noexcept;
  ~Multigrid();

  /// Builds all levels. The mean over the links of the numbers in the matrix should be near 1. If it is cancelled, the
  /// levels are as before.
  void build(const Matrix& matrix, const Progress& progress = {});
  bool is_built() const { return levels_ != nullptr; }
  /// Updates the levels after the blocks of links changed, or whether elements are fixed. `rows`: the ends of these
  /// links, and these elements and their neighbours; `cut`: true if one of the links was cut. Costs about as much as
  /// the rows and their surroundings are large.
  void update(const Matrix& matrix, std::span<const ElementId> rows, bool cut);
  /// Updates the smoother of the finest level only, for changes that do not last: the coarser levels stay.
  void update_finest(const Matrix& matrix, std::span<const ElementId> rows);
  /// Writes into `solution` one cycle's approximation of the matrix's inverse times `right`.
  void cycle(const Matrix& matrix, const Vectors& right, Vectors& solution, const SharedLoop& shared = {});

 private:
  class Levels;

  std::unique_ptr<Levels> levels_;
};

}  // namespace chainmail
