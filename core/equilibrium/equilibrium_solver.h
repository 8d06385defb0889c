#pragma once

#include <memory>
#include <optional>
#include <span>

#include "body/body.h"
#include "mesh/progress.h"

namespace chainmail {

/// How close the positions of a body are to the equilibrium. The residual and the gap are estimates: they use the
/// preconditioner in place of the inverse of the matrix.
struct EquilibriumCertificate {
  double violation = 0;  // largest violation of a link, in rest lengths
  double residual = 0;   // distance d from the equilibrium, as √(energy of d / energy)
  /// Energy above a lower bound (Lagrange's dual function) of the energy of all valid states, relative to the energy.
  /// None for energies that are not convex: corotated links and the material.
  std::optional<double> gap;
  bool binds = false;  // true if valid regions change the equilibrium
  int iterations = 0;  // since the handle, the pins or the object changed
};

/// Finds the equilibrium: the state of least energy among all in which every link is valid, while the handle and the
/// pins stay.
///
/// An iteration is one step, preconditioned by multigrid, of conjugate gradients, or of a quasi-Newton method (L-BFGS)
/// for corotated links and the material. Where valid regions bind, it is one step of the method of multipliers, see
/// region_constraints.h. Each iteration leaves the body in a valid state.
///
/// What is kept between iterations is compared with the body's revisions. A cut, a pin or another softness of some
/// links updates the levels of the multigrid only around them.
class EquilibriumSolver {
 public:
  /// `uses_regions`: false to find the state of least energy among all states, valid or not.
  static std::unique_ptr<EquilibriumSolver> make(int space_dimension, bool uses_regions = true);

  EquilibriumSolver() = default;
  EquilibriumSolver(const EquilibriumSolver&) = delete;
  EquilibriumSolver& operator=(const EquilibriumSolver&) = delete;
  virtual ~EquilibriumSolver() = default;

  /// Runs one iteration. The elements of `held` (ascending) and the pins stay, unless their positions contradict each
  /// other: then the handle moves to where the pins allow it. Throws Error if pins contradict each other, and
  /// Cancelled; nothing has moved then.
  virtual void iterate(Body& body, std::span<const ElementId> held, const Progress& progress = {}) = 0;
  /// Iterates until the residual is at most `tolerance`, or `max_iterations` were made. Returns true if the residual
  /// was reached.
  virtual bool solve(Body& body, std::span<const ElementId> held, double tolerance, int max_iterations,
                     const Progress& progress = {}) = 0;

  /// Sets the number of threads that an iteration with the energy of the material may use, at least 1, which is the
  /// default. Results have the same bits for any number.
  virtual void set_threads(int threads) = 0;
  /// Estimated distance of the last iterate from the equilibrium: see EquilibriumCertificate.
  virtual double residual() const = 0;
  /// Number of iterations of the last call.
  virtual int iterations() const = 0;
  /// True if the last call built a multigrid, which takes as long as tens of iterations.
  virtual bool has_prepared() const = 0;
  /// The elements that the last call moved, ascending, and the length of the largest step (mesh units).
  virtual std::span<const ElementId> moved() const = 0;
  virtual double largest_step() const = 0;
  /// Returns the certificate of the present positions; none if the body has changed since the last call. Costs as much
  /// as about two iterations.
  virtual std::optional<EquilibriumCertificate> certificate(const Body& body) = 0;
};

}  // namespace chainmail
