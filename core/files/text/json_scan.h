#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// A long array of numbers, without a tree. Its items are numbers, or rows of equally many numbers.
struct PackedArray {
  std::size_t size = 0;                 // number of items
  std::size_t width = 0;                // numbers in a row; 0: the items are numbers
  std::vector<std::uint32_t> ids = {};  // the whole numbers at the beginning of each item
  std::vector<double> reals = {};       // the other numbers
  std::string fault = {};               // what is wrong with the first item that is anything else; the rest is dropped
};

/// JSON whose long arrays are packed: in the tree, a marker takes the place of an array. A marker is a binary value,
/// which the text of a file cannot contain.
struct PackedJson {  // NOLINT(bugprone-exception-escape): moving a tree throws nothing, which its library does not say
  nlohmann::json tree;
  std::vector<PackedArray> arrays;
  std::string_view text;  // of the member that stays text

  /// Adds an array and returns its marker.
  nlohmann::json add(PackedArray array);
};

/// The key of an array that is packed. Of each item, the first `ids` numbers are whole.
struct PackedKey {
  std::string_view key;
  std::size_t ids;
};

/// A kind of JSON file: what of it does not become a tree.
struct JsonForm {
  std::string content;                                   // what the file contains, in error messages
  std::span<const PackedKey> packed = {};                // at any depth
  std::string_view unpacked = {};                        // a member that has no packed arrays inside
  std::string_view text = {};                            // a member that stays text if it is an array or an object
  std::string_view items = {};                           // an array whose items are dropped after they are taken
  std::string item = {};                                 // what follows `where` in errors, before the index of an item
  std::function<void(const nlohmann::json&)> take = {};  // takes an item
};

/// Reads JSON, in linear time, into `result`. Throws Error if the text is not JSON, and beyond what all our files keep
/// to: a depth, limits::json_values in memory at once, numbers in the range of a double, and each key once. Throws
/// Cancelled. `where` appears in errors, and `path` with the line in those about syntax.
void scan_json(std::string_view text, const std::filesystem::path& path, const std::string& where, const JsonForm& form,
               PackedJson& result, const Progress& progress = {});

/// Reads the JSON of a small file as a tree.
nlohmann::json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content);

}  // namespace chainmail
