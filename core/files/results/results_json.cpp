#include "files/results/results_json.h"

#include <algorithm>
#include <limits>

#include "files/results/json_kind.h"
#include "files/text/described_json.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "report/page/tables.h"
#include "report/run/ramp.h"
#include "report/table/summary.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using Read = nlohmann::json;
using namespace report;

/// The members of a TimeSpread but its count.
constexpr std::pair<const char*, double TimeSpread::*> parts_of_spread[]{
    {"median", &TimeSpread::median},
    {"lower_quartile", &TimeSpread::lower_quartile},
    {"upper_quartile", &TimeSpread::upper_quartile},
    {"min", &TimeSpread::min},
    {"max", &TimeSpread::max}};

void add_text(Json& to, const char* key, const std::string& text) {
  if (!text.empty()) {
    to[key] = text;
  }
}
void add_number(Json& to, const char* key, const std::optional<double>& number) {
  if (number) {
    to[key] = *number;
  }
}

Json json_of(const Origin& origin) {
  const Machine& machine = origin.machine;
  return {{"date", origin.date},
          {"version", origin.version},
          {"command_line", origin.command_line},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"build", machine.build}};
}

Json json_of(const Value& value) {
  if (!value.spread) {
    return value.number;
  }
  Json json;
  for (const auto& [key, member] : parts_of_spread) {
    json[key] = *value.spread.*member;
  }
  json["repetitions"] = value.spread->count;
  return json;
}

Json json_of(const LinkSoftness& softness) {
  Json json;
  add_members(json, softness);
  return json;
}

Json json_of(const Row& row) {
  const Contestant& contestant = row.contestant;
  Json json{{"algorithm", name(contestant)},
            {"label", label(contestant)},
            {"sweeps", contestant.sweeps},
            {"equilibrium", contestant.equilibrium}};
  if (contestant.open_regions) {
    json["open_regions"] = true;
  }
  if (contestant.limit > 0) {
    json["limit"] = contestant.limit;
  }
  if (contestant.calibrated) {
    json["calibrated"] = json_of(*contestant.calibrated);
  }
  add_text(json, "refusal", row.refusal);
  for (const auto& [figure, value] : row.figures) {
    if (std::isfinite(value.number)) {  // JSON has no others
      json[std::string(figure->key)] = json_of(value);
    }
  }
  return json;
}

Json json_of(const Convergence& reference) {
  Json json{{"levels", Json::array()}, {"converged", reference.converged}, {"end", reference.end}};
  for (const ReferenceLevel& level : reference.levels) {
    Json& one = json["levels"].emplace_back(Json{{"elements", level.elements}});
    add_number(one, "change", level.change);
  }
  add_number(json, "order", reference.order);
  return json;
}

/// Returns the rows of a drag, or those of the whole object.
Json contestants_of(const Results& results, std::size_t object, std::optional<std::size_t> drag) {
  Json all = Json::array();
  for (const Row& row : results.rows) {
    if (row.object == object && row.drag == drag) {
      all.push_back(json_of(row));
    }
  }
  return all;
}

Json json_of(const Results& results, std::size_t object, std::size_t drag) {
  const DragInfo& one = results.objects[object].drags[drag];
  Json json{{"name", one.name},   {"description", one.description}, {"handle", one.handle},
            {"moves", one.moves}, {"has_cut", one.has_cut},         {"handle_displacement", one.handle_displacement}};
  add_text(json, "no_reference", one.no_reference);
  if (one.reference) {
    json["reference"] = json_of(*one.reference);
  }
  json["contestants"] = contestants_of(results, object, drag);
  return json;
}

Json json_of(const Results& results, std::size_t object) {
  const ObjectInfo& one = results.objects[object];
  Json json{{"name", one.name}, {"description", one.description}};
  add_text(json, "series", one.series);
  json.update({{"elements", one.elements}, {"links", one.links}, {"pins", one.pins}});
  add_text(json, "reference", one.reference);
  json["seconds"] = one.seconds;
  json["notes"] = one.notes;
  json["drags"] = Json::array();
  for (std::size_t drag = 0; drag < one.drags.size(); ++drag) {
    json["drags"].push_back(json_of(results, object, drag));
  }
  if (Json whole = contestants_of(results, object, std::nullopt); !whole.empty()) {
    json["contestants"] = std::move(whole);
  }
  return json;
}

Json figures_of(const Results& results) {
  Json all = Json::array();
  for (const Figure* figure : figures_in(results)) {
    all.push_back({{"key", figure->key},
                   {"heading", std::string(figure->group) + ", " + std::string(figure->heading)},
                   {"unit", figure->unit},
                   {"definition", definition_of(*figure)}});
  }
  return all;
}

/// What ramps have beside the table: its rows without nesting, and what became of each algorithm.
void add_ramp(Json& json, const Results& results) {
  json["sizes"] = Json::array();
  for (const Row& row : results.rows) {
    const ObjectInfo& grid = results.object_of(row);
    Json& one = json["sizes"].emplace_back(Json{{"width", width_of(grid)},
                                                {"elements", grid.elements},
                                                {"links", grid.links},
                                                {"algorithm", name(row.contestant)}});
    for (const auto& [figure, value] : row.figures) {
      one[std::string(figure->key)] =
          figure->format == FigureFormat::yes_no ? Json(value.number != 0) : Json(value.number);
    }
  }
  json["algorithms"] = Json::array();
  for (const RampVerdict& verdict : ramp_verdicts(results)) {
    Json& one = json["algorithms"].emplace_back(Json{{"algorithm", info(verdict.algorithm).name}});
    one["largest_width"] = verdict.largest ? Json(width_of(results.objects[*verdict.largest])) : Json();
    one["lost"] = verdict.lost;
    one["growth"] = verdict.growth ? Json{{"exponent", verdict.growth->power},
                                          {"from", verdict.growth->from},
                                          {"to", verdict.growth->to},
                                          {"sizes", verdict.growth->sizes}}
                                   : Json();
  }
}

Json residual_of(const Row& row) {
  return {{"relative", row[figures::relative].value_or(0)},
          {"rms", row[figures::error_rms].value_or(0)},
          {"max", row[figures::error_max].value_or(0)}};
}

/// What calibrations have beside the table: the softness that was found, and its errors on the drags of the search.
void add_calibration(Json& json, const Results& results) {
  const std::vector<Contestant> all = contestants_in(results, std::size_t{0});
  const auto found = std::ranges::find_if(all, [](const Contestant& one) { return one.calibrated.has_value(); });
  if (found == all.end()) {
    return;
  }
  json.update(json_of(*found->calibrated));
  json["sweeps"] = found->sweeps;
  const std::string& fitted = results.objects.front().drags.front().name;
  json["residual"] = residual_of(joined(results, 0, *found, Drags::all, fitted).row);
  json["drags"] = Json::array();
  for (const Row* row : rows_of(results, 0, [&](const Row& one) { return one.contestant == *found && one.drag; })) {
    const DragInfo& drag = *results.drag_of(*row);
    if (drag.name == fitted) {
      json["drags"].push_back({{"element", drag.handle}, {"residual", residual_of(*row)}});
    }
  }
}

/// Reads a report. Every member is checked, because files are edited and cut off.
class ResultsReader {
 public:
  explicit ResultsReader(const std::filesystem::path& path) : fields_(shown(path)) {}

  Results read(const Read& json) {
    check_kind(json);
    Results results;
    results.kind = kind_of(fields_.text(json, "report"));
    if (json.contains("runs")) {
      results.runs = list<ReportRun>(json, "runs", [&](const Read& one) { return run(one); });
    } else if (json.contains("origin")) {
      results.runs.push_back({origin(fields_.object(json, "origin"))});
    }
    for (const auto& [key, value] : fields_.object(json, "options").items()) {
      results.settings.emplace_back(
          key, value.is_string() ? Setting::second_type(value.get<std::string>()) : fields_.number(value));
    }
    for (const Read& one : fields_.array(json, "objects")) {
      add_object(results, one);
    }
    results.stopped = is_true(json, "stopped");
    return results;
  }

 private:
  void check_kind(const Read& json) const {
    const auto old = [&](const char* name) {
      return json.contains("kind") && json["kind"] == std::string("chainmail ") + name;
    };
    if (json.is_object() && (old("suite") || old("compare") || old("physics"))) {
      fields_.fail("it is a report of version 1", "run the comparison again with this program");
    }
    if (!json.is_object() || !json.contains("kind") || json["kind"] != json_kinds::report.kind()) {
      fields_.fail("it is not a report", "give the report.json of a comparison");
    }
    constexpr int known = json_kinds::report.schema_version;
    if (const auto version = whole(json, "schema_version"); version != known) {
      fields_.fail(
          "its format has version " + std::to_string(version) + ", this program reads version " + std::to_string(known),
          "run the comparison again with this program");
    }
  }
  ReportKind kind_of(const std::string& name) const {
    const auto kind = find_report_kind(name);
    if (!kind) {
      fields_.fail("there is no report " + in_quotes(printable(name)), "give the file as it was written");
    }
    return *kind;
  }

  std::uint64_t whole(const Read& json, const char* key) const {
    const Read& number = fields_.member(json, key);
    if (!number.is_number_unsigned()) {
      fields_.fail(in_quotes(key) + " is not a whole number from 0", "give the file as it was written");
    }
    return number.get<std::uint64_t>();
  }
  int count(const Read& json, const char* key) const {
    const std::uint64_t number = whole(json, key);
    if (number > std::uint64_t(std::numeric_limits<int>::max())) {
      fields_.fail(in_quotes(key) + " is too large", "give the file as it was written");
    }
    return int(number);
  }
  std::string text_if_any(const Read& json, const char* key) const {
    return json.contains(key) ? fields_.text(json, key) : std::string();
  }
  bool is_true(const Read& json, const char* key) const { return json.contains(key) && fields_.boolean(json, key); }
  std::optional<double> number_if_any(const Read& json, const std::string& key) const {
    return json.contains(key) ? std::optional(fields_.number(json[key])) : std::nullopt;
  }
  template <class Item, class Convert>
  std::vector<Item> list(const Read& json, const char* key, Convert convert) const {
    std::vector<Item> items;
    for (const Read& one : fields_.array(json, key)) {
      items.push_back(convert(one));
    }
    return items;
  }
  std::vector<std::string> texts(const Read& json, const char* key) const {
    return list<std::string>(json, key, [&](const Read& one) {
      if (!one.is_string()) {
        fields_.fail(in_quotes(key) + " has an entry that is not a text", "give the file as it was written");
      }
      return one.get<std::string>();
    });
  }

  Origin origin(const Read& json) const {
    return {{fields_.text(json, "processor"), unsigned(count(json, "cores")), fields_.text(json, "compiler"),
             fields_.text(json, "build")},
            fields_.text(json, "command_line"),
            fields_.text(json, "date"),
            fields_.text(json, "version")};
  }
  ReportRun run(const Read& json) const {
    return {origin(json), text_if_any(json, "shard"), texts(json, "experiments")};
  }

  Convergence convergence(const Read& json) const {
    return {list<ReferenceLevel>(json, "levels",
                                 [&](const Read& one) {
                                   return ReferenceLevel{whole(one, "elements"), number_if_any(one, "change")};
                                 }),
            number_if_any(json, "order"), fields_.boolean(json, "converged"), fields_.text(json, "end")};
  }

  Contestant contestant(const Read& json) const {
    Contestant one;
    const std::string name = fields_.text(json, "algorithm");
    one.algorithm = find_algorithm(name);
    one.solver = one.algorithm || name == report::name(Contestant()) ? "" : printable(name);
    one.sweeps = count(json, "sweeps");
    one.equilibrium = fields_.boolean(json, "equilibrium");
    one.open_regions = is_true(json, "open_regions");
    one.limit = json.contains("limit") ? count(json, "limit") : 0;
    if (json.contains("calibrated")) {
      one.calibrated = read_members<LinkSoftness>(fields_, fields_.object(json, "calibrated"));
    }
    return one;
  }
  TimeSpread spread(const Read& json) const {
    TimeSpread spread;
    for (const auto& [key, member] : parts_of_spread) {
      spread.*member = fields_.number(fields_.member(json, key));
    }
    spread.count = count(json, "repetitions");
    return spread;
  }
  Row row(const Read& json) const {
    Row row{.contestant = contestant(json), .refusal = text_if_any(json, "refusal")};
    for (const Figure* figure : every_figure()) {
      const std::string key(figure->key);
      if (json.contains(key) && json[key].is_object()) {
        row.set(*figure, spread(json[key]));
      } else {
        row.set(*figure, number_if_any(json, key));
      }
    }
    return row;
  }
  void add_rows(Results& results, std::optional<std::size_t> drag, const Read& json) const {
    for (Row& one : list<Row>(json, "contestants", [&](const Read& row_json) { return row(row_json); })) {
      one.object = results.objects.size() - 1;
      one.drag = drag;
      results.rows.push_back(std::move(one));
    }
  }

  void add_object(Results& results, const Read& json) const {
    ObjectInfo& object = results.objects.emplace_back();
    object.name = fields_.text(json, "name");
    object.description = fields_.text(json, "description");
    object.series = text_if_any(json, "series");
    object.elements = whole(json, "elements");
    object.links = whole(json, "links");
    object.pins = whole(json, "pins");
    object.reference = text_if_any(json, "reference");
    object.seconds = fields_.number(fields_.member(json, "seconds"));
    object.notes = texts(json, "notes");
    for (const Read& one : fields_.array(json, "drags")) {
      object.drags.push_back({.name = fields_.text(one, "name"),
                              .description = fields_.text(one, "description"),
                              .handle = whole(one, "handle"),
                              .moves = count(one, "moves"),
                              .has_cut = fields_.boolean(one, "has_cut"),
                              .handle_displacement = fields_.number(fields_.member(one, "handle_displacement")),
                              .no_reference = text_if_any(one, "no_reference")});
      if (one.contains("reference")) {
        object.drags.back().reference = convergence(fields_.object(one, "reference"));
      }
      add_rows(results, object.drags.size() - 1, one);
    }
    if (json.contains("contestants")) {
      add_rows(results, std::nullopt, json);
    }
  }

  JsonFields fields_;
};

}  // namespace

void write_json(std::ostream& out, const Results& results) {
  Json json{{"report", report_info(results.kind).name}};
  if (!results.runs.empty()) {
    json["origin"] = json_of(results.runs.front().origin);
  }
  if (results.kind == ReportKind::suite) {
    json["runs"] = Json::array();
    for (const ReportRun& run : results.runs) {
      Json one = json_of(run.origin);
      one["shard"] = run.shard;
      one["experiments"] = run.experiments;
      json["runs"].push_back(std::move(one));
    }
  }
  json["options"] = Json::object();
  for (const auto& [key, value] : results.settings) {
    std::visit([&, at = key](const auto& one) { json["options"][at] = one; }, value);
  }
  json["stopped"] = results.stopped;
  json["figures"] = figures_of(results);
  json["objects"] = Json::array();
  for (std::size_t object = 0; object < results.objects.size(); ++object) {
    json["objects"].push_back(json_of(results, object));
  }
  if (results.kind == ReportKind::ramp) {
    add_ramp(json, results);
  } else if (results.kind == ReportKind::calibrate) {
    add_calibration(json, results);
  }
  // Names from outside may not be UTF-8: invalid bytes become the replacement character.
  out << of_kind(json_kinds::report, json).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

Results read_results(const std::filesystem::path& path) {
  const std::string content = "a report of a comparison";
  return ResultsReader(path).read(parse_json(read_text(path, content), path, content));
}

}  // namespace chainmail
