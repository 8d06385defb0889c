#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/json_fields.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The JSON of a file of moves. Throws Error where it is none, with the line, and where it is nested deeper
/// than moves are.
nlohmann::json parse_moves(std::string_view text, const std::filesystem::path& path);

/// Looks at the members of a command, and throws Error where one is not what it should be.
class MoveFields : public JsonFields {
 public:
  /// `where` stands in errors.
  MoveFields(std::string where, const Mesh& mesh) : JsonFields(std::move(where)), mesh_(mesh) {}

  ElementId element(const Json& json) const;
  /// The link whose ends an array of this size begins with.
  LinkId link(const Json& json, std::size_t size) const;
  /// All there is in a command beside `do`.
  std::vector<LinkId> links(const Json& object) const;
  std::vector<ElementId> elements(const Json& object) const;

 private:
  const Mesh& mesh_;
};

}  // namespace chainmail
