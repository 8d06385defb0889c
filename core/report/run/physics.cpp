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
                    const std::function<void(double)>& tell, const std::stop_token& stop) {
  PhysicsDrag drag{moves.name, moves.description, handle_of(moves), count_moves(moves), !cuts_of(moves).empty(), 0, {},
                   {}};
  try {
    DragReference reference = references.at_end(moves);
    drag.handle_displacement = reference.solution.handle_displacement;
    drag.entries = contest.run(moves, reference.solution, tell, stop);
    drag.refined = std::move(reference.refined);
  } catch (const Error& error) {
    drag.no_reference = error.what();
  }
  return drag;
}

/// Converts the progress of the parts to progress of the whole comparison.
class ProgressReporter {
 public:
  ProgressReporter(const Progress& progress, std::size_t drags, bool grows)
      : progress_(progress), drags_(drags), grows_(grows) {}

  std::function<void(double)> of_drag(const std::string& text) const {
    return [this, text, begin = done_](double share) {
      tell((grows_ ? share_of_drags : 1) * (double(begin) + share) / double(drags_), text);
    };
  }
  void drag_is_done() { ++done_; }
  std::function<void(double)> of_growth(const std::string& text, int which, int of) const {
    return [this, text, which, of](double share) {
      tell(share_of_drags + (1 - share_of_drags) * (which + share) / of, text);
    };
  }
  void tell(double share, const std::string& text) const {
    if (progress_) {
      progress_(share, text);
    }
  }

 private:
  const Progress& progress_;
  std::size_t drags_, done_ = 0;
  bool grows_;
};

void add_growths(PhysicsReport& report, const Softness& softness, const ProgressReporter& reporter,
                 const std::stop_token& stop) {
  const PhysicsOptions& options = report.options;
  const ElasticOptions elastic = report.elastic;
  report.growths.push_back(grow(
      "bar", "tetrahedra, pinned at the left layer, pulled",
      [&](std::uint64_t elements) { return pinned_bar(elements, softness, elastic, false); }, options,
      reporter.of_growth("growing bar", 0, 2), stop));
  report.growths.push_back(grow(
      "sheet", "triangles in a plane, pinned at the top layer, pulled",
      [&](std::uint64_t elements) { return pinned_sheet(elements, softness, elastic, false); }, options,
      reporter.of_growth("growing sheet", 1, 2), stop));
}

}  // namespace

std::vector<Calibration> calibrations_of(const Case& object, const PhysicsOptions& options,
                                         const std::function<void(double)>& tell, const std::stop_token& stop) {
  std::vector<Calibration> found;
  const std::vector<ElementId> handles = handles_of(object);
  for (const Algorithm algorithm : calibrated_algorithms) {
    const bool takes_part = std::ranges::count(options.contest.algorithms, algorithm) != 0;
    for (const bool equilibrium : {false, true}) {
      const bool wanted = equilibrium ? options.contest.equilibrium && takes_part_at_equilibrium(algorithm)
                                      : !options.contest.sweeps.empty();
      if (!options.calibrate || !wanted || !takes_part || !fits(algorithm, *object.mesh) || stop.stop_requested()) {
        continue;
      }
      tell(0);
      try {
        found.push_back(options.calibrate(object, algorithm, equilibrium, handles, stop));
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
                                   const Progress& progress, const std::stop_token& stop) {
  PhysicsReport report{checked(asked), cases.empty() ? ElasticOptions() : cases.front().elastic, {}, {}, false};
  std::size_t drags = 0;
  for (const Case& object : cases) {
    drags += object.drags.size();
  }
  ProgressReporter reporter(progress, drags, report.options.growth_seconds > 0);
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
    result.calibrations =
        calibrations_of(object, report.options, reporter.of_drag(object.name + ", calibrating"), stop);
    const auto contestants = contestants_of(how.algorithms, how.sweeps, how.equilibrium, result.calibrations);
    result.symmetry =
        symmetry_under_rotation(object, contestants, how, reporter.of_drag(object.name + ", turned"), stop);
    CompareOptions to_own_limit = how;
    to_own_limit.own_limit = own_limit_of_comparisons;
    Contest contest(object, contestants, to_own_limit);
    for (const RecordedMoves& moves : object.drags) {
      const auto tell = reporter.of_drag(object.name + ", " + moves.name);
      tell(0);
      PhysicsDrag drag = drag_of(contest, moves, references, tell, stop);
      if (stop.stop_requested()) {
        report.stopped = true;
        return report;
      }
      result.drags.push_back(std::move(drag));
      reporter.drag_is_done();
    }
  }
  if (report.options.growth_seconds > 0 && !cases.empty()) {
    add_growths(report, {cases.front().softness.global, {}}, reporter, stop);
    report.stopped = stop.stop_requested();
  }
  reporter.tell(1, "done");
  return report;
}

}  // namespace chainmail::report
