#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "solve/softness.h"

namespace chainmail {

/// The JSON of a file of moves. Throws Error where it is none, with the line, and where it is nested deeper
/// than moves are.
nlohmann::json parse_moves(std::string_view text, const std::filesystem::path& path);

/// Looks at the members of a command, and throws Error where one is not what it should be.
class MoveFields {
 public:
  using Json = nlohmann::json;

  /// `where` stands in errors.
  MoveFields(std::string where, const Mesh& mesh) : where_(std::move(where)), mesh_(mesh) {}

  void say_at(const std::string& where) { where_ = where; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// Refuses what is not known: a word misspelt would else be passed over in silence.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;
  const Json& member(const Json& object, const std::string& key) const;
  const Json& array(const Json& object, const std::string& key) const;
  double number(const Json& json) const;
  ElementId element(const Json& json) const;
  /// The link whose ends an array of this size begins with.
  LinkId link(const Json& json, std::size_t size) const;
  /// All there is in a command beside `do`.
  std::vector<LinkId> links(const Json& object) const;
  std::vector<ElementId> elements(const Json& object) const;
  LinkSoftness softness(const Json& compression, const Json& stretch, const Json& shear) const;

 private:
  std::string where_;
  const Mesh& mesh_;
};

}  // namespace chainmail
