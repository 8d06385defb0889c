#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace chainmail {

/// A kind of JSON output. `files/schema` describes its members. The version rises when a member
/// changes its meaning or goes.
struct JsonKind {
  std::string_view name;
  int schema_version;

  /// Text of the member `kind`.
  std::string kind() const { return "chainmail " + std::string(name); }
};

namespace json_kinds {

inline constexpr JsonKind info{"info", 1};
inline constexpr JsonKind repair{"repair", 1};
inline constexpr JsonKind deform{"deform", 1};
inline constexpr JsonKind report{"report", 2};
inline constexpr JsonKind peer_case{"case", 1};
inline constexpr JsonKind peer_answer{"answer", 1};

}  // namespace json_kinds

/// Returns an output of a kind: the members `kind` and `schema_version`, then the others.
inline nlohmann::ordered_json of_kind(const JsonKind& kind, const nlohmann::ordered_json& members) {
  nlohmann::ordered_json json{{"kind", kind.kind()}, {"schema_version", kind.schema_version}};
  json.update(members);
  return json;
}

}  // namespace chainmail
