#include "files/move_fields.h"

#include <algorithm>
#include <cmath>

#include "files/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

// What the format needs is 4; more is no script, and must not exhaust memory or stack.
constexpr int deepest = 16;

std::string text_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

}  // namespace

Json parse_moves(std::string_view text, const std::filesystem::path& path) {
  const auto refuse_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) {
      throw Error(shown(path), "it is nested too deeply", "give recorded moves");
    }
    return true;
  };
  try {
    return Json::parse(text, refuse_depth);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n'));
    throw Error(shown(path, line), "it is not JSON", "give recorded moves");
  } catch (const Json::exception&) {
    throw Error(shown(path), "a number in it is beyond what a double holds", "give recorded moves");
  }
}

void MoveFields::fail(const std::string& problem, const std::string& remedy) const {
  throw Error(where_, problem, remedy);
}

void MoveFields::check_keys(const Json& object, const std::vector<std::string>& known) const {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(in_quotes(key) + " is not known here", "remove it");
    }
  }
}

const Json& MoveFields::member(const Json& object, const std::string& key) const {
  const auto found = object.find(key);
  if (found == object.end()) {
    fail("'" + key + "' is missing", "add it");
  }
  return *found;
}

const Json& MoveFields::array(const Json& object, const std::string& key) const {
  const Json& json = member(object, key);
  if (!json.is_array()) {
    fail("'" + key + "' is not an array", "write it in [ ]");
  }
  return json;
}

double MoveFields::number(const Json& json) const {
  if (!json.is_number()) {
    fail(in_quotes(text_of(json)) + " is not a number", "write a decimal number");
  }
  const auto number = json.get<double>();
  if (!(std::abs(number) <= coordinate_limit)) {
    fail(in_quotes(text_of(json)) + " is too large a number", "keep numbers within 1e100");
  }
  return number;
}

ElementId MoveFields::element(const Json& json) const {
  if (!json.is_number_unsigned()) {
    fail(in_quotes(text_of(json)) + " is not an element's id", "ids are whole numbers from 0");
  }
  if (json.get<std::uint64_t>() >= mesh_.element_count()) {
    fail("there is no element " + json.dump(), "ids run from 0 to " + std::to_string(mesh_.element_count() - 1));
  }
  return json.get<ElementId>();
}

LinkId MoveFields::link(const Json& json, std::size_t size) const {
  if (!json.is_array() || json.size() != size) {
    fail("a link is not an array of " + std::to_string(size),
         size == 2 ? "write [a, b]" : "write [a, b, compression, stretch, shear]");
  }
  const ElementId a = element(json[0]), b = element(json[1]);
  const auto found = find_link(mesh_, a, b);
  if (!found) {
    fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
         "give the two ends of a link");
  }
  return *found;
}

std::vector<LinkId> MoveFields::links(const Json& object) const {
  check_keys(object, {"do", "links"});
  std::vector<LinkId> result;
  for (const Json& one : array(object, "links")) {
    result.push_back(link(one, 2));
  }
  return result;
}

std::vector<ElementId> MoveFields::elements(const Json& object) const {
  check_keys(object, {"do", "elements"});
  std::vector<ElementId> result;
  for (const Json& one : array(object, "elements")) {
    result.push_back(element(one));
  }
  return result;
}

LinkSoftness MoveFields::softness(const Json& compression, const Json& stretch, const Json& shear) const {
  const LinkSoftness softness{number(compression), number(stretch), number(shear)};
  try {
    check(softness);
  } catch (const Error& error) {
    throw error.at(where_ + ": " + error.where());
  }
  return softness;
}

}  // namespace chainmail
