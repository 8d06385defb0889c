#pragma once

#include <string>
#include <vector>

#include "files/session/session_json.h"
#include "files/text/json_fields.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Looks at the members of a session, the packed ones too.
class SessionFields : public JsonFields {
 public:
  SessionFields(const std::string& where, const SessionJson& json) : JsonFields(where), json_(json) {}

  const std::vector<std::uint32_t>& ids(const Json& object, const char* key) const {
    return json_.ids[packed(object, key)];
  }
  const std::vector<double>& reals(const Json& object, const char* key) const {
    return json_.reals[packed(object, key)];
  }
  /// The same, every one below a number of elements.
  const std::vector<std::uint32_t>& elements(const Json& object, const char* key, std::uint64_t count) const;
  /// An array must hold so many numbers for each of something.
  void check_groups(std::size_t size, std::size_t of_each, const char* key) const;
  /// A whole number from 1 up to a highest one.
  std::uint64_t count(const Json& object, const char* key, std::uint64_t highest) const;
  LinkId link(const Mesh& mesh, ElementId a, ElementId b) const;

 private:
  std::size_t packed(const Json& object, const char* key) const;

  const SessionJson& json_;
};

/// The mesh of a session, from its member `mesh`.
MeshPointer read_session_mesh(const SessionFields& fields, const nlohmann::json& object, const Progress& progress);

}  // namespace chainmail
