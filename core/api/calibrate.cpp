#include "chainmail/calibrate.h"

#include "api/access.h"
#include "chainmail/text.h"

#ifdef CHAINMAIL_HAS_CALIBRATE

#include <ostream>

#include "calibrate/calibrate.h"
#include "files/results/report_json.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"

namespace chainmail::api {
namespace {

void check_at_least_one(const std::string& name, int value) {
  if (value < 1) {
    throw Error(name, "it is below 1", "use 1 or more");
  }
}

CalibrationOptions calibration_of(const inner::Body& body, const CalibrateOptions& options) {
  check_at_least_one("drags", options.drags);
  check_at_least_one("held_out", options.held_out);
  check_at_least_one("evaluations", options.evaluations);
  if (options.most_sweeps < 0) {
    throw Error("most_sweeps", "it is below 0", "use 0 or more");
  }
  CalibrationOptions how;
  how.elastic = body.elastic();
  how.pins.assign(body.pins().begin(), body.pins().end());
  how.algorithm = algorithm_of(options.method);
  how.seed = options.seed;
  how.drags = options.drags;
  how.held_out = options.held_out;
  how.evaluations = options.evaluations;
  how.max_sweeps = options.most_sweeps;
  how.scheme = scheme_of(options.scheme);
  how.energy = inner::energy_of_links(body.softness().energy);
  return how;
}

PhysicalError error_of_residual(const Residual& residual) { return {residual.relative, residual.rms, residual.max}; }

CalibrationErrors errors_of(const TestedDrags& tested) {
  return {error_of_residual(tested.nothing), error_of_residual(tested.before), error_of_residual(tested.after)};
}

/// Writes rows of residuals: relative, RMS and max.
void write_residuals(std::ostream& out, const TestedDrags& tested, bool at_equilibrium) {
  std::vector<std::vector<std::string>> rows{{"", "relative", "RMS", "max"}};
  const auto add = [&](const std::string& what, const Residual& residual) {
    rows.push_back({what, figure(residual.relative), figure(residual.rms), figure(residual.max)});
  };
  add("nothing moves", tested.nothing);
  add(at_equilibrium ? "defaults" : "defaults, no sweeps", tested.before);
  add("calibrated", tested.after);
  for (const CalibrationDrag& drag : tested.drags) {
    add("  element " + std::to_string(drag.element) + ", before", drag.before);
    add("  element " + std::to_string(drag.element) + ", after", drag.after);
  }
  report::write_columns(out, rows);
}

void write_calibration(std::ostream& out, const CalibrationOptions& how, const CalibrationResult& result) {
  const bool at_equilibrium = !info(how.scheme).sweeps;
  out << info(how.algorithm).label << " comes closest to neo-Hookean FEM on the same cells (Young's modulus "
      << figure(how.elastic.material.young) << ", Poisson's ratio " << figure(how.elastic.material.poisson)
      << ") with\n  " << report::region_in_words(result.softness) << ", ";
  if (at_equilibrium) {
    out << report::energy_in_words(result.softness) << ", at equilibrium (" << info(how.energy).name << " energy)";
  } else {
    out << result.sweeps << " sweeps per move";
  }
  out << "\nRelative error, and RMS and max over the handle's displacement. An object that does not move has a\n"
         "relative error of about 1.\nDrags used by the search ("
      << result.fitted.drags.size() << ", " << result.evaluations << " evaluations):\n";
  write_residuals(out, result.fitted, at_equilibrium);
  out << "Drags not used by the search (" << result.held_out.drags.size() << "):\n";
  write_residuals(out, result.held_out, at_equilibrium);
}

}  // namespace

Calibration calibrate(const Body& body, const CalibrateOptions& options, const Job& job) {
  return guarded([&] {
    const inner::Body& impl = Access::body(body);
    const CalibrationOptions how = calibration_of(impl, options);
    const CalibrationResult found = inner::calibrate(impl.mesh_pointer(), impl.cuts(), how, Access::progress(job));
    return Calibration{softness_of(found.softness),
                       found.sweeps,
                       found.evaluations,
                       errors_of(found.fitted),
                       errors_of(found.held_out),
                       written([&](std::ostream& out) { write_calibration(out, how, found); }),
                       written([&](std::ostream& out) { write_json(out, how, found); })};
  });
}

}  // namespace chainmail::api

#else

namespace chainmail::api {

Calibration calibrate(const Body& /*body*/, const CalibrateOptions& /*options*/, const Job& /*job*/) {
  refuse_without("NLopt and nlohmann/json", "calibrate");
}

}  // namespace chainmail::api

#endif
