#include "files/text/json_fields.h"

#include <algorithm>
#include <cmath>

#include "files/text/text.h"

namespace chainmail {
using Json = nlohmann::json;

std::string text_of(const Json& json) {
  return shortened(json.dump(-1, ' ', true, Json::error_handler_t::replace), limits::name_bytes);
}

void JsonFields::fail(const std::string& problem, const std::string& remedy) const {
  throw Error(where_, problem, remedy);
}

void JsonFields::check_keys(const Json& object, const std::vector<std::string>& known) const {
  if (!object.is_object()) {
    fail("it is not an object", "write it in { }");
  }
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

std::uint64_t JsonFields::whole(const Json& object, const std::string& key, std::uint64_t lowest,
                                std::uint64_t highest) const {
  const Json& json = member(object, key);
  const bool is_whole = json.is_number_unsigned();
  if (!is_whole || json.get<std::uint64_t>() < lowest || json.get<std::uint64_t>() > highest) {
    fail("'" + key + "' is not a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest),
         "write such a number");
  }
  return json.get<std::uint64_t>();
}

std::uint64_t JsonFields::version(const Json& file, std::uint64_t newest) const {
  const Json& version = member(file, "version");
  if (version.is_number_unsigned() && version.get<std::uint64_t>() > newest) {
    fail("its version is " + version.dump() + ", but this program knows only version " + std::to_string(newest) +
             (newest > 1 ? " and older" : ""),
         "open it with a newer program");
  }
  return whole(file, "version", 1, newest);
}

std::size_t JsonFields::choice(const Json& value, const std::string& key,
                               std::span<const std::string_view> names) const {
  const auto found = std::ranges::find(names, value.is_string() ? value.get<std::string>() : "");
  if (found == names.end()) {
    const std::vector<std::string> others(names.begin(), names.end() - 1);
    fail(in_quotes(key) + " is not known", "use " + joined_words(others, ", ") + " or " + std::string(names.back()));
  }
  return static_cast<std::size_t>(found - names.begin());
}

Point JsonFields::point(const Json& object, const std::string& key) const {
  const Json& values = array(object, key);
  if (values.size() != 3) {
    fail(in_quotes(key) + " does not have three coordinates", "write [x, y, z]");
  }
  return {number(values[0]), number(values[1]), number(values[2])};
}

const PackedArray& JsonFields::packed(const Json& object, const std::string& key,
                                      std::initializer_list<std::size_t> widths) const {
  const Json& marker = member(object, key);
  if (!marker.is_binary()) {
    fail("'" + key + "' is not an array", "write it in [ ]");
  }
  const PackedArray& array = (*arrays_)[marker.get_binary().subtype()];
  if (!array.fault.empty()) {
    fail(array.fault, "use decimal numbers, and whole numbers from 0 to 4294967295 for ids");
  }
  if (array.size > 0 && std::ranges::find(widths, array.width) == widths.end()) {
    std::vector<std::string> words;
    for (const std::size_t width : widths) {
      words.push_back(std::to_string(width));
    }
    fail("'" + key + "' does not contain " +
             (words.front() == "0" ? "numbers only" : "arrays of " + joined_words(words, " or ") + " numbers"),
         "write such an array");
  }
  return array;
}

void JsonFields::check_groups(std::size_t size, std::size_t of_each, const std::string& key) const {
  if (size % of_each != 0) {
    fail("'" + key + "' ends within a group of " + std::to_string(of_each), "write complete groups");
  }
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
  here([&] { check(parameter, value); });
  return value;
}

}  // namespace chainmail
