#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/text/json_fields.h"
#include "mesh/described.h"

namespace chainmail {

/// The member of an object as JSON; `value(i)` is item i of an array.
nlohmann::ordered_json json_of(const MemberInfo& member, const std::function<double(std::size_t)>& value);
/// Reads and checks the items of a member. Throws Error.
std::vector<double> values_of(const JsonFields& fields, const nlohmann::json& json, const MemberInfo& member);

/// Returns the keys of a described struct.
template <class Struct>
std::vector<std::string> keys_of() {
  std::vector<std::string> keys;
  for (const MemberInfo& member : members_of<Struct>) {
    keys.emplace_back(member.key);
  }
  return keys;
}

/// Adds the members of a described struct to an object: all, or those that are chosen.
template <class Struct>
void add_members(nlohmann::ordered_json& object, const Struct& all, bool (*is_chosen)(const MemberInfo&) = nullptr) {
  for (const Member<Struct>& member : members_of<Struct>) {
    if ((is_chosen == nullptr || is_chosen(member)) &&
        (!member.is_left_out || member.get(all, 0) != member.get(Struct(), 0))) {
      object[std::string(member.key)] = json_of(member, [&](std::size_t i) { return member.get(all, i); });
    }
  }
}

/// Reads the members of a described struct from an object. Throws Error if one is missing, has the wrong type or is out
/// of range.
template <class Struct>
Struct read_members(const JsonFields& fields, const nlohmann::json& object) {
  Struct all;
  for (const Member<Struct>& member : members_of<Struct>) {
    const std::string key(member.key);
    if (member.may_be_absent && !object.contains(key)) {
      continue;
    }
    const std::vector<double> values = values_of(fields, fields.member(object, key), member);
    for (std::size_t i = 0; i < member.count; ++i) {
      member.set(all, i, values[i]);
    }
  }
  return all;
}

}  // namespace chainmail
