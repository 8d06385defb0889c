#include "chainmail/calibrate.h"

#include "api/access.h"

#ifdef CHAINMAIL_HAS_CALIBRATE

#include <ostream>

#include "calibrate/calibrate.h"
#include "files/results/report_json.h"

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

}  // namespace

Calibration calibrate(const Body& body, const CalibrateOptions& options, const Job& job) {
  return guarded([&] {
    const inner::Body& impl = Access::body(body);
    const CalibrationOptions how = calibration_of(impl, options);
    const CalibrationResult found = inner::calibrate(impl.mesh_pointer(), impl.cuts(), how, Access::progress(job));
    return Calibration{softness_of(found.softness), found.sweeps,
                       found.evaluations,           errors_of(found.fitted),
                       errors_of(found.held_out),   written([&](std::ostream& out) { write_json(out, how, found); })};
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

#ifdef CHAINMAIL_HAS_JSON

#include "files/session/softness_presets.h"
#include "files/text/text.h"

namespace chainmail::api {

void write_preset(const std::filesystem::path& path, const std::string& name, const LinkSoftness& softness) {
  if (const std::string fault = fault_of_name(name); !fault.empty()) {
    throw Error("preset " + in_quotes(name), "this cannot be its name", fault);
  }
  guarded([&] {
    inner::check(softness_of(softness));
    const std::vector<SoftnessPreset> one{{name, softness_of(softness)}};
    write_file(path, [&](std::ostream& out) { write_presets(out, one); });
  });
}

}  // namespace chainmail::api

#else

namespace chainmail::api {

void write_preset(const std::filesystem::path& path, const std::string& /*name*/, const LinkSoftness& /*softness*/) {
  refuse_without("nlohmann/json", path.string());
}

}  // namespace chainmail::api

#endif
