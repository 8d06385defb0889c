#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solve/softness.h"

namespace chainmail {

/// The JSON of a file; `content` is what the file should hold. Throws Error where it is none, with the line, where it
/// is nested deeper than anything of ours is, and where a number in it is beyond a double.
nlohmann::json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content);

/// Looks at the members of objects, and throws Error where one is not what it should be.
class JsonFields {
 public:
  using Json = nlohmann::json;

  /// `where` stands in errors.
  explicit JsonFields(std::string where) : where_(std::move(where)) {}

  const std::string& where() const { return where_; }
  void say_at(const std::string& where) { where_ = where; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// Refuses what is not known: a word misspelt would else be passed over in silence.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;
  const Json& member(const Json& object, const std::string& key) const;
  const Json& array(const Json& object, const std::string& key) const;
  const Json& object(const Json& object, const std::string& key) const;
  std::string text(const Json& object, const std::string& key) const;
  bool boolean(const Json& object, const std::string& key) const;
  double number(const Json& json) const;
  LinkSoftness softness(const Json& compression, const Json& stretch, const Json& shear) const;

 private:
  std::string where_;
};

/// What of a value an error shows.
std::string text_of(const nlohmann::json& json);

}  // namespace chainmail
