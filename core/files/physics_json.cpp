#include "files/physics_json.h"

#include "files/report_fields.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using namespace report;

// all_of() calls these: they must be known by then.
Json to_json(const PhysicsEntry& entry);
Json to_json(const PhysicsDrag& drag);
Json to_json(const PhysicsObject& object);
Json to_json(const GrowthSeries& series);
Json to_json(const PhysicsGrowth& growth);

template <class Items>
Json all_of(const Items& items) {
  Json json = Json::array();
  for (const auto& item : items) {
    json.push_back(to_json(item));
  }
  return json;
}

Json to_json(const PhysicalError& error) {
  return {{"rms", error.rms},
          {"max", error.max},
          {"moving_rms", error.moving_rms},
          {"moving_max", error.moving_max},
          {"moving_elements", error.moving}};
}

Json begin_with(const Contestant& contestant) {
  return {{"algorithm", info(contestant.algorithm).name}, {"sweeps", contestant.sweeps}};
}

Json to_json(const PhysicsEntry& entry) {
  Json json = begin_with(entry.contestant);
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  const PhysicsMeasurement& measured = *entry.measurement;
  json["ms_per_move"] = chainmail::to_json(measured.ms_per_move);
  json["prepare_ms"] = measured.prepare_ms;
  json["error"] = to_json(measured.error);
  return json;
}

Json to_json(const PhysicsDrag& drag) {
  return {{"name", drag.name},
          {"description", drag.description},
          {"moves", drag.moves},
          {"hand", drag.hand},
          {"no_truth", drag.no_truth.empty() ? Json() : Json(drag.no_truth)},
          {"contestants", all_of(drag.entries)}};
}

Json to_json(const PhysicsObject& object) {
  return {{"name", object.name},         {"description", object.description},
          {"elements", object.elements}, {"links", object.links},
          {"pins", object.pins},         {"drags", all_of(object.drags)}};
}

Json to_json(const GrowthSeries& series) {
  Json json = begin_with(series.contestant);
  json["end"] = series.end;
  json["exponent"] = series.growth ? Json(series.growth->exponent) : Json();
  json["sizes"] = Json::array();
  for (const GrowthPoint& point : series.points) {
    json["sizes"].push_back({{"elements", point.elements},
                             {"ms_per_move", point.ms_per_move},
                             {"prepare_ms", point.prepare_ms},
                             {"error", point.error ? to_json(*point.error) : Json()}});
  }
  return json;
}

Json to_json(const PhysicsGrowth& growth) {
  return {{"name", growth.name}, {"description", growth.description}, {"contestants", all_of(growth.series)}};
}

}  // namespace

void write_json(std::ostream& out, const PhysicsReport& report, const Origin& origin) {
  Json options = chainmail::to_json(report.options.contest);
  options["young"] = report.elastic.material.young;
  options["poisson"] = report.elastic.material.poisson;
  options["lattice"] = report.elastic.lattice;
  options["growth_seconds"] = report.options.growth_seconds;
  write_report(out, {{"origin", chainmail::to_json(origin)},
                     {"options", std::move(options)},
                     {"objects", all_of(report.objects)},
                     {"growths", all_of(report.growths)}});
}

}  // namespace chainmail
