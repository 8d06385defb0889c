#include "elastic/nonlinear_fem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "elastic/elimination.h"
#include "elastic/energy.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"
#include "mesh/error.h"

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

namespace {

// The handle's displacement is applied in one step if that converges. Otherwise it is split into smaller and smaller
// load steps, down to this share of it.
constexpr double smallest_step = 1.0 / 64;

std::string percent(double share) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.3g %%", 100 * share);
  return text.data();
}

/// Finite deformations on linear elements, of a neo-Hookean or a corotated energy, or of a material that stiffens:
/// Newton's method with a line search. The handle's displacement is applied in load steps.
class NonlinearFem final : public ElasticSolver {
 public:
  /// `iterations`: most steps of Newton's method for a load step; none: as many as it needs.
  NonlinearFem(const char* name, SimplexModel model, std::optional<std::uint32_t> iterations,
               const ElasticProblem& problem, const Progress& progress)
      : model_(std::move(model)),
        iterations_(iterations),
        dimension_(static_cast<std::size_t>(problem.mesh->space_dimension)),
        elements_(problem.mesh->element_count()),
        edge_length_(problem.mesh->mean_link_length),
        pins_(problem.pins),
        pinned_(problem.pinned),
        simplices_(build_simplices(*problem.mesh, problem.cuts, progress.part(0, 0.1))),
        order_(elimination_order(simplices_, *problem.mesh, progress.part(0.1, 0.1))),
        lame_(lame(problem.options.material)),
        base_(problem.mesh->rest.size(), 0.0) {
    check_held(simplices_, *problem.mesh, problem.pins);
    if (std::ranges::any_of(pinned_, [](double one) { return one != 0; })) {
      find_base(name, rigid_fit(problem), progress);
    }
    reset();
  }

  void hold(const ElasticHandle& handle, const Progress& /*progress*/) override {
    if (!newton_ || handle.elements != handle_.elements) {
      std::vector<ElementId> prescribed = pins_;
      prescribed.insert(prescribed.end(), handle.elements.begin(), handle.elements.end());
      newton_ = std::make_unique<Newton>(simplices_, lame_, elements_, order_, prescribed, model_);
      if (iterations_) {
        newton_->limit_steps(*iterations_);
      }
    }
    handle_ = handle;
  }

  /// Starts from the last answer, which is near. If that does not converge, starts from the answer to the pins alone.
  void move(const ElasticMotion& motion, const Progress& progress) override {
    const std::vector<ElementId>& handle = handle_.elements;
    std::vector<double> target;
    for (std::size_t i = 0; i < handle.size(); ++i) {
      const SmallVector displacement = displacement_of(handle_, i, motion);
      target.insert(target.end(), displacement.begin(), displacement.end());
    }
    std::vector<double> answer = displacements_;
    remark_ = carry(*newton_, handle, target, answer, progress.part(0, 0.5));
    if (!remark_.empty() && displacements_ != base_) {
      std::vector<double> retried = base_;
      const std::string from_base = carry(*newton_, handle, target, retried, progress.part(0.5, 1));
      if (from_base.empty()) {
        answer = std::move(retried);
        remark_.clear();
      }
    }
    displacements_ = std::move(answer);
    reached_ = remark_.empty();
    if (reached_ && newton_->unconverged() > 0) {
      remark_ = not_converged(*iterations_, newton_->unconverged() / edge_length_);
    }
  }

  void reset() override {
    displacements_ = base_;
    remark_.clear();
    reached_ = true;
  }
  const std::vector<double>& displacements() const override { return displacements_; }
  const std::string& remark() const override { return remark_; }
  bool reached() const override { return reached_; }
  bool follows_path() const override { return true; }

 private:
  /// Computes the answer to the pins alone: from the rigid motion that is closest to theirs, or else from rest.
  void find_base(const char* name, const std::vector<double>& rigid, const Progress& progress) {
    Newton newton(simplices_, lame_, elements_, order_, pins_, model_);
    std::vector<double> from_rest = base_;
    start_rigidly(rigid);
    std::string stuck = carry(newton, pins_, pinned_, base_, progress.part(0.1, 0.5));
    if (!stuck.empty()) {
      stuck = carry(newton, pins_, pinned_, from_rest, progress.part(0.5, 1));
      base_ = std::move(from_rest);
    }
    if (!stuck.empty()) {
      throw Error(name, "with the pins at their positions, " + stuck, "reset the object, then pin it");
    }
  }

  /// Elements without a cell stay at rest.
  void start_rigidly(const std::vector<double>& displacements) {
    for (const ElementId e : order_) {
      std::copy_n(displacements.begin() + static_cast<std::ptrdiff_t>(e * dimension_), dimension_,
                  base_.begin() + static_cast<std::ptrdiff_t>(e * dimension_));
    }
  }

  /// Moves some prescribed elements from their displacements to their targets. Returns an empty text if it converged.
  /// Otherwise returns the reason, and `displacements` is the last converged state.
  std::string carry(Newton& newton, const std::vector<ElementId>& moved, const std::vector<double>& target,
                    std::vector<double>& displacements, const Progress& progress) {
    std::vector<double> displacement;
    for (std::size_t i = 0; i < target.size(); ++i) {
      displacement.push_back(target[i] - displacements[moved[i / dimension_] * dimension_ + i % dimension_]);
    }
    double done = 0, step = 1;
    int number = 1;
    while (done < 1) {
      progress.report(done);
      const double next = std::min(1.0, done + step);
      std::vector<double> trial = displacements;
      std::vector<double> increment(displacements.size(), 0.0);
      for (std::size_t i = 0; i < displacement.size(); ++i) {
        increment[moved[i / dimension_] * dimension_ + i % dimension_] = displacement[i] * (next - done);
      }
      if (newton.solve(trial, increment, progress.part(done, next))) {
        displacements = std::move(trial);
        done = next;
        step *= 2;
        ++number;
      } else if ((step /= 2) < smallest_step) {
        return "Newton did not converge in load step " + std::to_string(number) + ", at " + percent(next) +
               " of the handle's displacement; this is the last converged state, at " + percent(done);
      }
    }
    for (std::size_t i = 0; i < target.size(); ++i) {
      displacements[moved[i / dimension_] * dimension_ + i % dimension_] = target[i];  // exact, without rounding
    }
    return {};
  }

  SimplexModel model_;
  std::optional<std::uint32_t> iterations_;
  std::size_t dimension_;
  ElementId elements_;
  double edge_length_;  // mean of the links (mesh units)
  std::vector<ElementId> pins_;
  std::vector<double> pinned_;
  Simplices simplices_;
  std::vector<ElementId> order_;  // order of the unknowns
  Lame lame_;
  std::vector<double> base_, displacements_;
  std::unique_ptr<Newton> newton_;  // for the handle's elements
  ElasticHandle handle_;
  bool reached_ = true;
  std::string remark_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_neo_hookean(const ElasticProblem& problem, const Progress& progress) {
  check(problem.options.law, problem.options.material);
  return std::make_unique<NonlinearFem>("neo-Hookean FEM", model_of(problem.options.law), std::nullopt, problem,
                                        progress);
}

std::unique_ptr<ElasticSolver> make_corotational(const ElasticProblem& problem, const Progress& progress) {
  return std::make_unique<NonlinearFem>("corotational FEM", corotated, problem.options.iterations, problem, progress);
}

}  // namespace chainmail
