#include "files/results/report_json.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "files/results/json_kind.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

// all_of() calls these: they must be declared before it.
Json to_json(const report::Entry& entry);
Json to_json(const report::DragResult& drag);
Json to_json(const report::CaseResult& object);
Json to_json(const report::PhysicsEntry& entry);
Json to_json(const report::PhysicsDrag& drag);
Json to_json(const report::PhysicsObject& object);
Json to_json(const report::Calibration& calibration);
Json to_json(const report::Symmetry& symmetry);
Json to_json(const report::GrowthSeries& series);
Json to_json(const report::PhysicsGrowth& growth);
Json to_json(const report::RampVerdict& verdict);
Json to_json(const report::RampRow& row);
Json to_json(const CalibrationDrag& drag);

template <class Items>
Json all_of(const Items& items) {
  Json json = Json::array();
  for (const auto& item : items) {
    json.push_back(to_json(item));
  }
  return json;
}

Json to_json(const TimeSpread& ms) {
  return {{"median", ms.median},
          {"lower_quartile", ms.lower_quartile},
          {"upper_quartile", ms.upper_quartile},
          {"min", ms.min},
          {"max", ms.max},
          {"repetitions", ms.count}};
}

Json to_json(const report::CompareOptions& options) {
  return {{"relaxation", info(options.scheme).name},
          {"relax_step", options.relax_step},
          {"precision", options.precision == Precision::single_precision ? "float" : "double"}};
}

Json to_json(const report::Origin& origin) {
  const report::Machine& machine = origin.machine;
  return {{"date", origin.date},
          {"version", origin.version},
          {"command_line", origin.command_line},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"build", machine.build}};
}

/// Names from outside may not be UTF-8: invalid bytes become the replacement character.
void write_report(std::ostream& out, const Json& json) {
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

Json to_json(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json to_json(const std::optional<Distance>& distance) {
  return distance ? Json{{"max", distance->max}, {"rms", distance->rms}} : Json();
}

Json to_json(const report::ShapeFigures& shape) {
  return {{"hausdorff", to_json(shape.hausdorff)},
          {"volume_change", to_json(shape.volume_change)},
          {"inverted_cells", shape.inverted_cells ? Json(*shape.inverted_cells) : Json()},
          {"largest_stretch", to_json(shape.stretch)},
          {"violation_max", shape.violation}};
}

Json to_json(const report::Errors& errors) {
  const Violation& violation = errors.violation;
  return {{"violation", {{"max", violation.max}, {"rms", violation.rms}, {"fraction", violation.fraction}}},
          {"distance_to_exact", to_json(errors.to_exact)},
          {"energy_over_exact", to_json(errors.energy_over_exact)},
          {"float_to_double", to_json(std::optional(errors.float_to_double))},
          {"largest_over_hand", to_json(errors.largest_over_handle)},
          {"distance_to_equilibrium", to_json(errors.to_equilibrium)},
          {"shape", to_json(errors.shape)}};
}

Json to_json(const report::Entry& entry) {
  Json json{{"algorithm", info(entry.contestant.algorithm).name},
            {"sweeps", entry.contestant.sweeps},
            {"equilibrium", entry.contestant.equilibrium}};
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  const report::Measurement& measurement = *entry.measurement;
  json["ms_per_move"] = to_json(measurement.ms_per_move);
  json["worst_move_ms"] = measurement.worst_move_ms;
  json["checked"] = measurement.checked;
  json["moved"] = measurement.moved;
  json.update(to_json(measurement.errors));
  return json;
}

Json to_json(const report::DragResult& drag) {
  return {{"name", drag.name},
          {"description", drag.description},
          {"moves", drag.moves},
          {"no_exact", drag.no_exact.empty() ? Json() : Json(drag.no_exact)},
          {"contestants", all_of(drag.entries)}};
}

Json to_json(const report::CaseResult& object) {
  return {{"name", object.name},
          {"description", object.description},
          {"elements", object.elements},
          {"links", object.links},
          {"drags", all_of(object.drags)}};
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
  Json json = Json::object();
  for (const auto& [parameter, value] : softness_numbers) {
    json[std::string(parameter->name)] = softness.*value;
  }
  return json;
}

Json begin_with(const report::PhysicsContestant& contestant) {
  return {{"algorithm", name(contestant)},
          {"label", label(contestant)},
          {"sweeps", contestant.sweeps},
          {"equilibrium", contestant.equilibrium},
          {"open_regions", contestant.open_regions},
          {"calibrated", contestant.calibrated ? to_json(*contestant.calibrated) : Json()}};
}

/// Returns null if nothing was timed.
Json spread_or_none(const TimeSpread& ms) { return ms.count == 0 ? Json() : to_json(ms); }

Json to_json(const report::PhysicsEntry& entry) {
  Json json = begin_with(entry.contestant);
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  const report::PhysicsMeasurement& measured = *entry.measurement;
  json["ms_per_move"] = to_json(measured.ms_per_move);
  json["first_move_ms"] = spread_or_none(measured.first_move);
  json["move_after_cut_ms"] = spread_or_none(measured.move_after_cut);
  json["prepare_ms"] = measured.prepare.ms();
  json["factorize_ms"] = spread_or_none(measured.prepare.factorize);
  json["grab_ms"] = spread_or_none(measured.prepare.grab);
  json["error"] = to_json(measured.error);
  json["shape"] = to_json(measured.shape);
  if (measured.residual) {
    json["residual"] = *measured.residual;
  }
  if (measured.binds) {
    json["regions_bind"] = *measured.binds;
  }
  return json;
}

/// Returns null if the reference was computed on the object's own cells.
Json refined_of(const std::optional<ConvergedReference>& reference) {
  if (!reference) {
    return {};
  }
  Json levels = Json::array();
  for (const ReferenceLevel& level : reference->levels) {
    levels.push_back({{"elements", level.elements}, {"change", level.change ? Json(*level.change) : Json()}});
  }
  return {{"levels", std::move(levels)},
          {"order", reference->order ? Json(*reference->order) : Json()},
          {"converged", reference->converged},
          {"end", reference->end}};
}

Json to_json(const report::PhysicsDrag& drag) {
  return {{"name", drag.name},
          {"refined_reference", refined_of(drag.refined)},
          {"description", drag.description},
          {"handle", drag.handle},
          {"moves", drag.moves},
          {"cut_before_last_move", drag.has_cut},
          {"hand", drag.handle_displacement},
          {"no_truth", drag.no_reference.empty() ? Json() : Json(drag.no_reference)},
          {"contestants", all_of(drag.entries)}};
}

Json to_json(const report::Calibration& calibration) {
  Json json{{"algorithm", info(calibration.algorithm).name}, {"equilibrium", calibration.equilibrium}};
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

/// Returns the material of a reference solution, with the parameter of its law.
Json material_of(const StrainLaw& law) {
  Json json{{"law", name(law.kind)}};
  if (law.kind == StrainLaw::Kind::gent) {
    json["gent_limit"] = law.gent_limit;
  } else if (law.kind == StrainLaw::Kind::fung) {
    json["fung_exponent"] = law.fung_exponent;
  }
  return json;
}

Json to_json(const report::Symmetry& symmetry) {
  Json json = begin_with(symmetry.contestant);
  if (!symmetry.refusal.empty()) {
    json["refusal"] = symmetry.refusal;
    return json;
  }
  json["turns"] = Json::array();
  for (const report::TurnDifference& turn : symmetry.turns) {
    json["turns"].push_back({{"degrees", turn.degrees}, {"max", turn.max}, {"relative", turn.relative}});
  }
  return json;
}

Json to_json(const report::PhysicsObject& object) {
  return {{"name", object.name},
          {"description", object.description},
          {"elements", object.elements},
          {"links", object.links},
          {"pins", object.pins},
          {"material", material_of(object.law)},
          {"drags", all_of(object.drags)},
          {"calibrations", all_of(object.calibrations)},
          {"turned_object", all_of(object.symmetry)}};
}

Json to_json(const report::GrowthSeries& series) {
  Json json = begin_with(series.contestant);
  json["end"] = series.end;
  json["exponent"] = series.growth ? Json(series.growth->power) : Json();
  json["sizes"] = Json::array();
  for (const report::GrowthPoint& point : series.points) {
    json["sizes"].push_back({{"elements", point.elements},
                             {"ms_per_move", point.ms_per_move},
                             {"prepare_ms", point.prepare_ms},
                             {"error", point.error ? to_json(*point.error) : Json()}});
  }
  return json;
}

Json to_json(const report::PhysicsGrowth& growth) {
  return {{"name", growth.name}, {"description", growth.description}, {"contestants", all_of(growth.series)}};
}

Json to_json(const report::RampVerdict& verdict) {
  Json json{{"algorithm", info(verdict.algorithm).name}, {"largest_width", nullptr}, {"lost", verdict.lost}};
  if (verdict.largest_width) {
    json["largest_width"] = *verdict.largest_width;
  }
  json["growth"] = nullptr;
  if (const auto& growth = verdict.growth) {
    json["growth"] = {
        {"exponent", growth->power}, {"from", growth->from}, {"to", growth->to}, {"sizes", growth->sizes}};
  }
  return json;
}

Json to_json(const report::RampRow& row) {
  return {{"width", row.width},       {"elements", row.elements},
          {"links", row.links},       {"algorithm", info(row.algorithm).name},
          {"passes", row.passes},     {"median_ms", row.median_ms},
          {"p99_ms", row.p99_ms},     {"mean_moved", row.mean_moved},
          {"repeated", row.repeated}, {"real_time", row.in_real_time}};
}

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

/// Returns residuals over all drags, and those of each drag.
Json to_json(const TestedDrags& tested) {
  return {{"residual_before", to_json(tested.before)},
          {"residual", to_json(tested.after)},
          {"residual_nothing", to_json(tested.nothing)},
          {"drags", all_of(tested.drags)}};
}

}  // namespace

void write_json(std::ostream& out, const report::Comparison& comparison, const report::Origin& origin) {
  const Json json{
      {"origin", to_json(origin)}, {"options", to_json(comparison.options)}, {"objects", all_of(comparison.cases)}};
  write_report(out, of_kind(json_kinds::compare, json));
}

void write_json(std::ostream& out, const report::PhysicsReport& report, const report::Origin& origin) {
  Json options = to_json(report.options.contest);
  options["young"] = report.elastic.material.young;
  options["poisson"] = report.elastic.material.poisson;
  options["lattice"] = report.elastic.lattice;
  options["iterations"] = report.elastic.iterations;
  options["growth_seconds"] = report.options.growth_seconds;
  const Json json{{"origin", to_json(origin)},
                  {"options", std::move(options)},
                  {"objects", all_of(report.objects)},
                  {"growths", all_of(report.growths)}};
  write_report(out, of_kind(json_kinds::physics, json));
}

void write_json(std::ostream& out, const report::Ramp& ramp, const report::Machine& machine) {
  const report::RampOptions& options = ramp.options;
  const Json json{{"machine",
                   {{"processor", machine.processor},
                    {"cores", machine.cores},
                    {"compiler", machine.compiler},
                    {"build", machine.build}}},
                  {"seed", options.seed},
                  {"budget", options.budget},
                  {"precision", options.precision == Precision::single_precision ? "float" : "double"},
                  {"softness", to_json(options.softness)},
                  {"drags", options.drags},
                  {"moves", options.moves},
                  {"largest", options.largest},
                  {"seconds", ramp.seconds},
                  {"stopped", ramp.stopped},
                  {"algorithms", all_of(ramp.verdicts)},
                  {"sizes", all_of(ramp.rows)}};
  write_report(out, of_kind(json_kinds::ramp, json));
}

void write_json(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result) {
  Json json{{"algorithm", info(options.algorithm).name},
            {"relaxation", info(options.scheme).name},
            {"young", options.elastic.material.young},
            {"poisson", options.elastic.material.poisson},
            {"seed", options.seed},
            {"pins", options.pins.size()},
            {"energy", info(options.energy).name},
            {"sweeps", result.sweeps},
            {"evaluations", result.evaluations},
            {"held_out", to_json(result.held_out)}};
  json.update(to_json(result.softness));
  json.update(to_json(result.fitted));
  out << of_kind(json_kinds::calibrate, json).dump(2) << '\n';
}

}  // namespace chainmail
