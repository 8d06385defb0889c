#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/text/limits.h"
#include "mesh/parameters.h"

namespace chainmail {

/// Parses the JSON of a file. `content` describes the expected content in error messages. Throws Error, with the line,
/// if the text is not JSON, if it is nested deeper than our formats, if it contains more than limits::json_values, or a
/// number that is too large for a double.
nlohmann::json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content);

/// Checks and returns the members of objects. Throws Error if one is missing or has the wrong type.
class JsonFields {
 public:
  using Json = nlohmann::json;

  /// `where` appears in error messages.
  explicit JsonFields(std::string where) : where_(std::move(where)) {}

  const std::string& where() const { return where_; }
  void say_at(const std::string& where) { where_ = where; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// Throws Error if there is an unknown key, because it may be a misspelt one.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;
  const Json& member(const Json& object, const std::string& key) const;
  const Json& array(const Json& object, const std::string& key) const;
  const Json& object(const Json& object, const std::string& key) const;
  /// Returns a text with at most `longest` bytes.
  std::string text(const Json& object, const std::string& key, std::size_t longest = limits::text_bytes) const;
  bool boolean(const Json& object, const std::string& key) const;
  double number(const Json& json) const;
  /// Returns a number. Throws Error if it is not in the range of the parameter.
  double number(const Json& json, const Parameter& parameter) const;

 private:
  std::string where_;
};

/// Returns a value as text for error messages; long ones are shortened.
std::string text_of(const nlohmann::json& json);

}  // namespace chainmail
