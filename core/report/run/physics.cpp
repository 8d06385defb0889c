#include "report/run/physics.h"

#include <algorithm>
#include <array>

#include "mesh/error.h"
#include "report/run/drag_reference.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/table/format.h"

namespace chainmail::report {
namespace {

// Only these algorithms are calibrated: calibration takes longer than a drag, and the other algorithms of the family
// differ little from them.
constexpr std::array calibrated_algorithms{Algorithm::natural_queue, Algorithm::exact};
constexpr double share_of_drags = 0.6;  // share of the progress, if growth is measured too

PhysicsOptions checked(PhysicsOptions options) {
  if (options.algorithms.empty()) {
    for (const AlgorithmInfo& one : every_algorithm()) {
      options.algorithms.push_back(one.algorithm);
    }
  }
  check(options);
  if (!(options.growth_seconds >= 0)) {
    throw Error("grow", "the time is below 0", "use 0 or more seconds");
  }
  return options;
}

std::vector<Setting> settings_of(const PhysicsOptions& options, const ElasticOptions& elastic) {
  std::vector<Setting> settings = settings_of(static_cast<const RunOptions&>(options));
  const auto& lattice = elastic.lattice;
  settings.insert(settings.end(), {{"young", elastic.material.young},
                                   {"poisson", elastic.material.poisson},
                                   {"lattice", std::to_string(lattice[0]) + "x" + std::to_string(lattice[1]) + "x" +
                                                   std::to_string(lattice[2])},
                                   {"iterations", double(elastic.iterations)},
                                   {"growth_seconds", options.growth_seconds}});
  return settings;
}

/// Runs a drag, and adds it to the last object.
void add_drag(Results& results, Contest& contest, const RecordedMoves& moves, DragReferences& references,
              const Progress& progress) {
  DragInfo drag = info_of(moves);
  std::vector<Row> rows;
  try {
    const DragReference reference = references.at_end(moves);
    drag.handle_displacement = reference.solution.handle_displacement;
    drag.reference = reference.refined;
    PhysicsReferee referee(reference.solution, reference.change());
    rows = contest.run(moves, &referee, progress);
  } catch (const Error& error) {
    drag.no_reference = error.what();
  }
  if (!progress.cancelled()) {
    add_drag(results, std::move(drag), std::move(rows));
  }
}

void add_growths(Results& results, const Case& first, const PhysicsOptions& options, const Progress& progress) {
  const Softness softness{first.softness.global, {}};
  const auto made = [&](Case (*pinned)(std::uint64_t, const Softness&, const ElasticOptions&, bool)) {
    return [&, pinned](std::uint64_t elements) { return pinned(elements, softness, first.elastic, false); };
  };
  results.add(grow("growing bar", "tetrahedra, pinned at the left layer, pulled", made(pinned_bar), options,
                   part_of(progress, 0, 2, "growing bar")));
  results.add(grow("growing sheet", "triangles in a plane, pinned at the top layer, pulled", made(pinned_sheet),
                   options, part_of(progress, 1, 2, "growing sheet")));
}

}  // namespace

std::vector<Contestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                       bool equilibrium, const std::vector<Calibration>& calibrations) {
  std::vector<Contestant> contestants{{}};
  for (const Algorithm algorithm : algorithms) {
    if (info(algorithm).elastic) {
      contestants.push_back({algorithm});
      continue;
    }
    for (const int count : sweeps) {
      contestants.push_back({algorithm, count});
    }
    if (equilibrium && takes_part_at_equilibrium(algorithm)) {
      contestants.push_back({algorithm, 0, true});
      contestants.push_back({.algorithm = algorithm, .equilibrium = true, .open_regions = true});
    }
    for (const Calibration& found : calibrations) {
      if (found.algorithm == algorithm && found.refusal.empty()) {
        contestants.push_back({algorithm, found.sweeps, found.equilibrium, found.softness});
      }
    }
  }
  return contestants;
}

std::vector<Calibration> calibrations_of(const Case& object, const PhysicsOptions& options, const Progress& progress) {
  std::vector<Calibration> found;
  const std::vector<ElementId> handles = handles_of(object);
  for (const Algorithm algorithm : calibrated_algorithms) {
    const bool takes_part = std::ranges::count(options.algorithms, algorithm) != 0;
    for (const bool equilibrium : {false, true}) {
      const bool wanted =
          equilibrium ? options.equilibrium && takes_part_at_equilibrium(algorithm) : !options.sweeps.empty();
      if (!options.calibrate || !wanted || !takes_part || !fits(algorithm, *object.mesh) || progress.cancelled()) {
        continue;
      }
      constexpr double most = 2 * calibrated_algorithms.size();
      const double done = double(found.size());
      try {
        found.push_back(
            options.calibrate(object, algorithm, equilibrium, handles, progress.part(done / most, (done + 1) / most)));
      } catch (const Error& error) {
        found.push_back({algorithm, equilibrium, {}, 0, 0, 0, 0, error.what()});
      } catch (const Cancelled&) {
        return found;
      }
    }
  }
  return found;
}

std::string in_words(const Calibration& calibration) {
  const std::string who = label(Contestant{calibration.algorithm, 0, calibration.equilibrium}) + " calibrated";
  return !calibration.refusal.empty()
             ? who + ": left out, " + calibration.refusal
             : who + " in " + figure(calibration.seconds) + " s on " + std::to_string(calibration.drags) +
                   " drags of other elements, " + std::to_string(calibration.evaluations) +
                   " evaluations: " + region_in_words(calibration.softness) + ", " +
                   (calibration.equilibrium ? energy_in_words(calibration.softness)
                                            : std::to_string(calibration.sweeps) + " sweeps");
}

Results compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& asked, const Progress& progress,
                             const Finished& finished) {
  const PhysicsOptions options = checked(asked);
  Results results{.kind = ReportKind::physics,
                  .settings = settings_of(options, cases.empty() ? ElasticOptions() : cases.front().elastic)};
  double steps = 0, done = 0;  // calibrating, turning, and each drag
  for (const Case& object : cases) {
    std::ranges::for_each(object.drags, [](const RecordedMoves& moves) { check(moves); });
    steps += double(object.drags.size()) + (options.calibrate ? 1 : 0) + (options.turned ? 1 : 0);
  }
  const bool grows = options.growth_seconds > 0;
  const Progress of_drags = progress.part(0, grows ? share_of_drags : 1);
  const auto next = [&](const std::string& text) { return part_of(of_drags, done++, steps, text); };
  for (const Case& object : cases) {
    results.objects.push_back(info_of(object));
    results.objects.back().reference = label(object.law) + " FEM";
    DragReferences references(object, options.refine);
    const auto calibrations = options.calibrate ? calibrations_of(object, options, next(object.name + ", calibrating"))
                                                : std::vector<Calibration>();
    std::ranges::transform(calibrations, std::back_inserter(results.objects.back().notes),
                           [](const Calibration& one) { return in_words(one); });
    const auto contestants = options.contestants.empty()
                                 ? contestants_of(options.algorithms, options.sweeps, options.equilibrium, calibrations)
                                 : options.contestants;
    if (options.turned) {
      add_turned(results, object, contestants, options, next(object.name + ", turned"));
    }
    Contest contest(object, contestants, options);
    for (const RecordedMoves& moves : object.drags) {
      add_drag(results, contest, moves, references, next(object.name + ", " + moves.name));
      if (progress.cancelled()) {
        results.stopped = true;
        return results;
      }
      if (finished) {
        finished(results);
      }
    }
  }
  if (grows && !cases.empty()) {
    add_growths(results, cases.front(), options, progress.part(share_of_drags, 1));
    results.stopped = progress.cancelled();
  }
  progress.say("done");
  progress.show(1);
  return results;
}

}  // namespace chainmail::report
