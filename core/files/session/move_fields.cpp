#include "files/session/move_fields.h"

#include "files/text/text.h"

namespace chainmail {

using Json = nlohmann::json;

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

const NumberList& MoveFields::list(const MoveMembers& command, const std::string& key) const {
  array(command.members, key);
  return command.lists.at(key);
}

std::vector<LinkId> MoveFields::links(const MoveMembers& command) const {
  check_keys(command.members, {"do", "links"});
  const NumberList& ends = list(command, "links");
  std::vector<LinkId> result;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    result.push_back(link(ends.at(i), 2));
  }
  return result;
}

std::vector<ElementId> MoveFields::elements(const MoveMembers& command) const {
  check_keys(command.members, {"do", "elements"});
  const NumberList& ids = list(command, "elements");
  std::vector<ElementId> result;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    result.push_back(element(ids.at(i)));
  }
  return result;
}

}  // namespace chainmail
