#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "body/softness.h"
#include "equilibrium/relaxation_scheme.h"
#include "files/text/json_fields.h"
#include "mesh/described.h"

/// JSON schemas (draft 7). `help` becomes the description; an empty one leaves it out.
namespace chainmail::schema {

using Json = nlohmann::ordered_json;
/// Keys of an object, with the schemas of their values; or names of files, with the schemas in them.
using Members = std::vector<std::pair<std::string_view, Json>>;
using Member = Members::value_type;

/// The schemas of what the programs report, and of the files that users keep.
Members schemas_of_results();
Members schemas_of_files();

inline constexpr std::uint64_t no_most = std::numeric_limits<std::uint64_t>::max();

/// Returns a schema with one more rule.
inline Json with(Json schema, const char* key, Json value) {
  schema[key] = std::move(value);
  return schema;
}
inline Json about(std::string_view help, Json schema) {
  return help.empty() ? schema : with(std::move(schema), "description", help);
}
inline Json one_of(Json values, std::string_view help = {}) { return about(help, {{"enum", std::move(values)}}); }
inline Json any_of(const std::vector<Json>& all, std::string_view help = {}) { return about(help, {{"anyOf", all}}); }
inline Json boolean(std::string_view help = {}) { return about(help, {{"type", "boolean"}}); }
inline Json text(std::string_view help = {}) { return about(help, {{"type", "string"}}); }
/// A text that is not empty. Schemas count characters, of which there are not more than bytes.
inline Json non_empty_text(std::string_view help = {}, std::uint64_t bytes = no_most) {
  const Json all = with(text(help), "minLength", 1);
  return bytes == no_most ? all : with(all, "maxLength", bytes);
}
inline Json number(std::string_view help = {}) { return about(help, {{"type", "number"}}); }
inline Json from_zero(std::string_view help = {}) { return with(number(help), "minimum", 0); }
inline Json whole(std::uint64_t least, std::uint64_t most, std::string_view help = {}) {
  const Json all = about(help, {{"type", "integer"}, {"minimum", least}});
  return most == no_most ? all : with(all, "maximum", most);
}
inline Json count(std::string_view help = {}) { return whole(0, no_most, help); }
inline Json from_one(std::string_view help = {}) { return whole(1, no_most, help); }
inline Json or_null(const Json& schema) { return with(schema, "type", Json::array({schema["type"], "null"})); }
/// The id of an element, or another index.
inline Json id(std::string_view help = {}) { return whole(0, std::numeric_limits<ElementId>::max(), help); }
/// An array of one kind of item, or of an item for each of an array of schemas.
inline Json array_of(Json item, std::string_view help = {}, std::uint64_t least = 0, std::uint64_t most = no_most) {
  const Json all = about(help, {{"type", "array"}, {"items", std::move(item)}, {"minItems", least}});
  return most == no_most ? all : with(all, "maxItems", most);
}
inline Json ids(std::string_view help = {}) { return array_of(id(), help); }
inline Json numbers(std::uint64_t count, std::string_view help) { return array_of(number(), help, count, count); }
inline Json point(std::string_view help = "x, y, z (mesh units)") { return numbers(3, help); }

inline Members joined(std::initializer_list<Members> parts) {
  Members all;
  for (const Members& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}
/// Members with the same schema.
inline Members each(const Json& schema, std::initializer_list<std::string_view> keys) {
  Members all;
  for (const std::string_view key : keys) {
    all.emplace_back(key, schema);
  }
  return all;
}
/// An object with these members and no others.
inline Json object(const Members& required, const Members& optional = {}, std::string_view help = {}) {
  Json all{{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  for (const auto& [key, value] : joined({required, optional})) {
    all["properties"][std::string(key)] = value;
  }
  for (const auto& [key, value] : required) {
    all["required"].push_back(key);
  }
  return about(help, with(all, "additionalProperties", false));
}
inline Member document(std::string_view name, std::string_view title, const Json& schema) {
  Json all{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  all.update(schema);
  return {name, all};
}

Json names_of(const auto& rows) {
  Json names = Json::array();
  for (const auto& row : rows) {
    names.push_back(row.name);
  }
  return names;
}
inline Json algorithm() { return text("name, as on the command line"); }
inline Json scheme() { return one_of(names_of(relaxation_schemes), "scheme of relaxation"); }
inline Json energy() { return one_of(names_of(energy_kinds()), "kind of elastic energy"); }
inline Member rotate(std::string_view help) {
  return {"rotate", object({{"axis", point("direction of the axis")}, {"degrees", number()}}, {}, help)};
}
/// A number, and a member of a described struct.
Json schema_of(const Parameter& number);
Json schema_of(const MemberInfo& member);
inline bool is_required(const MemberInfo& member) { return !member.may_be_absent; }
inline bool is_optional(const MemberInfo& member) { return member.may_be_absent; }
/// The members of a described struct that are chosen.
template <class Struct>
Members described(bool (*is_chosen)(const MemberInfo&) = is_required) {
  Members members;
  for (const MemberInfo& member : members_of<Struct>) {
    if (is_chosen(member)) {
      members.emplace_back(member.key, schema_of(member));
    }
  }
  return members;
}
/// The numbers of a softness: those of valid regions, which files always have, and those of the energy.
inline Members region() { return described<LinkSoftness>(); }
inline Members softness() { return joined({region(), described<LinkSoftness>(is_optional)}); }

}  // namespace chainmail::schema
