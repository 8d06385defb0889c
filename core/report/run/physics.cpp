#include "report/run/physics.h"

#include <algorithm>
#include <array>

#include "mesh/error.h"
#include "report/run/contest.h"
#include "report/run/drag_reference.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/run/runner.h"

namespace chainmail::report {
namespace {

// Only these algorithms are calibrated: calibration takes longer than a drag, and the other algorithms of the family
// differ little from them.
constexpr std::array calibrated_algorithms{Algorithm::natural_queue, Algorithm::exact};
constexpr double share_of_drags = 0.6;  // share of the progress, if growth is measured too

PhysicsOptions checked(PhysicsOptions options) {
  if (options.contest.algorithms.empty()) {
    for (const AlgorithmInfo& one : every_algorithm()) {
      options.contest.algorithms.push_back(one.algorithm);
    }
  }
  check(options.contest);
  if (!(options.growth_seconds >= 0)) {
    throw Error("grow", "the time is below 0", "use 0 or more seconds");
  }
  return options;
}

PhysicsDrag drag_of(Contest& contest, const RecordedMoves& moves, DragReferences& references,
                    const Progress& progress) {
  PhysicsDrag drag{moves.name, moves.description, handle_of(moves), count_moves(moves), !cuts_of(moves).empty(), 0, {},
                   {}};
  try {
    DragReference reference = references.at_end(moves);
    drag.handle_displacement = reference.solution.handle_displacement;
    drag.entries = contest.run(moves, reference.solution, progress);
    drag.refined = std::move(reference.refined);
  } catch (const Error& error) {
    drag.no_reference = error.what();
  }
  return drag;
}

/// Returns the progress of a part of the comparison, with its text.
Progress part_of(const Progress& whole, double index, double count, const std::string& text) {
  Progress part = whole.part(index / count, (index + 1) / count);
  part.say(text);
  return part;
}

void add_growths(PhysicsReport& report, const Softness& softness, const Progress& progress) {
  const PhysicsOptions& options = report.options;
  const ElasticOptions elastic = report.elastic;
  report.growths.push_back(grow(
      "bar", "tetrahedra, pinned at the left layer, pulled",
      [&](std::uint64_t elements) { return pinned_bar(elements, softness, elastic, false); }, options,
      part_of(progress, 0, 2, "growing bar")));
  report.growths.push_back(grow(
      "sheet", "triangles in a plane, pinned at the top layer, pulled",
      [&](std::uint64_t elements) { return pinned_sheet(elements, softness, elastic, false); }, options,
      part_of(progress, 1, 2, "growing sheet")));
}

}  // namespace

std::vector<Calibration> calibrations_of(const Case& object, const PhysicsOptions& options, const Progress& progress) {
  std::vector<Calibration> found;
  const std::vector<ElementId> handles = handles_of(object);
  for (const Algorithm algorithm : calibrated_algorithms) {
    const bool takes_part = std::ranges::count(options.contest.algorithms, algorithm) != 0;
    for (const bool equilibrium : {false, true}) {
      const bool wanted = equilibrium ? options.contest.equilibrium && takes_part_at_equilibrium(algorithm)
                                      : !options.contest.sweeps.empty();
      if (!options.calibrate || !wanted || !takes_part || !fits(algorithm, *object.mesh) || progress.cancelled()) {
        continue;
      }
      progress.show(0);
      try {
        found.push_back(options.calibrate(object, algorithm, equilibrium, handles, progress));
      } catch (const Error& error) {
        found.push_back({algorithm, equilibrium, {}, 0, 0, 0, 0, error.what()});
      } catch (const Cancelled&) {
        return found;
      }
    }
  }
  return found;
}

PhysicsReport compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& asked,
                                   const Progress& progress) {
  PhysicsReport report{checked(asked), cases.empty() ? ElasticOptions() : cases.front().elastic, {}, {}, false};
  std::size_t drags = 0;
  for (const Case& object : cases) {
    drags += object.drags.size();
  }
  const bool grows = report.options.growth_seconds > 0;
  const Progress of_drags = progress.part(0, grows ? share_of_drags : 1);
  double done = 0;
  const auto of_drag = [&](const std::string& text) { return part_of(of_drags, done, double(drags), text); };
  for (const Case& object : cases) {
    PhysicsObject& result = report.objects.emplace_back();
    result = {object.name,
              object.description,
              object.mesh->element_count(),
              object.mesh->link_count(),
              object.pins.size(),
              {},
              {},
              object.law};
    DragReferences references(object, report.options.refine);
    const CompareOptions& how = report.options.contest;
    result.calibrations = calibrations_of(object, report.options, of_drag(object.name + ", calibrating"));
    const auto contestants = contestants_of(how.algorithms, how.sweeps, how.equilibrium, result.calibrations);
    result.symmetry = symmetry_under_rotation(object, contestants, how, of_drag(object.name + ", turned"));
    CompareOptions to_own_limit = how;
    to_own_limit.own_limit = own_limit_of_comparisons;
    Contest contest(object, contestants, to_own_limit);
    for (const RecordedMoves& moves : object.drags) {
      const Progress part = of_drag(object.name + ", " + moves.name);
      part.show(0);
      PhysicsDrag drag = drag_of(contest, moves, references, part);
      if (progress.cancelled()) {
        report.stopped = true;
        return report;
      }
      result.drags.push_back(std::move(drag));
      ++done;
    }
  }
  if (grows && !cases.empty()) {
    add_growths(report, {cases.front().softness.global, {}}, progress.part(share_of_drags, 1));
    report.stopped = progress.cancelled();
  }
  progress.say("done");
  progress.show(1);
  return report;
}

}  // namespace chainmail::report
