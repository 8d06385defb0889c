#include "files/results/suite_json.h"

#include "files/results/json_kind.h"
#include "files/text/json_fields.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::ordered_json;
using Read = nlohmann::json;

// These add a value under a key, if there is one.
void add_text(Json& to, const char* key, const std::string& text) {
  if (!text.empty()) {
    to[key] = text;
  }
}
void add_number(Json& to, const std::string& key, const std::optional<double>& number) {
  if (number) {
    to[key] = *number;
  }
}

template <class Items, class Convert>
Json list_of(const Items& items, Convert convert) {
  Json list = Json::array();
  for (const auto& item : items) {
    list.push_back(convert(item));
  }
  return list;
}

Json run_json(const report::SuiteRun& run) {
  const report::Machine& machine = run.origin.machine;
  return {{"shard", run.shard},
          {"date", run.origin.date},
          {"version", run.origin.version},
          {"command_line", run.origin.command_line},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"build", machine.build},
          {"experiments", run.experiments}};
}

Json row_json(const report::SuiteRow& row) {
  Json json{{"drag", row.drag},
            {"handle", row.handle},
            {"has_cut", row.has_cut},
            {"contestant", row.contestant},
            {"algorithm", row.algorithm}};
  add_text(json, "refusal", row.refusal);
  for (const report::SuiteFigure& figure : report::suite_figures) {
    add_number(json, std::string(figure.key), row.*figure.value);
  }
  return json;
}

Json order_json(const report::SuiteOrder& order) {
  Json json{{"contestant", order.contestant}, {"algorithm", order.algorithm}};
  add_text(json, "refusal", order.refusal);
  json["sizes"] = list_of(order.sizes, [](const report::SuiteOrder::Size& size) {
    return Json{{"elements", size.elements}, {"relative", size.relative}};
  });
  add_number(json, "order", order.order);
  return json;
}

Json point_json(const report::SuitePoint& point) {
  Json json{{"iterations", point.iterations}};
  for (const report::SuitePointFigures& figures : report::suite_point_figures) {
    add_number(json, std::string(figures.error_key), point.*figures.error);
    add_number(json, std::string(figures.ms_key), point.*figures.ms);
  }
  return json;
}

Json below_json(const report::SuiteTime& time, double error) {
  Json json{{"relative", error}};
  for (const report::SuitePointFigures& figures : report::suite_point_figures) {
    add_number(json, std::string(figures.ms_key), shortest_ms(time, figures, error));
  }
  return json;
}

Json time_json(const report::SuiteTime& time) {
  Json json{{"contestant", time.contestant}, {"algorithm", time.algorithm}};
  add_text(json, "refusal", time.refusal);
  add_number(json, "least_error", least_error(time));
  add_number(json, "factorize_ms", time.factorize_ms);
  json["below"] = list_of(report::suite_errors, [&](double error) { return below_json(time, error); });
  json["curve"] = list_of(time.curve, point_json);
  return json;
}

Json reference_json(const Convergence& reference) {
  Json json{{"levels", list_of(reference.levels,
                               [](const ReferenceLevel& level) {
                                 Json one{{"elements", level.elements}};
                                 add_number(one, "change", level.change);
                                 return one;
                               })},
            {"converged", reference.converged},
            {"end", reference.end}};
  add_number(json, "order", reference.order);
  return json;
}

Json result_json(const report::SuiteResult& result) {
  return {{"name", result.name},
          {"description", result.description},
          {"reference", result.reference},
          {"elements", result.elements},
          {"links", result.links},
          {"pins", result.pins},
          {"seconds", result.seconds},
          {"references", list_of(result.references, reference_json)},
          {"notes", result.notes},
          {"rows", list_of(result.rows, row_json)},
          {"orders", list_of(result.orders, order_json)},
          {"times", list_of(result.times, time_json)}};
}

/// Reads a suite. Every member is checked, because files are edited and cut off.
class SuiteReader {
 public:
  explicit SuiteReader(const std::filesystem::path& path) : fields_(shown(path)) {}

  report::Suite suite(const Read& json) {
    if (!json.is_object() || !json.contains("kind") || json["kind"] != json_kinds::suite.kind()) {
      fields_.fail("it is not a report of compare --suite", "give the report.json of a suite");
    }
    constexpr int known = json_kinds::suite.schema_version;
    if (const auto version = whole(json, "schema_version"); version != known) {
      fields_.fail(
          "its format has version " + std::to_string(version) + ", this program reads version " + std::to_string(known),
          "run the suite again with this program");
    }
    report::Suite suite;
    suite.runs = list<report::SuiteRun>(json, "runs", &SuiteReader::run);
    suite.results = list<report::SuiteResult>(json, "experiments", &SuiteReader::result);
    return suite;
  }

 private:
  std::uint64_t whole(const Read& json, const char* key) const {
    const Read& number = fields_.member(json, key);
    if (!number.is_number_unsigned()) {
      fields_.fail(in_quotes(key) + " is not a whole number from 0", "give the file as it was written");
    }
    return number.get<std::uint64_t>();
  }
  std::string text_if_any(const Read& json, const char* key) const {
    return json.contains(key) ? fields_.text(json, key) : std::string();
  }
  std::optional<double> number_if_any(const Read& json, const std::string& key) const {
    return json.contains(key) ? std::optional(fields_.number(json[key])) : std::nullopt;
  }
  template <class Item>
  std::vector<Item> list(const Read& json, const char* key, Item (SuiteReader::*read)(const Read&) const) const {
    std::vector<Item> items;
    for (const Read& one : fields_.array(json, key)) {
      if (!one.is_object()) {
        fields_.fail(in_quotes(key) + " has an entry that is not an object", "give the file as it was written");
      }
      items.push_back((this->*read)(one));
    }
    return items;
  }
  std::vector<std::string> texts(const Read& json, const char* key) const {
    std::vector<std::string> all;
    for (const Read& one : fields_.array(json, key)) {
      if (!one.is_string()) {
        fields_.fail(in_quotes(key) + " has an entry that is not a text", "give the file as it was written");
      }
      all.push_back(one.get<std::string>());
    }
    return all;
  }

  report::SuiteRun run(const Read& json) const {
    report::SuiteRun run;
    run.shard = fields_.text(json, "shard");
    run.origin = {{fields_.text(json, "processor"), unsigned(whole(json, "cores")), fields_.text(json, "compiler"),
                   fields_.text(json, "build")},
                  fields_.text(json, "command_line"),
                  fields_.text(json, "date"),
                  fields_.text(json, "version")};
    run.experiments = texts(json, "experiments");
    return run;
  }
  report::SuiteRow row(const Read& json) const {
    report::SuiteRow row{fields_.text(json, "drag"),       whole(json, "handle"),
                         fields_.boolean(json, "has_cut"), fields_.text(json, "contestant"),
                         fields_.text(json, "algorithm"),  text_if_any(json, "refusal")};
    for (const report::SuiteFigure& figure : report::suite_figures) {
      row.*figure.value = number_if_any(json, std::string(figure.key));
    }
    return row;
  }
  report::SuiteOrder::Size size(const Read& json) const {
    return {whole(json, "elements"), fields_.number(fields_.member(json, "relative"))};
  }
  report::SuiteOrder order(const Read& json) const {
    return {fields_.text(json, "contestant"), fields_.text(json, "algorithm"), text_if_any(json, "refusal"),
            list<report::SuiteOrder::Size>(json, "sizes", &SuiteReader::size), number_if_any(json, "order")};
  }
  report::SuitePoint point(const Read& json) const {
    report::SuitePoint point{.iterations = whole(json, "iterations")};
    for (const report::SuitePointFigures& figures : report::suite_point_figures) {
      point.*figures.error = number_if_any(json, std::string(figures.error_key));
      point.*figures.ms = number_if_any(json, std::string(figures.ms_key));
    }
    return point;
  }
  report::SuiteTime time(const Read& json) const {
    return {fields_.text(json, "contestant"), fields_.text(json, "algorithm"), text_if_any(json, "refusal"),
            number_if_any(json, "factorize_ms"), list<report::SuitePoint>(json, "curve", &SuiteReader::point)};
  }
  ReferenceLevel level(const Read& json) const { return {whole(json, "elements"), number_if_any(json, "change")}; }
  Convergence reference(const Read& json) const {
    return {list<ReferenceLevel>(json, "levels", &SuiteReader::level), number_if_any(json, "order"),
            fields_.boolean(json, "converged"), fields_.text(json, "end")};
  }
  report::SuiteResult result(const Read& json) const {
    report::SuiteResult result;
    result.name = fields_.text(json, "name");
    result.description = fields_.text(json, "description");
    result.reference = fields_.text(json, "reference");
    result.elements = whole(json, "elements");
    result.links = whole(json, "links");
    result.pins = whole(json, "pins");
    result.seconds = fields_.number(fields_.member(json, "seconds"));
    result.references = list<Convergence>(json, "references", &SuiteReader::reference);
    result.notes = texts(json, "notes");
    result.rows = list<report::SuiteRow>(json, "rows", &SuiteReader::row);
    result.orders = list<report::SuiteOrder>(json, "orders", &SuiteReader::order);
    result.times = list<report::SuiteTime>(json, "times", &SuiteReader::time);
    return result;
  }

  JsonFields fields_;
};

}  // namespace

void write_json(std::ostream& out, const report::Suite& suite) {
  const Json json{{"runs", list_of(suite.runs, run_json)}, {"experiments", list_of(suite.results, result_json)}};
  out << of_kind(json_kinds::suite, json).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

report::Suite read_suite(const std::filesystem::path& path) {
  const std::string content = "a report of compare --suite";
  return SuiteReader(path).suite(parse_json(read_text(path, content), path, content));
}

}  // namespace chainmail
