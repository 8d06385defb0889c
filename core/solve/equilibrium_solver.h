#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/progress.h"
#include "solve/body.h"

namespace chainmail {

/// How close the positions of a body are to the equilibrium.
struct EquilibriumCertificate {
  double violation = 0;  // largest violation of a link, in rest lengths
  double residual = 0;   // estimated distance from the equilibrium in the norm of the energy, relative to its root
  /// Energy above a lower bound of the energy of all valid states, relative to the energy. None for the corotated
  /// energy, which is not convex.
  std::optional<double> gap;
  bool binds = false;  // true if valid regions change the equilibrium
  int iterations = 0;  // since the handle, the pins or the object changed
};

/// Finds the equilibrium: the state of least energy among all in which every link is valid, while the handle and the
/// pins stay.
///
/// An iteration is one step of conjugate gradients, preconditioned by multigrid. Where valid regions bind, it is one
/// step of the alternating direction method of multipliers (Glowinski and Marroco 1975; Boyd et al. 2011), whose linear
/// system has the same form. Each iteration leaves the body in a valid state.
///
/// What is kept between iterations is compared with the body's revisions. A cut, a pin or another softness of some
/// links updates the levels of the multigrid only around them.
class EquilibriumSolver {
 public:
  static std::unique_ptr<EquilibriumSolver> make(int space_dimension);

  EquilibriumSolver() = default;
  EquilibriumSolver(const EquilibriumSolver&) = delete;
  EquilibriumSolver& operator=(const EquilibriumSolver&) = delete;
  virtual ~EquilibriumSolver() = default;

  /// Runs one iteration. The elements of `held` (ascending) and the pins stay, unless their positions contradict each
  /// other: then the handle moves to where the pins allow it. Throws Error if pins contradict each other, and
  /// Cancelled; nothing has moved then.
  virtual void iterate(Body& body, std::span<const ElementId> held, const Progress& progress = {}) = 0;
  /// Iterates until the residual is at most this, or `most` iterations were made. Returns true if the residual was
  /// reached.
  virtual bool solve(Body& body, std::span<const ElementId> held, double residual, int most,
                     const Progress& progress = {}) = 0;

  /// Estimated distance of the last iterate from the equilibrium: see EquilibriumCertificate.
  virtual double residual() const = 0;
  /// The elements that the last call moved, ascending, and the length of the largest step (mesh units).
  virtual std::span<const ElementId> moved() const = 0;
  virtual double largest_step() const = 0;
  /// Returns the certificate of the present positions. Costs as much as about two iterations.
  virtual EquilibriumCertificate certificate(Body& body) = 0;
};

}  // namespace chainmail
