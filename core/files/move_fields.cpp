#include "files/move_fields.h"

#include "files/text.h"

namespace chainmail {

using Json = nlohmann::json;

Json parse_moves(std::string_view text, const std::filesystem::path& path) {
  return parse_json(text, path, "recorded moves");
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

}  // namespace chainmail
