#include "calibrate/calibrate.h"

#include <algorithm>
#include <array>

#include "calibrate/drags.h"
#include "calibrate/optimum.h"
#include "measure/physical_error.h"
#include "mesh/error.h"
#include "report/runner.h"

namespace chainmail {
namespace {

// Compression, stretch and shear. Beyond these a link holds nothing any more that a drag of a fifth of the object
// would notice.
const std::vector<double> low{0, 1, 0}, high{1, 3, 2};
constexpr std::array sweeps_tried{0, 1, 3, 10, 30, 100};
constexpr double share_everywhere = 0.6;  // of the evaluations; the others are spent about the best
constexpr double share_of_truth = 0.2;    // of the progress

LinkSoftness softness_at(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }
std::vector<double> point_of(const LinkSoftness& softness) {
  return {softness.compression, softness.stretch, softness.shear};
}

/// A softness and sweeps, and how far from the truth they end.
struct Trial {
  LinkSoftness softness;
  int sweeps = 0;
  double rms = 0, max = 0;
  std::vector<Residual> residuals;  // one a drag
};

report::CompareOptions options_of(const CalibrationOptions& options) {
  report::CompareOptions how;
  how.scheme = options.scheme;
  return how;
}

/// Carries the drags out by one algorithm.
class Bench {
 public:
  Bench(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options, const Progress& progress)
      : drags_(true_drags(mesh, cuts, options, progress.part(0, share_of_truth))),
        object_{"", "", mesh, cuts.links(), options.pins, {}, {}, options.elastic},
        how_(options_of(options)),
        runner_(object_, options.algorithm, Precision::double_precision, how_),
        wanted_(options.evaluations),
        progress_(progress.part(share_of_truth, 1)) {}

  const std::vector<TrueDrag>& drags() const { return drags_; }
  int evaluations() const { return evaluations_; }

  Trial evaluate(const LinkSoftness& softness, int sweeps) {
    Trial trial{softness, sweeps, 0, 0, {}};
    object_.softness.global = softness;
    for (const TrueDrag& drag : drags_) {
      const double done = std::min(1.0, double(evaluations_) / wanted_);
      runner_.run(drag.moves, sweeps, progress_.part(done, done));
      const PhysicalError error =
          measure_physical_error(*object_.mesh, runner_.simulation().solver().positions(), drag.truth);
      trial.residuals.push_back({error.rms, error.max});
      trial.rms += error.rms / double(drags_.size());
      trial.max = std::max(trial.max, error.max);
    }
    ++evaluations_;
    return trial;
  }

 private:
  std::vector<TrueDrag> drags_;
  report::Case object_;
  report::CompareOptions how_;
  report::Runner runner_;
  int evaluations_ = 0;
  int wanted_;
  Progress progress_;
};

/// Goes on from the best so far, with the sweeps given.
void look(Search search, Bench& bench, int sweeps, int evaluations, Trial& best) {
  if (evaluations < 1) {
    return;
  }
  find_optimum(search, low, high, point_of(best.softness), evaluations, [&](const std::vector<double>& x) {
    Trial trial = bench.evaluate(softness_at(x), sweeps);
    const double rms = trial.rms;
    if (rms < best.rms) {
      best = std::move(trial);
    }
    return rms;
  });
}

CalibrationOptions checked(const MeshPointer& mesh, CalibrationOptions options) {
  check(options.elastic);
  check(options.algorithm, *mesh);
  if (elastic_method(options.algorithm)) {
    throw Error("algorithm", "it has no softness that could be calibrated", "choose one of the ChainMail family");
  }
  if (options.drags < 1 || options.evaluations < 1) {
    throw Error(options.drags < 1 ? "drags" : "evaluations", "there would be none", "use 1 or more");
  }
  std::ranges::sort(options.pins);
  options.pins.erase(std::unique(options.pins.begin(), options.pins.end()), options.pins.end());
  if (options.pins.empty()) {
    throw Error("pins", "nothing pins the object, so physics has no static answer", "pin some elements");
  }
  if (options.pins.back() >= mesh->element_count()) {
    throw Error("pins", "there is no element " + std::to_string(options.pins.back()),
                "ids go from 0 to " + std::to_string(mesh->element_count() - 1));
  }
  return options;
}

CalibrationResult result_of(const Bench& bench, const Trial& before, const Trial& best) {
  CalibrationResult result{best.softness, best.sweeps,         best.rms, best.max, before.rms,
                           before.max,    bench.evaluations(), {}};
  for (std::size_t i = 0; i < bench.drags().size(); ++i) {
    const TrueDrag& drag = bench.drags()[i];
    result.drags.push_back({drag.element, drag.target, before.residuals[i], best.residuals[i]});
  }
  return result;
}

}  // namespace

CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& asked,
                            const Progress& progress) {
  const CalibrationOptions options = checked(mesh, asked);
  Bench bench(mesh, cuts, options, progress);
  const Trial before = bench.evaluate({}, 0);
  // Sweeps are whole numbers, and what they do grows with their logarithm: each is given its own search.
  Trial best = before;
  const int each = static_cast<int>(share_everywhere * options.evaluations) / int(sweeps_tried.size());
  for (const int sweeps : sweeps_tried) {
    look(Search::everywhere, bench, sweeps, std::min(each, options.evaluations - bench.evaluations()), best);
  }
  look(Search::about_a_point, bench, best.sweeps, options.evaluations - bench.evaluations(), best);
  progress.report(1.0);
  return result_of(bench, before, best);
}

}  // namespace chainmail
