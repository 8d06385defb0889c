#include "files/text/json_fields.h"

#include <algorithm>
#include <cmath>

#include "files/text/json_scan.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

/// Checks that a text is JSON that we can read, without building a tree. Throws Error if it is not.
class JsonCheck : public JsonScan {
 public:
  JsonCheck(std::string_view text, const std::filesystem::path& path, const std::string& content)
      : JsonScan(text, path, content),
        too_many_(shown(path), "it contains too many values", "use a file with " + content) {}

 private:
  void take_value(Json /*value*/) override { count(1); }
  void open(Json /*empty*/) override { count(limits::values_of_container); }
  void close() override {}
  void take_key(const std::string& /*key*/) override { count(limits::values_of_key); }

  void count(std::size_t values) {
    if ((values_ += values) > limits::json_values) {
      throw Error(too_many_);
    }
  }

  Error too_many_;
  std::size_t values_ = 0;
};

}  // namespace

Json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content) {
  JsonCheck(text, path, content).scan();
  return Json::parse(text);
}

std::string text_of(const Json& json) {
  return shortened(json.dump(-1, ' ', true, Json::error_handler_t::replace), limits::name_bytes);
}

void JsonFields::fail(const std::string& problem, const std::string& remedy) const {
  throw Error(where_, problem, remedy);
}

void JsonFields::check_keys(const Json& object, const std::vector<std::string>& known) const {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(in_quotes(key) + " is not a known key", "remove it");
    }
  }
}

const Json& JsonFields::member(const Json& object, const std::string& key) const {
  const auto found = object.find(key);
  if (found == object.end()) {
    fail("'" + key + "' is missing", "add it");
  }
  return *found;
}

const Json& JsonFields::array(const Json& object, const std::string& key) const {
  const Json& json = member(object, key);
  if (!json.is_array()) {
    fail("'" + key + "' is not an array", "write it in [ ]");
  }
  return json;
}

const JsonFields::Json& JsonFields::object(const Json& object, const std::string& key) const {
  const Json& json = member(object, key);
  if (!json.is_object()) {
    fail("'" + key + "' is not an object", "write it in { }");
  }
  return json;
}

std::string JsonFields::text(const Json& object, const std::string& key, std::size_t longest) const {
  const Json& json = member(object, key);
  if (!json.is_string()) {
    fail("'" + key + "' is not a text", "write it in quotes");
  }
  if (const std::size_t size = json.get_ref<const std::string&>().size(); size > longest) {
    fail("'" + key + "' has " + std::to_string(size) + " bytes", "use at most " + std::to_string(longest));
  }
  return json.get<std::string>();
}

bool JsonFields::boolean(const Json& object, const std::string& key) const {
  const Json& json = member(object, key);
  if (!json.is_boolean()) {
    fail("'" + key + "' is neither true nor false", "write one of them");
  }
  return json.get<bool>();
}

double JsonFields::number(const Json& json) const {
  if (!json.is_number()) {
    fail(in_quotes(text_of(json)) + " is not a number", "write a decimal number");
  }
  const auto number = json.get<double>();
  if (!(std::abs(number) <= coordinate_limit)) {
    fail(in_quotes(text_of(json)) + " is too large", "use numbers up to 1e100");
  }
  return number;
}

double JsonFields::number(const Json& json, const Parameter& parameter) const {
  const double value = number(json);
  try {
    check(parameter, value);
  } catch (const Error& error) {
    throw error.at(where_ + ": " + error.where());
  }
  return value;
}

LinkSoftness JsonFields::softness(const Json& object) const {
  LinkSoftness softness;
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    const auto& [parameter, value] = softness_numbers[i];
    const std::string key(parameter->name);
    if (i < region_numbers || object.contains(key)) {
      softness.*value = number(member(object, key), *parameter);
    }
  }
  return softness;
}

EnergyKind JsonFields::energy(const Json& object, EnergyKind absent) const {
  if (!object.contains("energy")) {
    return absent;
  }
  try {
    return energy_kind_of(text(object, "energy"));
  } catch (const Error& error) {
    throw error.where() == where_ ? error : error.at(where_);
  }
}

Point JsonFields::rotation_vector(const Json& object, const std::string& key) const {
  const Json& values = array(object, key);
  if (values.size() != 3) {
    fail(in_quotes(key) + " does not have three coordinates", "write [x, y, z]: the axis times the angle in radians");
  }
  return {number(values[0]), number(values[1]), number(values[2])};
}

RegionAxes JsonFields::axes(const Json& object, const Mesh& mesh, std::optional<RegionAxes>& principal) const {
  if (!object.contains("frame")) {
    return {};
  }
  const Json& axes = this->object(object, "frame");
  check_keys(axes, {"kind", "rotation"});
  const std::string kind = text(axes, "kind");
  const auto found = std::ranges::find(axes_kinds, kind);
  if (found == axes_kinds.end()) {
    fail("the kind of 'frame' is not known", "use axes, object or given");
  }
  const auto which = AxesKind(found - axes_kinds.begin());
  if (which == AxesKind::axes) {
    return {};
  }
  if (which == AxesKind::object && !axes.contains("rotation")) {
    if (!principal) {
      principal = principal_axes(mesh).axes;
    }
    return *principal;
  }
  RegionAxes result(which, rotation_vector(axes, "rotation"));
  try {
    check(result, mesh);
  } catch (const Error& error) {
    fail("'frame': " + error.problem(), error.remedy());
  }
  return result;
}

std::vector<std::string> softness_keys() {
  std::vector<std::string> keys;
  keys.reserve(softness_numbers.size());
  for (const SoftnessNumber& number : softness_numbers) {
    keys.emplace_back(number.parameter->name);
  }
  return keys;
}

void add_softness(nlohmann::ordered_json& object, const Softness& softness) {
  for (const auto& [parameter, value] : softness_numbers) {
    object[std::string(parameter->name)] = softness.global.*value;
  }
  object["energy"] = info(softness.energy).name;
  if (const RegionAxes& axes = softness.axes; axes.kind() != AxesKind::axes) {
    const Point& turn = axes.rotation();
    object["frame"] = {{"kind", axes_kinds[std::size_t(axes.kind())]}, {"rotation", {turn.x(), turn.y(), turn.z()}}};
  }
}

RelaxationScheme JsonFields::relaxation_scheme(const Json& name) const {
  const auto scheme = name.is_string() ? find_relaxation_scheme(name.get<std::string>()) : std::nullopt;
  if (!scheme) {
    fail("'scheme' is not known", "use mean, link or equilibrium");
  }
  return *scheme;
}

}  // namespace chainmail
