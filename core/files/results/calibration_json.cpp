#include "files/results/calibration_json.h"

#include <nlohmann/json.hpp>

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Residual& residual) {
  return {{"rms", residual.rms}, {"max", residual.max}, {"relative", residual.relative}};
}

Json to_json(const CalibrationDrag& drag) {
  return {{"element", drag.element},
          {"target", {drag.target.x(), drag.target.y(), drag.target.z()}},
          {"before", to_json(drag.before)},
          {"after", to_json(drag.after)},
          {"nothing", to_json(drag.nothing)}};
}

/// Residuals over some drags, and each drag.
Json to_json(const TestedDrags& tested) {
  Json drags = Json::array();
  for (const CalibrationDrag& drag : tested.drags) {
    drags.push_back(to_json(drag));
  }
  return {{"residual_before", to_json(tested.before)},
          {"residual", to_json(tested.after)},
          {"residual_nothing", to_json(tested.nothing)},
          {"drags", std::move(drags)}};
}

}  // namespace

void write_json(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result) {
  Json json{{"algorithm", info(options.algorithm).name},
            {"relaxation", options.scheme == RelaxationScheme::mean ? "mean" : "link"},
            {"young", options.elastic.material.young},
            {"poisson", options.elastic.material.poisson},
            {"seed", options.seed},
            {"pins", options.pins.size()},
            {"compression", result.softness.compression},
            {"stretch", result.softness.stretch},
            {"shear", result.softness.shear},
            {"sweeps", result.sweeps},
            {"evaluations", result.evaluations},
            {"held_out", to_json(result.held_out)}};
  json.update(to_json(result.fitted));
  out << json.dump(2) << '\n';
}

}  // namespace chainmail
