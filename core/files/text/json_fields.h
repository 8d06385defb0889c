#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/text/json_scan.h"
#include "files/text/limits.h"
#include "mesh/error.h"
#include "mesh/mesh.h"
#include "mesh/parameters.h"

namespace chainmail {

/// Checks and returns the members of objects. Throws Error if one is missing or has the wrong type.
class JsonFields {
 public:
  using Json = nlohmann::json;

  /// `where` appears in error messages. `arrays` are those of a PackedJson, if some are packed.
  explicit JsonFields(std::string where, const std::vector<PackedArray>* arrays = nullptr)
      : where_(std::move(where)), arrays_(arrays) {}

  const std::string& where() const { return where_; }
  void say_at(const std::string& where) { where_ = where; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// Returns the result of some work. An Error from it begins with where the members are.
  template <class Work>
  auto here(Work work) const {
    try {
      return work();
    } catch (const Error& error) {
      throw error.where().starts_with(where_) ? error : error.at(where_ + ": " + error.where());
    }
  }
  /// Throws Error if it is not an object, or if there is an unknown key, because it may be a misspelt one.
  void check_keys(const Json& object, const std::vector<std::string>& known) const;
  const Json& member(const Json& object, const std::string& key) const;
  const Json& array(const Json& object, const std::string& key) const;
  const Json& object(const Json& object, const std::string& key) const;
  /// Returns a text with at most `longest` bytes.
  std::string text(const Json& object, const std::string& key, std::size_t longest = limits::text_bytes) const;
  bool boolean(const Json& object, const std::string& key) const;
  /// Returns a whole number from `lowest` to `highest`.
  std::uint64_t whole(const Json& object, const std::string& key, std::uint64_t lowest, std::uint64_t highest) const;
  /// Returns the version of the format of a file, which this program knows up to `newest`.
  std::uint64_t version(const Json& file, std::uint64_t newest) const;
  /// Returns the index of the value of `key` among names.
  std::size_t choice(const Json& value, const std::string& key, std::span<const std::string_view> names) const;
  double number(const Json& json) const;
  /// Returns a number. Throws Error if it is not in the range of the parameter.
  double number(const Json& json, const Parameter& parameter) const;

  /// Returns three coordinates.
  Point point(const Json& object, const std::string& key) const;
  /// Returns a packed array whose width is one of these.
  const PackedArray& packed(const Json& object, const std::string& key,
                            std::initializer_list<std::size_t> widths = {0}) const;
  /// Requires an array to hold whole groups of `of_each` numbers.
  void check_groups(std::size_t size, std::size_t of_each, const std::string& key) const;

 private:
  std::string where_;
  const std::vector<PackedArray>* arrays_;
};

/// Returns a value as text for error messages; long ones are shortened.
std::string text_of(const nlohmann::json& json);

}  // namespace chainmail
