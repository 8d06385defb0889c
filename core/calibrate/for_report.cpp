#include "calibrate/for_report.h"

#include "calibrate/calibrate.h"
#include "report/run/clocks.h"

namespace chainmail {
namespace {

// A hundred sweeps would take most of the time of a comparison.
constexpr int drags = 3, evaluations = 60, most_sweeps = 10;

report::Calibration run(const report::Case& object, CalibrationOptions options, const std::stop_token& stop) {
  JobState job;
  const std::stop_callback cancel(stop, [&job] { job.cancelled = true; });
  CalibrationResult result;
  const double seconds = report::seconds_of(
      report::machine_clocks(), [&] { result = calibrate(object.mesh, Cuts(object.mesh), options, Progress(job)); });
  return {options.algorithm, result.softness, result.sweeps, options.drags, result.evaluations, seconds, {}};
}

}  // namespace

report::Calibrator calibrator_for_reports(RelaxationScheme scheme) {
  return [scheme](const report::Case& object, Algorithm algorithm, const std::vector<ElementId>& handles,
                  const std::stop_token& stop) {
    CalibrationOptions options;
    options.elastic = object.elastic;
    options.pins = object.pins;
    options.algorithm = algorithm;
    options.scheme = scheme;
    options.drags = drags;
    options.held_out = 0;
    options.evaluations = evaluations;
    options.most_sweeps = most_sweeps;
    options.not_these = handles;
    return run(object, options, stop);
  };
}

}  // namespace chainmail
