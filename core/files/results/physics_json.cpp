#include "files/results/physics_json.h"

#include "files/results/report_fields.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using namespace report;

// all_of() calls these: they must be known by then.
Json to_json(const PhysicsEntry& entry);
Json to_json(const PhysicsDrag& drag);
Json to_json(const PhysicsObject& object);
Json to_json(const Calibration& calibration);
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
  return {{"relative", error.relative},
          {"rms", error.rms},
          {"max", error.max},
          {"moving_rms", error.moving_rms},
          {"moving_max", error.moving_max},
          {"moving_elements", error.moving}};
}

Json to_json(const LinkSoftness& softness) {
  return {{"compression", softness.compression}, {"stretch", softness.stretch}, {"shear", softness.shear}};
}

Json begin_with(const PhysicsContestant& contestant) {
  return {{"algorithm", name(contestant)},
          {"label", label(contestant)},
          {"sweeps", contestant.sweeps},
          {"calibrated", contestant.calibrated ? to_json(*contestant.calibrated) : Json()}};
}

/// None where nothing was timed.
Json spread_or_none(const TimeSpread& ms) { return ms.count == 0 ? Json() : chainmail::to_json(ms); }

Json to_json(const PhysicsEntry& entry) {
  Json json = begin_with(entry.contestant);
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  const PhysicsMeasurement& measured = *entry.measurement;
  json["ms_per_move"] = chainmail::to_json(measured.ms_per_move);
  json["first_move_ms"] = spread_or_none(measured.first_move);
  json["move_after_cut_ms"] = spread_or_none(measured.move_after_cut);
  json["prepare_ms"] = measured.prepare.ms();
  json["factorize_ms"] = spread_or_none(measured.prepare.factorize);
  json["grab_ms"] = spread_or_none(measured.prepare.grab);
  json["error"] = to_json(measured.error);
  return json;
}

Json to_json(const PhysicsDrag& drag) {
  return {{"name", drag.name},
          {"description", drag.description},
          {"handle", drag.handle},
          {"moves", drag.moves},
          {"cut_before_last_move", drag.has_cut},
          {"hand", drag.hand},
          {"no_truth", drag.no_truth.empty() ? Json() : Json(drag.no_truth)},
          {"contestants", all_of(drag.entries)}};
}

Json to_json(const Calibration& calibration) {
  Json json{{"algorithm", info(calibration.algorithm).name}};
  if (!calibration.refusal.empty()) {
    json["refusal"] = calibration.refusal;
    return json;
  }
  json.update(to_json(calibration.softness));
  json["sweeps"] = calibration.sweeps;
  json["drags"] = calibration.drags;
  json["evaluations"] = calibration.evaluations;
  json["seconds"] = calibration.seconds;
  return json;
}

Json to_json(const PhysicsObject& object) {
  return {{"name", object.name},
          {"description", object.description},
          {"elements", object.elements},
          {"links", object.links},
          {"pins", object.pins},
          {"drags", all_of(object.drags)},
          {"calibrations", all_of(object.calibrations)}};
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
