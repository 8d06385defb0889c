#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "files/text/json_fields.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

inline constexpr unsigned session_version = 2;

/// The JSON of a session. Long arrays of numbers are packed, outside the tree: in the tree, the index in `ids` or
/// `reals` takes the place of an array. Recorded moves stay in the text, because they are read after the mesh.
struct SessionJson {  // NOLINT(bugprone-exception-escape): moving a tree throws nothing, which its library does not say
  nlohmann::json tree;
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::vector<double>> reals;
  std::string_view moves;  // the array or object `moves` in the parsed text; null in the tree
};

/// Parses the text of a session. Throws Error if it is not JSON, if an array of ids or numbers holds anything else, if
/// a key appears twice, or if the version is newer than session_version. The version is checked before the rest. Throws
/// Cancelled.
SessionJson parse_session_json(std::string_view text, const std::filesystem::path& path, const Progress& progress);

/// Checks and returns the members of a session, the packed ones too.
class SessionFields : public JsonFields {
 public:
  SessionFields(const std::string& where, const SessionJson& json) : JsonFields(where), json_(json) {}

  const std::vector<std::uint32_t>& ids(const Json& object, const char* key) const {
    return json_.ids[packed(object, key)];
  }
  const std::vector<double>& reals(const Json& object, const char* key) const {
    return json_.reals[packed(object, key)];
  }
  /// Returns ids that are all below a number of elements.
  const std::vector<std::uint32_t>& elements(const Json& object, const char* key, std::uint64_t count) const;
  /// Requires an array to hold whole groups of `of_each` numbers.
  void check_groups(std::size_t size, std::size_t of_each, const char* key) const;
  /// Returns a whole number from 1 to `highest`.
  std::uint64_t count(const Json& object, const char* key, std::uint64_t highest) const;
  LinkId link(const Mesh& mesh, ElementId a, ElementId b) const;

 private:
  std::size_t packed(const Json& object, const char* key) const;

  const SessionJson& json_;
};

}  // namespace chainmail
