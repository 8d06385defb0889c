#include "files/json_fields.h"

#include <algorithm>
#include <cmath>

#include "files/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

// What our formats need is 4; more is none of them, and must not exhaust memory or stack.
constexpr int deepest = 16;

}  // namespace

Json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content) {
  const std::string remedy = "give " + content;
  const auto refuse_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) {
      throw Error(shown(path), "it is nested too deeply", remedy);
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_depth);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n'));
    throw Error(shown(path, line), "it is not JSON", remedy);
  } catch (const Json::exception&) {
    throw Error(shown(path), "a number in it is beyond what a double holds", remedy);
  }
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

void JsonFields::fail(const std::string& problem, const std::string& remedy) const {
  throw Error(where_, problem, remedy);
}

void JsonFields::check_keys(const Json& object, const std::vector<std::string>& known) const {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(in_quotes(key) + " is not known here", "remove it");
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

std::string JsonFields::text(const Json& object, const std::string& key) const {
  const Json& json = member(object, key);
  if (!json.is_string()) {
    fail("'" + key + "' is not a text", "write it in quotes");
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
    fail(in_quotes(text_of(json)) + " is too large a number", "keep numbers within 1e100");
  }
  return number;
}

LinkSoftness JsonFields::softness(const Json& compression, const Json& stretch, const Json& shear) const {
  const LinkSoftness softness{number(compression), number(stretch), number(shear)};
  try {
    check(softness);
  } catch (const Error& error) {
    throw error.at(where_ + ": " + error.where());
  }
  return softness;
}

}  // namespace chainmail
