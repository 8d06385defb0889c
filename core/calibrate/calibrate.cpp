#include "calibrate/calibrate.h"

#include <algorithm>
#include <array>
#include <span>

#include "calibrate/drags.h"
#include "calibrate/optimum.h"
#include "measure/physical_error.h"
#include "mesh/error.h"
#include "report/run/runner.h"

namespace chainmail {
namespace {

// Bounds of compression, stretch and shear. Beyond these, a link does not limit a drag of a fifth of the object.
const std::vector<double> low{0, 1, 0}, high{1, 3, 2};
constexpr std::array every_sweeps{0, 1, 3, 10, 30, 100};
constexpr double share_everywhere = 0.6;     // share of the evaluations; the others search near the best point
constexpr double share_of_references = 0.2;  // share of the progress

LinkSoftness softness_at(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }
std::vector<double> point_of(const LinkSoftness& softness) {
  return {softness.compression, softness.stretch, softness.shear};
}

Residual residual_of(const PhysicalError& error) { return {error.rms, error.max, error.relative}; }

/// Returns the means over some drags, and the largest of the maxima.
Residual together(const std::vector<Residual>& residuals) {
  Residual mean;
  for (const Residual& one : residuals) {
    mean.rms += one.rms / double(residuals.size());
    mean.relative += one.relative / double(residuals.size());
    mean.max = std::max(mean.max, one.max);
  }
  return mean;
}

/// A softness and a number of sweeps, with their residuals.
struct Trial {
  LinkSoftness softness;
  int sweeps = 0;
  std::vector<Residual> residuals;  // one per drag

  double relative() const { return together(residuals).relative; }
};

report::CompareOptions options_of(const CalibrationOptions& options) {
  report::CompareOptions how;
  how.scheme = options.scheme;
  return how;
}

/// Runs drags with one algorithm.
class Bench {
 public:
  Bench(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options, const Progress& progress)
      : drags_(reference_drags(mesh, cuts, options, progress.part(0, share_of_references))),
        object_{"", "", mesh, cuts.links(), options.pins, {}, {}, options.elastic},
        how_(options_of(options)),
        runner_(object_, options.algorithm, Precision::double_precision, how_),
        wanted_(options.evaluations),
        progress_(progress.part(share_of_references, 1)) {}

  const ReferenceDrags& drags() const { return drags_; }
  const Mesh& mesh() const { return *object_.mesh; }
  int evaluations() const { return evaluations_; }

  Trial evaluate(const LinkSoftness& softness, int sweeps) {
    ++evaluations_;
    return {softness, sweeps, residuals(drags_.fitted, softness, sweeps)};
  }

  /// Returns the residuals of a softness and a number of sweeps on some drags.
  std::vector<Residual> residuals(const std::vector<ReferenceDrag>& drags, const LinkSoftness& softness, int sweeps) {
    std::vector<Residual> residuals;
    object_.softness.global = softness;
    const double done = std::min(1.0, double(evaluations_) / wanted_);
    for (const ReferenceDrag& drag : drags) {
      runner_.run(drag.moves, sweeps, progress_.part(done, done));
      residuals.push_back(
          residual_of(measure_physical_error(*object_.mesh, runner_.simulation().body().positions(), drag.reference)));
    }
    return residuals;
  }

 private:
  ReferenceDrags drags_;
  report::Case object_;
  report::CompareOptions how_;
  report::Runner runner_;
  int evaluations_ = 0;
  int wanted_;
  Progress progress_;
};

/// Continues the search from the best result so far, with this number of sweeps.
void look(Search search, Bench& bench, int sweeps, int evaluations, Trial& best) {
  if (evaluations < 1) {
    return;
  }
  find_optimum(search, low, high, point_of(best.softness), evaluations, [&](const std::vector<double>& x) {
    Trial trial = bench.evaluate(softness_at(x), sweeps);
    const double relative = trial.relative();
    if (relative < best.relative()) {
      best = std::move(trial);
    }
    return relative;
  });
}

CalibrationOptions checked(const MeshPointer& mesh, CalibrationOptions options) {
  check(options.elastic);
  check(options.algorithm, *mesh);
  if (!info(options.algorithm).uses_softness()) {
    throw Error("algorithm", "it has no softness to calibrate", "choose one of the ChainMail family");
  }
  if (!info(options.scheme).sweeps) {
    throw Error("relaxation", "the equilibrium is not a scheme of sweeps", "use mean or link");
  }
  if (options.drags < 1 || options.evaluations < 1) {
    throw Error(options.drags < 1 ? "drags" : "evaluations", "it is below 1", "use 1 or more");
  }
  options.held_out = std::max(0, options.held_out);
  std::ranges::sort(options.pins);
  options.pins.erase(std::unique(options.pins.begin(), options.pins.end()), options.pins.end());
  if (options.pins.empty()) {
    throw Error("pins", "nothing pins the object, so physics has no solution", "pin some elements");
  }
  if (options.pins.back() >= mesh->element_count()) {
    throw Error("pins", "there is no element " + std::to_string(options.pins.back()),
                "use an id from 0 to " + std::to_string(mesh->element_count() - 1));
  }
  return options;
}

TestedDrags tested(const Mesh& mesh, const std::vector<ReferenceDrag>& drags, const std::vector<Residual>& before,
                   const std::vector<Residual>& after) {
  TestedDrags result;
  std::vector<Residual> nothing;
  for (std::size_t i = 0; i < drags.size(); ++i) {
    nothing.push_back(residual_of(error_of_nothing_moving(mesh, drags[i].reference)));
    result.drags.push_back({drags[i].element, drags[i].target, before[i], after[i], nothing.back()});
  }
  result.before = together(before);
  result.after = together(after);
  result.nothing = together(nothing);
  return result;
}

CalibrationResult result_of(Bench& bench, const Trial& before, const Trial& best) {
  CalibrationResult result{best.softness, best.sweeps, bench.evaluations(), {}, {}};
  result.fitted = tested(bench.mesh(), bench.drags().fitted, before.residuals, best.residuals);
  const auto& held_out = bench.drags().held_out;
  result.held_out = tested(bench.mesh(), held_out, bench.residuals(held_out, before.softness, before.sweeps),
                           bench.residuals(held_out, best.softness, best.sweeps));
  return result;
}

}  // namespace

CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& asked,
                            const Progress& progress) {
  const CalibrationOptions options = checked(mesh, asked);
  Bench bench(mesh, cuts, options, progress);
  const Trial before = bench.evaluate({}, 0);
  // Sweeps are whole numbers, and their effect grows with their logarithm, so each number gets its own search.
  Trial best = before;
  const auto end = std::ranges::upper_bound(every_sweeps, options.most_sweeps);
  const std::span tried(every_sweeps.begin(), end);
  const int each = static_cast<int>(share_everywhere * options.evaluations) / std::max(1, int(tried.size()));
  for (const int sweeps : tried) {
    look(Search::everywhere, bench, sweeps, std::min(each, options.evaluations - bench.evaluations()), best);
  }
  look(Search::about_a_point, bench, best.sweeps, options.evaluations - bench.evaluations(), best);
  CalibrationResult result = result_of(bench, before, best);
  progress.report(1.0);
  return result;
}

}  // namespace chainmail
