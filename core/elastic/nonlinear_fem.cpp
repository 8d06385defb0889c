#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>

#include "elastic/corotated.h"
#include "elastic/elimination.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"
#include "elastic/newton.h"
#include "elastic/rigid_fit.h"
#include "elastic/stiffening.h"
#include "mesh/error.h"

namespace chainmail {
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
