#include "calibrate/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <memory>
#include <span>
#include <system_error>
#include <thread>

#include "calibrate/drags.h"
#include "calibrate/optimum.h"
#include "measure/physical_error.h"
#include "mesh/error.h"
#include "report/run/runner.h"
#include "simulate/simulation.h"

namespace chainmail {
namespace {

constexpr std::array every_sweeps{0, 1, 3, 10, 30, 100};
// Shares of the evaluations; the others search near the best point.
constexpr double share_everywhere = 0.6, share_of_energy = 0.2;
constexpr double share_of_references = 0.2;  // share of the progress
// Residual of the equilibrium in a search: with a larger one, the error is not smooth enough for it.
constexpr double smooth_residual = 1e-3;

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

/// Some consecutive ones of the numbers that searches vary, as a point: compression, stretch, shear, the decimal
/// logarithm of the lateral stiffness, and the exponent.
class Variables {
 public:
  Variables(std::size_t first, std::size_t end) : first_(first), end_(end) {}

  // Beyond these bounds, a link does not limit a drag of a fifth of the object.
  std::vector<double> low() const { return cut({0, 1, 0, -3, -3}); }
  std::vector<double> high() const { return cut({1, 3, 2, 1.5, 1}); }

  std::vector<double> point_of(const LinkSoftness& softness) const {
    return cut(
        {softness.compression, softness.stretch, softness.shear, std::log10(softness.lateral), softness.exponent});
  }
  /// Returns the softness at a point. Its other numbers are those of `start`.
  LinkSoftness softness_at(const std::vector<double>& x, LinkSoftness start) const {
    double* const numbers[] = {&start.compression, &start.stretch, &start.shear, &start.lateral, &start.exponent};
    for (std::size_t i = first_; i < end_; ++i) {
      *numbers[i] = i == 3 ? std::pow(10.0, x[i - first_]) : x[i - first_];
    }
    return start;
  }

 private:
  std::vector<double> cut(const std::vector<double>& x) const {
    return {x.begin() + std::ptrdiff_t(first_), x.begin() + std::ptrdiff_t(end_)};
  }

  std::size_t first_, end_;
};

const Variables of_regions(0, 3), of_energy(3, 5), of_both(0, 5);

/// A softness and a number of sweeps, with their residuals.
struct Trial {
  LinkSoftness softness;
  int sweeps = 0;
  std::vector<Residual> residuals;  // one per drag

  double relative() const { return together(residuals).relative; }
};

report::RunOptions options_of(const CalibrationOptions& options) {
  report::RunOptions how;
  how.scheme = options.scheme;
  return how;
}

/// Returns a drag without the moves between its first and its last command: the equilibrium depends on the last alone.
report::RecordedMoves in_one_move(const report::RecordedMoves& moves) {
  return {moves.name, moves.description, {moves.commands.front(), moves.commands.back()}};
}

/// Runs drags with one algorithm.
class Bench {
 public:
  Bench(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options, const Progress& progress)
      : drags_(reference_drags(mesh, cuts, options, progress.part(0, share_of_references))),
        object_{"", "", mesh, cuts.links(), options.pins, {}, {}, options.elastic},
        how_(options_of(options)),
        runner_(object_, options.algorithm, Precision::double_precision, how_),
        algorithm_(options.algorithm),
        at_equilibrium_(!info(options.scheme).sweeps),
        energy_(options.energy),
        wanted_(options.evaluations),
        progress_(progress.part(share_of_references, 1)) {}

  const ReferenceDrags& drags() const { return drags_; }
  const Mesh& mesh() const { return *object_.mesh; }
  int evaluations() const { return evaluations_; }

  Trial evaluate(const LinkSoftness& softness, int sweeps) {
    ++evaluations_;
    return {softness, sweeps, at_equilibrium_ ? next_residuals(softness) : residuals(drags_.fitted, softness, sweeps)};
  }

  /// Returns the residuals of a softness and a number of sweeps on some drags.
  std::vector<Residual> residuals(const std::vector<ReferenceDrag>& drags, const LinkSoftness& softness, int sweeps) {
    std::vector<Residual> residuals;
    object_.softness = {softness, {}, energy_, object_.softness.axes};
    const double done = std::min(1.0, double(evaluations_) / wanted_);
    for (const ReferenceDrag& drag : drags) {
      progress_.report(done);
      const auto run = runner_.run(at_equilibrium_ ? in_one_move(drag.moves) : drag.moves, {sweeps, at_equilibrium_},
                                   progress_.quiet());
      if (run.stopped) {
        throw Cancelled();
      }
      residuals.push_back(
          residual_of(measure_physical_error(*object_.mesh, runner_.simulation().body().positions(), drag.reference)));
    }
    return residuals;
  }

 private:
  /// Goes on from the equilibria of the last evaluation, which are often close, with one thread per core. The corotated
  /// energy may have several minima, so these residuals may differ a little from those of drags from rest.
  std::vector<Residual> next_residuals(const LinkSoftness& softness) {
    begin_drags();
    std::vector<Residual> residuals(dragged_.size());
    const std::size_t threads = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, dragged_.size());
    const auto share = [&](std::size_t first) {
      for (std::size_t i = first; i < residuals.size(); i += threads) {
        residuals[i] = next_residual(i, softness);
      }
    };
    std::vector<std::future<void>> running;
    running.reserve(threads);
    for (std::size_t first = 0; first < threads; ++first) {
      try {
        running.push_back(std::async(std::launch::async, share, first));
      } catch (const std::system_error&) {
        share(first);  // the system starts no more threads
      }
    }
    std::ranges::for_each(running, [](auto& one) { one.wait(); });
    std::ranges::for_each(running, [](auto& one) { one.get(); });
    return residuals;
  }

  Residual next_residual(std::size_t i, const LinkSoftness& softness) {
    Simulation& simulation = *dragged_[i];
    const double done = std::min(1.0, double(evaluations_) / wanted_);
    simulation.set_progress(progress_.part(done, done));
    simulation.apply(commands::SetSoftness{Softness{softness, {}, energy_, object_.softness.axes}});
    simulation.apply(commands::Drag{drags_.fitted[i].target});
    simulation.apply(commands::Relax{equilibrium_iterations, 1, RelaxationScheme::equilibrium, smooth_residual});
    return residual_of(
        measure_physical_error(*object_.mesh, simulation.body().positions(), drags_.fitted[i].reference));
  }

  void begin_drags() {
    for (std::size_t i = dragged_.size(); i < drags_.fitted.size(); ++i) {
      Simulation& simulation =
          *dragged_.emplace_back(std::make_unique<Simulation>(object_.mesh, algorithm_, Precision::double_precision));
      report::set_up(simulation, object_);
      simulation.apply(commands::Grab{{drags_.fitted[i].element}});
    }
  }

  ReferenceDrags drags_;
  report::Case object_;
  report::RunOptions how_;
  report::Runner runner_;
  std::vector<std::unique_ptr<Simulation>> dragged_;  // one per drag for the search, at equilibrium
  Algorithm algorithm_;
  bool at_equilibrium_;
  EnergyKind energy_;
  int evaluations_ = 0;
  int wanted_;
  Progress progress_;
};

/// Searches from `start` with this number of sweeps, and updates the best result so far.
void search(Search kind, const Variables& variables, Bench& bench, const Trial& start, int evaluations, Trial& best) {
  if (evaluations < 1) {
    return;
  }
  find_optimum(kind, variables.low(), variables.high(), variables.point_of(start.softness), evaluations,
               [&](const std::vector<double>& x) {
                 Trial trial = bench.evaluate(variables.softness_at(x, start.softness), start.sweeps);
                 const double relative = trial.relative();
                 if (relative < best.relative()) {
                   best = std::move(trial);
                 }
                 return relative;
               });
}

/// Sweeps are whole numbers, and their effect grows with their logarithm, so each number gets its own search.
void search_with_sweeps(Bench& bench, const CalibrationOptions& options, Trial& best) {
  const auto end = std::ranges::upper_bound(every_sweeps, options.max_sweeps);
  const std::span tried(every_sweeps.begin(), end);
  const int each = static_cast<int>(share_everywhere * options.evaluations) / std::max(1, int(tried.size()));
  for (const int sweeps : tried) {
    search(Search::everywhere, of_regions, bench, {best.softness, sweeps, {}},
           std::min(each, options.evaluations - bench.evaluations()), best);
  }
  search(Search::about_a_point, of_regions, bench, Trial(best), options.evaluations - bench.evaluations(), best);
}

/// Searches for the energy alone, with open regions, from two starts: an energy that resists rotation less or more.
/// Then for energy and regions together, from the best one: narrow regions have their own minima, in which the handle
/// stops.
void search_at_equilibrium(Bench& bench, const CalibrationOptions& options, Trial& best) {
  const bool has_energy = options.energy == EnergyKind::axial || options.energy == EnergyKind::corotated;
  const int each = static_cast<int>(share_of_energy * options.evaluations);
  for (const double stiffer : {1.0, 10.0}) {
    LinkSoftness open = best.softness;
    open.compression = 0;
    open.stretch = 3;
    open.shear = 2;
    open.lateral = info(options.energy).lateral * stiffer;
    open.exponent = -2;
    search(Search::about_a_point, has_energy ? of_energy : of_regions, bench, {open, 0, {}},
           std::min(each, options.evaluations - bench.evaluations()), best);
  }
  search(Search::about_a_point, has_energy ? of_both : of_regions, bench, Trial(best),
         options.evaluations - bench.evaluations(), best);
}

CalibrationOptions checked(const MeshPointer& mesh, CalibrationOptions options) {
  check(options.elastic);
  check(options.algorithm, *mesh);
  if (!info(options.algorithm).uses_softness()) {
    throw Error("algorithm", "it has no softness to calibrate", "choose one of the ChainMail family");
  }
  check_members(options);
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
  const auto test = [&](const std::vector<ReferenceDrag>& drags) {
    return tested(bench.mesh(), drags, bench.residuals(drags, before.softness, before.sweeps),
                  bench.residuals(drags, best.softness, best.sweeps));
  };
  result.fitted = test(bench.drags().fitted);
  result.held_out = test(bench.drags().held_out);
  return result;
}

}  // namespace

CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& asked,
                            const Progress& progress) {
  const CalibrationOptions options = checked(mesh, asked);
  Bench bench(mesh, cuts, options, progress);
  LinkSoftness usual;
  usual.lateral = info(options.energy).lateral;
  const Trial before = bench.evaluate(usual, 0);
  Trial best = before;
  info(options.scheme).sweeps ? search_with_sweeps(bench, options, best) : search_at_equilibrium(bench, options, best);
  CalibrationResult result = result_of(bench, before, best);
  progress.report(1.0);
  return result;
}

}  // namespace chainmail
