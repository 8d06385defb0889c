#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// Passes a text to a stream in pieces. Between pieces it reports progress and can be cancelled.
class TextBuffer : public std::streambuf {
 public:
  TextBuffer(std::string_view text, const Progress& progress) : text_(text), progress_(progress) {}

  /// Returns the number of bytes that were read.
  std::size_t position() const { return done_ - static_cast<std::size_t>(egptr() - gptr()); }

 private:
  int_type underflow() override;

  std::string_view text_;
  const Progress& progress_;
  std::size_t done_ = 0;
};

/// Returns the number of the line, from 1, that contains a byte of a text.
std::size_t line_at(std::string_view text, std::size_t position);

/// Receives the values of a JSON file one by one, in the order of the text. It builds no tree of the file, so reading
/// takes linear time. (The parser's own filter takes longer, because it searches the parent of each object that ends.)
class JsonScan : public nlohmann::json_sax<nlohmann::json> {
 public:
  using Json = nlohmann::json;

  /// `content` describes the expected content, and `path` the file, in error messages.
  JsonScan(std::string_view text, const std::filesystem::path& path, const std::string& content)
      : text_(text), path_(path), remedy_("use a file with " + content) {}

  /// Reads the whole text. Throws Error, with the line, if it is not JSON, if it is nested deeper than our formats, or
  /// if it contains a number that is too large for a double. Throws Cancelled.
  void scan(const Progress& progress = {});

 protected:
  /// Receives a value that is neither an array nor an object.
  virtual void take_value(Json value) = 0;
  /// Begins an array or an object. `empty` is an empty value of its type.
  virtual void open(Json empty) = 0;
  /// Ends the innermost open array or object.
  virtual void close() = 0;
  virtual void take_key(const std::string& key) = 0;

 private:
  bool null() final { return put(nullptr); }
  bool boolean(bool value) final { return put(value); }
  bool number_integer(std::int64_t value) final { return put(value); }
  bool number_unsigned(std::uint64_t value) final { return put(value); }
  bool number_float(double value, const std::string& /*text*/) final { return put(value); }
  bool string(std::string& value) final { return put(std::move(value)); }
  bool binary(Json::binary_t& /*value*/) final { return false; }  // JSON has no binary values
  bool start_object(std::size_t /*size*/) final { return enter(Json::object()); }
  bool start_array(std::size_t /*size*/) final { return enter(Json::array()); }
  bool end_object() final { return leave(); }
  bool end_array() final { return leave(); }
  bool key(std::string& key) final;
  bool parse_error(std::size_t position, const std::string& last, const Json::exception& error) final;

  bool put(Json value);
  bool enter(Json empty);
  bool leave();

  std::string_view text_;
  const std::filesystem::path& path_;
  std::string remedy_;
  std::size_t depth_ = 0;
};

/// Builds the tree of one value inside a larger file. A tree with too many values keeps only the first ones. They are
/// enough to refuse it, and to quote it in the error message.
class SmallTree {
 public:
  using Json = nlohmann::json;

  SmallTree();
  SmallTree(const SmallTree&) = delete;  // open_ points into the tree
  SmallTree& operator=(const SmallTree&) = delete;

  /// Returns true while an array or object is open.
  bool is_open() const { return !open_.empty(); }
  void open(Json empty);
  /// Adds a value to an open tree. The functions below also need an open tree.
  void put(Json value) { add(std::move(value)); }
  void take_key(const std::string& key) { key_ = key; }
  void close() { open_.pop_back(); }
  /// Returns the finished tree, and begins another one.
  Json take();

 private:
  static constexpr std::size_t max_values = 64;

  Json* add(Json value);

  Json tree_;
  Json dropped_;             // replaces values beyond max_values
  std::vector<Json*> open_;  // open arrays and objects, the outermost first
  std::string key_;          // key of the next value in an object
  std::size_t values_ = 0;
};

}  // namespace chainmail
