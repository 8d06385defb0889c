#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "elastic/cholesky.h"
#include "equilibrium/laplacian_preconditioner.h"
#include "equilibrium/quasi_newton.h"
#include "equilibrium/region_constraints.h"
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
  using Square = FixedMatrix<double, 3, 3>;

  std::uint32_t find_block(std::uint32_t row, std::uint32_t column) const;
  void find_pattern(const SurfaceEnergy& energy);
  void make_matrix();
  template <class Corners, class Matrix>
  void add(const Corners& corners, const Matrix& matrix);
  void assemble(const SurfaceEnergy& energy, const RegionPenalties<3>& regions, const Vectors& at,
                const Progress& progress);
  void add_to_diagonal(ElementId element, double stiffness) {
    blocks_[first_block_[place_[element]]] += stiffness * Square::Identity();
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

/// The steps to the least energy of a surface in space. A thin sheet resists stretching much more than bending, and
/// what is bending turns with the sheet, so no inverse of the surface at rest serves long. The first inverse of the
/// quasi-Newton method (L-BFGS) is that of the energy's own curvature where it was last computed, by Cholesky factors.
/// They are computed anew when a step brings little: so it is Newton's method where it must be.
///
/// Where not even this finds a way down, and for objects too large to factor, the multigrid of MultigridSteps is used.
class SurfaceSteps {
 public:
  using Energy = SurfaceEnergy;
  using Vectors = SurfaceEnergy::Vectors;
  /// More elements are not factored: it would take more than some seconds.
  static constexpr ElementId max_factored = 50'000;

  void begin(const SurfaceEnergy& energy, const Progress& progress);
  /// Forgets what belongs to other displacements.
  void forget();
  /// Tells that the factors are of another matrix.
  void outdate_inverse() { forget(); }
  double distance() const { return newton_.distance(); }
  /// True if the last step computed factors.
  bool has_prepared() const { return has_prepared_; }

  /// Runs a step as QuasiNewton::step does. Throws Cancelled; nothing has changed then.
  template <class Evaluate>
  bool step(Evaluate evaluate, const SurfaceEnergy& energy, LaplacianPreconditioner<3>& laplacian,
            const RegionPenalties<3>& regions, Vectors& at, double& value, Vectors& force, const SharedLoop& shared,
            const Progress& progress) {
    has_prepared_ = false;
    for (bool again = can_factor_; again;) {
      const bool is_new = is_outdated_;
      if (is_new) {
        factor(energy, laplacian, regions, at, progress);
      }
      if (newton_.step(evaluate, inverse_, at, value, force, shared)) {
        note_step();
        return true;
      }
      is_outdated_ = true;
      again = !is_new;
    }
    newton_.forget();
    last_distance_ = 0;
    return newton_.step(evaluate, laplacian, at, value, force, shared);
  }

 private:
  void factor(const SurfaceEnergy& energy, const LaplacianPreconditioner<3>& laplacian,
              const RegionPenalties<3>& regions, const Vectors& at, const Progress& progress);
  void note_step();

  bool can_factor_ = false, has_prepared_ = false;
  QuasiNewton<3> newton_;
  SurfaceInverse inverse_;
  bool is_outdated_ = true;  // the inverse
  int steps_ = 0;            // with this inverse
  double last_distance_ = 0;
};

}  // namespace chainmail
