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
  const CalibrationResult result = calibrate(object.mesh, Cuts(object.mesh), options, progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {options.algorithm, !info(options.scheme).sweeps, result.softness, result.sweeps,
          options.drags,     result.evaluations,           seconds,         {}};
}

void add_row(report::Results& results, const report::Contestant& contestant, const Residual& residual) {
  report::Row row{.drag = results.objects.front().drags.size(), .contestant = contestant};
  row.set(report::figures::relative, residual.relative);
  row.set(report::figures::error_rms, residual.rms);
  row.set(report::figures::error_max, residual.max);
  results.rows.push_back(std::move(row));
}

}  // namespace

report::Results results_of(const std::string& name, const Mesh& mesh, const CalibrationOptions& options,
                           const CalibrationResult& found) {
  const bool equilibrium = !info(options.scheme).sweeps;
  const report::Contestant before{options.algorithm, 0, equilibrium};
  const report::Contestant after{options.algorithm, found.sweeps, equilibrium, found.softness};
  const Material& material = options.elastic.material;
  report::Results results{.kind = report::ReportKind::calibrate,
                          .settings = {{"relaxation", std::string(info(options.scheme).name)},
                                       {"energy", std::string(info(options.energy).name)},
                                       {"young", material.young},
                                       {"poisson", material.poisson},
                                       {"seed", double(options.seed)},
                                       {"evaluations", double(found.evaluations)}}};
  results.objects.push_back({.name = name,
                             .description = "drags of random elements",
                             .elements = mesh.element_count(),
                             .links = mesh.link_count(),
                             .pins = options.pins.size(),
                             .reference = label(options.law) + " FEM on the same cells"});
  for (const auto& [what, tested] : {std::pair("fitted", &found.fitted), std::pair("held out", &found.held_out)}) {
    for (const CalibrationDrag& drag : tested->drags) {
      add_row(results, {}, drag.nothing);
      add_row(results, before, drag.before);
      add_row(results, after, drag.after);
      results.objects.front().drags.push_back({.name = what, .handle = drag.element, .moves = 1});
    }
  }
  return results;
}

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
