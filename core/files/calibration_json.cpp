#include "files/calibration_json.h"

#include <nlohmann/json.hpp>

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Residual& residual) { return {{"rms", residual.rms}, {"max", residual.max}}; }

Json to_json(const CalibrationDrag& drag) {
  return {{"element", drag.element},
          {"target", {drag.target.x(), drag.target.y(), drag.target.z()}},
          {"before", to_json(drag.before)},
          {"after", to_json(drag.after)}};
}

}  // namespace

void write_json(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result) {
  Json drags = Json::array();
  for (const CalibrationDrag& drag : result.drags) {
    drags.push_back(to_json(drag));
  }
  const Json json{{"algorithm", info(options.algorithm).name},
                  {"relaxation", options.scheme == RelaxationScheme::mean ? "mean" : "link"},
                  {"young", options.elastic.material.young},
                  {"poisson", options.elastic.material.poisson},
                  {"seed", options.seed},
                  {"pins", options.pins.size()},
                  {"compression", result.softness.compression},
                  {"stretch", result.softness.stretch},
                  {"shear", result.softness.shear},
                  {"sweeps", result.sweeps},
                  {"residual_before", to_json(Residual{result.rms_before, result.max_before})},
                  {"residual", to_json(Residual{result.rms, result.max})},
                  {"evaluations", result.evaluations},
                  {"drags", std::move(drags)}};
  out << json.dump(2) << '\n';
}

}  // namespace chainmail
