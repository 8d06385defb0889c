#include "files/results/report_json.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "files/results/json_kind.h"
#include "report/page/compared_figures.h"
#include "report/page/physics_figures.h"
#include "report/page/ramp_page.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;

template <class Items>
Json all_of(const Items& items, Json (*convert)(const typename Items::value_type&)) {
  Json json = Json::array();
  for (const auto& item : items) {
    json.push_back(convert(item));
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

Json to_json(const report::Machine& machine) {
  return {{"processor", machine.processor},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"build", machine.build}};
}

Json to_json(const report::Origin& origin) {
  Json json{{"date", origin.date}, {"version", origin.version}, {"command_line", origin.command_line}};
  json.update(to_json(origin.machine));
  return json;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// Names from outside may not be UTF-8: invalid bytes become the replacement character.
void write_report(std::ostream& out, const Json& json) {
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

Json to_json(const report::FigureValue& value) {
  return std::visit(
      []<class Value>(const Value& one) -> Json {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return {};
        } else if constexpr (std::is_same_v<Value, TimeSpread>) {
          return to_json(one);
        } else {
          return one;
        }
      },
      static_cast<const report::FigureValue::variant&>(value));
}

/// Returns the figures of a row that JSON shows. An object in which all of them are none is null itself.
template <class Row>
Json figures_of(const Row& row, std::span<const report::Figure<Row>> figures) {
  Json json = Json::object();
  for (const report::Figure<Row>& figure : figures) {
    Json value = figure.path.empty() ? Json() : to_json(figure.value(row));
    if (!figure.path.empty() && !(figure.is_rare && value.is_null())) {
      json[Json::json_pointer(std::string(figure.path))] = std::move(value);
    }
  }
  for (Json& member : json) {
    if (member.is_object() && std::ranges::all_of(member, [](const Json& one) { return one.is_null(); })) {
      member = nullptr;
    }
  }
  return json;
}

Json to_json(const report::Entry& entry) {
  Json json{{"algorithm", info(entry.contestant.algorithm).name},
            {"sweeps", entry.contestant.sweeps},
            {"equilibrium", entry.contestant.equilibrium}};
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  json.update(figures_of<report::ComparedRow>({.entry = &entry}, report::compared_figures()));
  return json;
}

Json to_json(const report::DragResult& drag) {
  return {{"name", drag.name},
          {"description", drag.description},
          {"moves", drag.moves},
          {"no_exact", drag.no_exact.empty() ? Json() : Json(drag.no_exact)},
          {"contestants", all_of(drag.entries, to_json)}};
}

Json to_json(const report::CaseResult& object) {
  return {{"name", object.name},
          {"description", object.description},
          {"elements", object.elements},
          {"links", object.links},
          {"drags", all_of(object.drags, to_json)}};
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

Json to_json(const report::PhysicsEntry& entry) {
  Json json = begin_with(entry.contestant);
  if (!entry.measurement) {
    json["refusal"] = entry.refusal;
    return json;
  }
  json.update(figures_of<report::PhysicsRow>({.entry = &entry}, report::physics_figures()));
  return json;
}

/// Returns null if the reference was computed on the object's own cells.
Json refined_of(const std::optional<ConvergedReference>& reference) {
  if (!reference) {
    return {};
  }
  Json levels = Json::array();
  for (const ReferenceLevel& level : reference->levels) {
    levels.push_back({{"elements", level.elements}, {"change", or_null(level.change)}});
  }
  return {{"levels", std::move(levels)},
          {"order", or_null(reference->order)},
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
          {"contestants", all_of(drag.entries, to_json)}};
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
          {"drags", all_of(object.drags, to_json)},
          {"calibrations", all_of(object.calibrations, to_json)},
          {"turned_object", all_of(object.symmetry, to_json)}};
}

Json to_json(const report::GrowthSeries& series) {
  Json json = begin_with(series.contestant);
  json["end"] = series.end;
  json["exponent"] = series.growth ? Json(series.growth->power) : Json();
  json["sizes"] = Json::array();
  for (const report::GrowthPoint& point : series.points) {
    json["sizes"].push_back(
        {{"elements", point.elements},
         {"ms_per_move", point.ms_per_move},
         {"prepare_ms", point.prepare_ms},
         {"error", figures_of<report::PhysicsRow>({.point = &point}, report::physics_figures())["error"]}});
  }
  return json;
}

Json to_json(const report::PhysicsGrowth& growth) {
  return {{"name", growth.name}, {"description", growth.description}, {"contestants", all_of(growth.series, to_json)}};
}

Json to_json(const report::Growth& growth) {
  return {{"exponent", growth.power}, {"from", growth.from}, {"to", growth.to}, {"sizes", growth.sizes}};
}

Json to_json(const report::RampVerdict& verdict) {
  return {{"algorithm", info(verdict.algorithm).name},
          {"largest_width", or_null(verdict.largest_width)},
          {"lost", verdict.lost},
          {"growth", verdict.growth ? to_json(*verdict.growth) : Json()}};
}

Json to_json(const report::RampRow& row) {
  Json json;
  for (const report::Figure<report::RampRow>& figure : report::ramp_figures()) {
    json[std::string(figure.column)] = to_json(figure.value(row));
  }
  return json;
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
          {"drags", all_of(tested.drags, to_json)}};
}

}  // namespace

void write_json(std::ostream& out, const report::Comparison& comparison, const report::Origin& origin) {
  const Json json{{"origin", to_json(origin)},
                  {"options", to_json(comparison.options)},
                  {"objects", all_of(comparison.cases, to_json)}};
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
                  {"objects", all_of(report.objects, to_json)},
                  {"growths", all_of(report.growths, to_json)}};
  write_report(out, of_kind(json_kinds::physics, json));
}

void write_json(std::ostream& out, const report::Ramp& ramp, const report::Machine& machine) {
  const report::RampOptions& options = ramp.options;
  const Json json{{"machine", to_json(machine)},
                  {"seed", options.seed},
                  {"budget", options.budget},
                  {"precision", options.precision == Precision::single_precision ? "float" : "double"},
                  {"softness", to_json(options.softness)},
                  {"drags", options.drags},
                  {"moves", options.moves},
                  {"largest", options.largest},
                  {"seconds", ramp.seconds},
                  {"stopped", ramp.stopped},
                  {"algorithms", all_of(ramp.verdicts, to_json)},
                  {"sizes", all_of(ramp.rows, to_json)}};
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
