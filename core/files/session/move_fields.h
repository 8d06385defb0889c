#pragma once

#include <string>
#include <vector>

#include "files/session/moves_scan.h"
#include "files/text/json_fields.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Looks at the members of a command, and throws Error where one is not what it should be.
class MoveFields : public JsonFields {
 public:
  /// `where` stands in errors.
  MoveFields(std::string where, const Mesh& mesh) : JsonFields(std::move(where)), mesh_(mesh) {}

  ElementId element(const Json& json) const;
  /// The link whose ends an array of this size begins with.
  LinkId link(const Json& json, std::size_t size) const;
  /// The only member of a command besides `do`.
  std::vector<LinkId> links(const MoveMembers& command) const;
  std::vector<ElementId> elements(const MoveMembers& command) const;
  const NumberList& list(const MoveMembers& command, const std::string& key) const;

 private:
  const Mesh& mesh_;
};

}  // namespace chainmail
