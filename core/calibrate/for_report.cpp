#include "calibrate/for_report.h"

#include <chrono>

#include "calibrate/calibrate.h"

namespace chainmail {
namespace {

// A hundred sweeps would take most of the time of a comparison.
constexpr int drags = 3, evaluations = 60, max_sweeps = 10;
// The equilibrium has more numbers to find, and its evaluations are short.
constexpr int drags_at_equilibrium = 6, evaluations_at_equilibrium = 150;

report::Calibration run(const report::Case& object, const CalibrationOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const CalibrationResult result = calibrate(object.mesh, Cuts(object.mesh), options, progress.quiet());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {options.algorithm, !info(options.scheme).sweeps, result.softness, result.sweeps,
          options.drags,     result.evaluations,           seconds,         {}};
}

}  // namespace

report::Calibrator calibrator_for_reports(RelaxationScheme scheme) {
  return [scheme](const report::Case& object, Algorithm algorithm, bool equilibrium,
                  const std::vector<ElementId>& handles, const Progress& progress) {
    CalibrationOptions options;
    options.elastic = object.elastic;
    options.law = object.law;
    options.pins = object.pins;
    options.algorithm = algorithm;
    options.scheme = equilibrium ? RelaxationScheme::equilibrium : scheme;
    options.energy = energy_of_links(object.softness.energy);
    options.drags = equilibrium ? drags_at_equilibrium : drags;
    options.held_out = 0;
    options.evaluations = equilibrium ? evaluations_at_equilibrium : evaluations;
    options.max_sweeps = max_sweeps;
    options.not_these = handles;
    return run(object, options, progress);
  };
}

}  // namespace chainmail
