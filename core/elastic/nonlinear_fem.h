#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "elastic/cholesky.h"
#include "elastic/stiffening.h"
#include "elastic/stiffness.h"
#include "mesh/progress.h"

namespace chainmail {

/// Finds displacements of least energy while the displacements of some elements are prescribed.
class Newton {
 public:
  /// `simplices` must outlive this object. `order` is the order of the unknowns, as in Unknowns.
  Newton(const Simplices& simplices, const Lame& lame, ElementId elements, std::span<const ElementId> order,
         std::span<const ElementId> prescribed, SimplexModel model = model_of({}));

  /// Starts from displacements in equilibrium (n coordinates per element), moves the prescribed elements by `increment`
  /// (n coordinates per element; 0 for the others) and finds the new equilibrium. Returns false if it does not
  /// converge; `displacements` are then meaningless. Throws Cancelled.
  bool solve(std::vector<double>& displacements, const std::vector<double>& increment, const Progress& progress = {});
  /// Ends solve() after so many steps at most. It then returns true, converged or not.
  void limit_steps(std::uint32_t most);
  /// Returns the longest change of a coordinate in the last step (mesh units) if the last solve() did not converge
  /// before the limit; 0 if it did.
  double unconverged() const { return unconverged_; }

  /// Energy (Young's modulus times mesh units to the power n), and its possible rounding error.
  struct Energy {
    double value = 0, rounding = 0;
  };
  /// Returns the energy, or none if a cell is inverted.
  std::optional<Energy> energy(const std::vector<double>& displacements) const;
  /// Returns the derivatives of the energy by all coordinates, including those of prescribed elements.
  std::vector<double> gradient(const std::vector<double>& displacements) const;

 private:
  bool predict(std::vector<double>& displacements, const std::vector<double>& increment, const Progress& progress);
  void assemble(const std::vector<double>& displacements, bool only_convex, const Progress& progress);
  bool factor(const std::vector<double>& displacements, const Progress& progress);
  bool descend(std::vector<double>& displacements, const Eigen::VectorXd& step, double slope);

  const Simplices& simplices_;
  Lame lame_;
  SimplexModel model_;
  Unknowns unknowns_;
  Stiffness stiffness_;
  Cholesky factor_;
  bool convex_ = true;  // true if the last matrix was the Hessian itself
  double length_;       // of a cell, the unit in which steps are measured (mesh units)
  int most_steps_;
  bool limited_ = false;  // true: most_steps_ are enough
  double unconverged_ = 0;
};

}  // namespace chainmail
