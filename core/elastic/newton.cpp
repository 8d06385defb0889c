#include "elastic/newton.h"

#include <cmath>
#include <utility>

namespace chainmail {
namespace {

constexpr int max_steps = 30;  // if it converges, it rarely needs more than ten
constexpr int max_halvings = 30;
// Newton's convergence is quadratic: the step after one this short (in cell lengths) is rounding.
constexpr double converged_below = 1e-9;
// Rounding error of the energy, as a share of the magnitude of its terms: a few roundings of a double.
constexpr double rounding_share = 1e-15;
// Armijo condition: the energy must fall by at least this share of what the slope predicts.
constexpr double share_of_slope = 1e-4;

Eigen::Map<const Eigen::MatrixXd> all_of(const std::vector<double>& displacements, int dimension) {
  return {displacements.data(), dimension, static_cast<Eigen::Index>(displacements.size()) / dimension};
}

CornerDisplacements corners_of(const Simplices& simplices, std::size_t simplex,
                               const std::vector<double>& displacements) {
  const auto all = all_of(displacements, simplices.dimension);
  CornerDisplacements at(simplices.dimension, simplices.dimension + 1);
  for (int a = 0; a <= simplices.dimension; ++a) {
    at.col(a) = all.col(simplices.corners_of(simplex)[static_cast<std::size_t>(a)]);
  }
  return at;
}

double cell_length(const Simplices& simplices) {
  double volume = 0;
  for (const double one : simplices.volumes) {
    volume += one;
  }
  return std::pow(volume / double(simplices.count()), 1.0 / simplices.dimension);
}

}  // namespace

Newton::Newton(const Simplices& simplices, const Lame& lame, ElementId elements, std::span<const ElementId> order,
               std::span<const ElementId> prescribed, SimplexModel model)
    : simplices_(simplices),
      lame_(lame),
      model_(std::move(model)),
      unknowns_(simplices.dimension, elements, order, prescribed),
      stiffness_(simplices, unknowns_),
      length_(cell_length(simplices)),
      most_steps_(max_steps) {
  if (unknowns_.count() > 0) {
    factor_.analyze(stiffness_.matrix());
  }
}

std::optional<Newton::Energy> Newton::energy(const std::vector<double>& displacements) const {
  Energy sum;
  for (std::size_t s = 0; s < simplices_.count(); ++s) {
    const auto one = model_(simplices_, s, corners_of(simplices_, s, displacements), lame_, Want::energy);
    if (one.inverted) {
      return std::nullopt;
    }
    sum.value += one.energy;
    sum.rounding += rounding_share * one.magnitude;
  }
  return sum;
}

std::vector<double> Newton::gradient(const std::vector<double>& displacements) const {
  const int n = simplices_.dimension;
  std::vector<double> sum(displacements.size(), 0.0);
  for (std::size_t s = 0; s < simplices_.count(); ++s) {
    const auto one = model_(simplices_, s, corners_of(simplices_, s, displacements), lame_, Want::gradient);
    for (int i = 0; i < n * (n + 1); ++i) {
      const ElementId corner = simplices_.corners_of(s)[static_cast<std::size_t>(i / n)];
      sum[std::size_t{corner} * static_cast<std::size_t>(n) + static_cast<std::size_t>(i % n)] += one.gradient[i];
    }
  }
  return sum;
}

void Newton::assemble(const std::vector<double>& displacements, bool only_convex, const Progress& progress) {
  stiffness_.clear();
  for (std::size_t s = 0; s < simplices_.count(); ++s) {
    progress.report(s, simplices_.count());
    const auto one = model_(simplices_, s, corners_of(simplices_, s, displacements), lame_,
                            only_convex ? Want::convex : Want::hessian);
    stiffness_.add(s, one.hessian);
  }
}

bool Newton::factor(const std::vector<double>& displacements, const Progress& progress) {
  for (const bool only_convex : {false, true}) {
    assemble(displacements, only_convex, progress.part(0, 0.2));
    if (factor_.factor(stiffness_.matrix(), progress.part(0.2, 1))) {
      convex_ = !only_convex;
      return true;
    }
  }
  return false;
}

/// Moves the prescribed elements by `increment`, and the others as the tangent stiffness predicts: so cells next to the
/// prescribed elements do not invert at once. Returns false if a cell is inverted before or after, or if there is no
/// factor.
bool Newton::predict(std::vector<double>& displacements, const std::vector<double>& increment,
                     const Progress& progress) {
  // An inverted cell has no stiffness. Those who hand over displacements, such as pickles, may have such cells.
  if (!energy(displacements) || !factor(displacements, progress)) {
    return false;
  }
  // Right side of K_ff u_f = −K_fp u_p, cell by cell.
  std::vector<double> force(displacements.size(), 0.0);
  const int n = simplices_.dimension;
  for (std::size_t s = 0; s < simplices_.count(); ++s) {
    const CornerDisplacements moved = corners_of(simplices_, s, increment);
    if (moved.isZero(0)) {
      continue;
    }
    const auto one = model_(simplices_, s, corners_of(simplices_, s, displacements), lame_, Want::hessian);
    const CornerVector of_simplex = one.hessian * moved.reshaped();
    for (int i = 0; i < n * (n + 1); ++i) {
      const ElementId corner = simplices_.corners_of(s)[static_cast<std::size_t>(i / n)];
      force[std::size_t{corner} * static_cast<std::size_t>(n) + static_cast<std::size_t>(i % n)] -= of_simplex[i];
    }
  }
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    displacements[i] += increment[i];
  }
  const Eigen::VectorXd follow = factor_.solve(unknowns_.gather(force));
  unknowns_.scatter(unknowns_.gather(displacements) + follow, displacements);
  return energy(displacements).has_value();
}

/// Moves along a step: the whole of it, or its first half, quarter, … for which the energy falls enough. Returns false
/// if there is none.
bool Newton::descend(std::vector<double>& displacements, const Eigen::VectorXd& step, double slope) {
  const Energy before = *energy(displacements);
  const Eigen::VectorXd from = unknowns_.gather(displacements);
  double share = 1;
  for (int halving = 0; halving < max_halvings; ++halving, share /= 2) {
    unknowns_.scatter(from + share * step, displacements);
    const auto after = energy(displacements);
    // Close to the minimum, the gain is smaller than the rounding error of the energy.
    if (after && after->value <= before.value + share_of_slope * share * slope + before.rounding + after->rounding) {
      return true;
    }
  }
  return false;
}

void Newton::limit_steps(std::uint32_t most) {
  limited_ = most <= std::uint32_t(max_steps);
  most_steps_ = limited_ ? int(most) : max_steps;
}

bool Newton::solve(std::vector<double>& displacements, const std::vector<double>& increment, const Progress& progress) {
  unconverged_ = 0;
  if (unknowns_.count() == 0) {
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      displacements[i] += increment[i];
    }
    return energy(displacements).has_value();
  }
  if (!predict(displacements, increment, progress.part(0, 1.0 / (max_steps + 1)))) {
    return false;
  }
  double longest = 0;
  for (int i = 0; i < most_steps_; ++i) {
    const Progress of_step = progress.part(double(i + 1) / (max_steps + 1), double(i + 2) / (max_steps + 1));
    of_step.report(0.0);
    const Eigen::VectorXd slope = unknowns_.gather(gradient(displacements));
    if (!factor(displacements, of_step)) {
      return false;
    }
    const Eigen::VectorXd step = -factor_.solve(slope);
    if (!step.allFinite() || !descend(displacements, step, slope.dot(step))) {
      return false;
    }
    longest = step.lpNorm<Eigen::Infinity>();
    if (convex_ && longest <= converged_below * length_) {
      return true;
    }
  }
  unconverged_ = limited_ ? longest : 0;
  return limited_;
}

}  // namespace chainmail
