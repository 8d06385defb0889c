#include "files/results/report_json.h"

#include "files/results/report_fields.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using namespace report;

Json to_json(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json to_json(const std::optional<Distance>& distance) {
  return distance ? Json{{"max", distance->max}, {"rms", distance->rms}} : Json();
}

Json to_json(const Errors& errors) {
  const Violation& violation = errors.violation;
  return {{"violation", {{"max", violation.max}, {"rms", violation.rms}, {"fraction", violation.fraction}}},
          {"distance_to_exact", to_json(errors.to_exact)},
          {"energy_over_exact", to_json(errors.energy_over_exact)},
          {"float_to_double", to_json(std::optional(errors.float_to_double))},
          {"largest_over_hand", to_json(errors.largest_over_hand)},
          {"distance_to_equilibrium", to_json(errors.to_equilibrium)}};
}

Json to_json(const Entry& entry) {
  Json json{{"algorithm", info(entry.contestant.algorithm).name}, {"sweeps", entry.contestant.sweeps}};
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  const Measurement& measurement = *entry.measurement;
  json["ms_per_move"] = to_json(measurement.ms_per_move);
  json["worst_move_ms"] = measurement.worst_move_ms;
  json["checked"] = measurement.checked;
  json["moved"] = measurement.moved;
  json.update(to_json(measurement.errors));
  return json;
}

Json to_json(const DragResult& drag) {
  Json contestants = Json::array();
  for (const Entry& entry : drag.entries) {
    contestants.push_back(to_json(entry));
  }
  return {{"name", drag.name},
          {"description", drag.description},
          {"moves", drag.moves},
          {"no_exact", drag.no_exact.empty() ? Json() : Json(drag.no_exact)},
          {"contestants", std::move(contestants)}};
}

Json to_json(const CaseResult& object) {
  Json drags = Json::array();
  for (const DragResult& drag : object.drags) {
    drags.push_back(to_json(drag));
  }
  return {{"name", object.name},
          {"description", object.description},
          {"elements", object.elements},
          {"links", object.links},
          {"drags", std::move(drags)}};
}

}  // namespace

void write_json(std::ostream& out, const Comparison& comparison, const Origin& origin) {
  Json objects = Json::array();
  for (const CaseResult& object : comparison.cases) {
    objects.push_back(to_json(object));
  }
  const Json json{
      {"origin", to_json(origin)}, {"options", to_json(comparison.options)}, {"objects", std::move(objects)}};
  write_report(out, json);
}

}  // namespace chainmail
