#include "files/text/json_fields.h"

#include <algorithm>
#include <cmath>

#include "files/text/json_scan.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

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

}  // namespace chainmail
