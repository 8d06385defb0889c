#pragma once

#include <cstdint>
#include <vector>

#include "equilibrium/laplacian_preconditioner.h"
#include "equilibrium/quasi_newton.h"
#include "equilibrium/region_penalties.h"
#include "equilibrium/surface_energy.h"
#include "equilibrium/surface_inverse.h"

namespace chainmail {

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
