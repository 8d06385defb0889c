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

/// Gives a text to a stream in pieces. Between pieces it reports progress and notices cancelling.
class TextBuffer : public std::streambuf {
 public:
  TextBuffer(std::string_view text, const Progress& progress) : text_(text), progress_(progress) {}

  /// Number of bytes that were read.
  std::size_t position() const { return done_ - static_cast<std::size_t>(egptr() - gptr()); }

 private:
  int_type underflow() override;

  std::string_view text_;
  const Progress& progress_;
  std::size_t done_ = 0;
};

/// Returns the line, from 1, of a byte of a text.
std::size_t line_at(std::string_view text, std::size_t position);

/// Receives the values of a JSON file one by one, in the order of the text. No tree of the file is built, so reading
/// takes linear time. (The parser's own filter, which builds a tree, searches the parent of each object that ends.)
class JsonScan : public nlohmann::json_sax<nlohmann::json> {
 public:
  using Json = nlohmann::json;

  /// `content` is what the file should hold; `path` appears in errors.
  JsonScan(std::string_view text, const std::filesystem::path& path, const std::string& content)
      : text_(text), path_(path), remedy_("give " + content) {}

  /// Reads the whole text. Throws Error, with the line, if it is not JSON, and if it is nested deeper than our formats
  /// or has a number that is too large for a double; and Cancelled.
  void scan(const Progress& progress = {});

 protected:
  /// Receives a value that is neither an array nor an object.
  virtual void take_value(Json value) = 0;
  /// An array or an object begins. `empty` is an empty value of its type.
  virtual void open(Json empty) = 0;
  /// The innermost open array or object ends.
  virtual void close() = 0;
  virtual void take_key(const std::string& key) = 0;

 private:
  bool null() final { return put(nullptr); }
  bool boolean(bool value) final { return put(value); }
  bool number_integer(std::int64_t value) final { return put(value); }
  bool number_unsigned(std::uint64_t value) final { return put(value); }
  bool number_float(double value, const std::string& /*text*/) final { return put(value); }
  bool string(std::string& value) final { return put(std::move(value)); }
  bool binary(Json::binary_t& /*value*/) final { return false; }  // JSON has none
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

/// Builds the tree of one value inside a larger file. A tree with too many values keeps only the first ones: enough for
/// a check to refuse it and for an error to quote it.
class SmallTree {
 public:
  using Json = nlohmann::json;

  SmallTree();
  SmallTree(const SmallTree&) = delete;  // open_ points into the tree
  SmallTree& operator=(const SmallTree&) = delete;

  /// True while an array or object is open.
  bool is_open() const { return !open_.empty(); }
  void open(Json empty);
  /// The following functions need an open tree.
  void put(Json value) { add(std::move(value)); }
  void take_key(const std::string& key) { key_ = key; }
  void close() { open_.pop_back(); }
  /// Returns the closed tree, and begins another.
  Json take();

 private:
  static constexpr std::size_t most_values = 64;

  Json* add(Json value);

  Json tree_;
  Json dropped_;             // takes the place of values beyond most_values
  std::vector<Json*> open_;  // from the outermost on
  std::string key_;          // of the value that follows, in an object
  std::size_t values_ = 0;
};

}  // namespace chainmail
