#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "elastic/cholesky.h"
#include "equilibrium/region_penalties.h"
#include "equilibrium/surface_energy.h"

namespace chainmail {

/// The inverse of the curvature of a surface's energy at some displacements, without negative curvature, by sparse
/// Cholesky factors. The pattern is that of the uncut object without fixed elements; so it is analysed once.
class SurfaceInverse {
 public:
  using Vectors = SurfaceEnergy::Vectors;

  /// Analyses the pattern. Throws Cancelled.
  void begin(const SurfaceEnergy& energy, const Progress& progress = {});
  /// Computes the factors, with the springs of regions. `is_fixed(element)` is true for elements that stay. Throws
  /// Cancelled; there are no factors then.
  void factor(const SurfaceEnergy& energy, const RegionPenalties<3>& regions, const Vectors& at,
              const std::function<bool(ElementId)>& is_fixed, const Progress& progress = {});
  void apply(const Vectors& right, Vectors& result, const SharedLoop& shared = {}) const;

 private:
  using Square = Eigen::Matrix3d;

  std::uint32_t find_block(std::uint32_t row, std::uint32_t column) const;
  void find_pattern(const SurfaceEnergy& energy);
  void make_matrix();
  template <class Corners, class Matrix>
  void add(const Corners& corners, const Matrix& matrix);
  void assemble(const SurfaceEnergy& energy, const RegionPenalties<3>& regions, const Vectors& at,
                const Progress& progress);
  void add_to_diagonal(ElementId element, double stiffness) {
    blocks_[first_block_[place_[element]]].diagonal().array() += stiffness;
  }
  void write_matrix(double added);

  std::vector<std::uint32_t> place_;  // of each element in the order of elimination
  std::vector<ElementId> order_;
  std::vector<std::uint32_t> first_block_, block_row_;  // of each column of blocks, diagonal first
  std::vector<Square> blocks_;
  Eigen::SparseMatrix<double> matrix_;  // lower triangle
  Cholesky factor_;
  std::vector<std::uint8_t> is_fixed_;
};

}  // namespace chainmail
