#pragma once

#include <optional>
#include <span>
#include <vector>

#include "elastic/cholesky.h"
#include "elastic/stiffness.h"
#include "mesh/progress.h"

namespace chainmail {

/// Finds displacements at which the neo-Hookean energy is least while some elements are prescribed.
class Newton {
 public:
  /// `simplices` must outlive it; `order` is that of Unknowns.
  Newton(const Simplices& simplices, const Lame& lame, ElementId elements, std::span<const ElementId> order,
         std::span<const ElementId> prescribed);

  /// From displacements in balance (n coordinates an element) to those in balance after the prescribed elements moved
  /// by `increment` (of all elements; 0 elsewhere). Returns false where it does not converge; `displacements` are worth
  /// nothing then. Throws Cancelled.
  bool solve(std::vector<double>& displacements, const std::vector<double>& increment, const Progress& progress = {});

  /// The energy (Young's modulus times mesh units to the n), and what rounding may make of it.
  struct Energy {
    double value = 0, rounding = 0;
  };
  /// None where a cell is inverted.
  std::optional<Energy> energy(const std::vector<double>& displacements) const;
  /// Its gradient by all coordinates, the prescribed included: what holds them, with the other sign.
  std::vector<double> gradient(const std::vector<double>& displacements) const;

 private:
  bool predict(std::vector<double>& displacements, const std::vector<double>& increment, const Progress& progress);
  void assemble(const std::vector<double>& displacements, bool only_convex, const Progress& progress);
  bool factor(const std::vector<double>& displacements, const Progress& progress);
  bool descend(std::vector<double>& displacements, const Eigen::VectorXd& step, double slope);

  const Simplices& simplices_;
  Lame lame_;
  Unknowns unknowns_;
  Stiffness stiffness_;
  Cholesky factor_;
  bool convex_ = true;  // the last matrix is the Hessian itself
  double length_;       // of a cell, to measure steps by (mesh units)
};

}  // namespace chainmail
