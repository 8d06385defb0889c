#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "body/region_axes.h"
#include "files/schema/schemas.h"
#include "files/session/moves_codec.h"

namespace chainmail::schema {

inline constexpr std::string_view rotation_vector = "axis times the angle (radians)";

/// The members of a softness that may be left out.
inline Members optional_softness() {
  const Member rotation{"rotation", point(rotation_vector)};
  const Json turned = object({{"kind", one_of(axes_kinds)}, rotation});
  const Json found = object({{"kind", one_of({axes_kinds[0], axes_kinds[1]})}});  // without those that are given
  const Json axes = any_of({turned, found}, "axes along which valid regions lie");
  return joined({described<LinkSoftness>(is_optional), {{"energy", energy()}, {"frame", axes}}});
}

/// Collects the schemas of the members of a command; see the list in moves_codec.h. Where a member decides on others,
/// it answers in all ways, one after another.
class CommandMembers {
 public:
  Members required, optional;

  /// Returns to the start of the command, with other answers. Returns false if there are no more.
  bool restart() {
    required = optional = {};
    while (!answers_.empty() && !answers_.back().second) {
      answers_.pop_back();
    }
    if (!answers_.empty()) {
      answers_.back().second = false;
    }
    return !answers_.empty();
  }

  // The kinds of members.
  bool has(std::string_view key, bool /*is_written*/) {
    const auto known = std::ranges::find(answers_, key, &Answer::first);
    return known != answers_.end() ? known->second : answers_.emplace_back(key, true).second;
  }
  void element(const char* key, ElementId /*one*/) { required.emplace_back(key, id()); }
  void elements(const char* key, const auto& /*all*/) { required.emplace_back(key, ids()); }
  void links(const char* key, const auto& /*all*/) {
    required.emplace_back(key, array_of(array_of(id(), "both ends", 2, 2)));
  }
  void point(const char* key, const Point& /*one*/, std::string_view help) {
    required.emplace_back(key, schema::point(help));
  }
  void rotation(const char* /*key*/, const Rotation& /*one*/, std::string_view help) {
    required.push_back(rotate(help));
  }
  void numbers(const char* key, const auto& /*all*/, std::string_view help) { optional.emplace_back(key, ids(help)); }
  template <std::size_t Size>
  void groups(const char* key, const std::vector<std::array<ElementId, Size>>& /*all*/, std::string_view help) {
    optional.emplace_back(key, array_of(array_of(id(), {}, Size, Size), help));
  }
  void points(const char* key, const auto& /*all*/) {
    required.emplace_back(
        key, array_of(array_of({id(), id(), id(), number(), number()},
                               "a, b, c, s, t: the element is at a + s (b - a) + t (c - a) at rest", 5, 5)));
  }
  void split(const SplitPointer& /*split*/) {
    SplitEdit edit;
    members(*this, edit);
  }
  void softness(const char* key, const auto& /*softness*/) {
    const Json short_row = schema::numbers(2 + region_numbers, "both ends, " + softness_names(", ", 0, region_numbers));
    const Json long_row = schema::numbers(2 + softness_numbers.size(), "both ends, " + softness_names(", "));
    required = joined({required, region()});
    const Json own = any_of({array_of(short_row), array_of(long_row)}, "softness of single links");
    optional = joined({optional, optional_softness(), {{key, own}}});
  }
  void counts(const char* panels, const char* slices, const auto& /*counts*/) {
    required.emplace_back(panels, array_of(text(), "algorithm of each panel", 1, limits::session_panels));
    required.emplace_back(slices,
                          array_of(id(), "iterations, or sweeps of up to 20,000 elements", 1, limits::session_panels));
  }
  template <class Kind>
  void described(const Kind& /*one*/) {
    required = joined({required, schema::described<Kind>()});
    optional = joined({optional, schema::described<Kind>(is_optional)});
  }

 private:
  using Answer = std::pair<std::string_view, bool>;
  std::vector<Answer> answers_;  // in the order of the questions
};

// The rules of single commands for the values of their members.
inline Json with_rules(Json schema, const auto& /*one*/) { return schema; }
inline Json with_rules(Json schema, const commands::Grab& /*one*/) {
  if (schema["properties"].contains("elements")) {
    schema["properties"]["elements"]["minItems"] = 1;
  }
  return schema;
}
inline Json with_rules(const Json& schema, const commands::Relax& /*one*/) {
  const Json equilibrium{{"const", info(RelaxationScheme::equilibrium).name}};
  const Json needed{{"properties", {{"scheme", equilibrium}}}, {"required", Json::array({"scheme"})}};
  return with(schema, "dependencies", {{"until", needed}, {"local", needed}});
}

/// Adds the schemas of a command, if it has a name: one for each choice of members that go together.
template <class Kind>
void add_command(std::vector<Json>& all) {
  if constexpr (requires { Kind::name; }) {
    CommandMembers io;
    do {
      Kind one;
      io.required.emplace_back("do", Json{{"const", Kind::name}});
      members(io, one);
      all.push_back(with_rules(object(io.required, io.optional, Kind::help), one));
    } while (io.restart());
  }
}

/// The schema of the commands of a variant.
template <class... Kinds>
Json commands_of(std::type_identity<std::variant<Kinds...>> /*all*/) {
  std::vector<Json> all;
  (add_command<Kinds>(all), ...);
  return any_of(all);
}

}  // namespace chainmail::schema
