#include "files/text/json_scan.h"

#include <algorithm>
#include <istream>
#include <utility>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Largest depth of nested arrays and objects. Our formats need 5. The limit protects memory and stack.
constexpr std::size_t deepest = 16;
constexpr std::size_t piece = std::size_t{1} << 18;  // bytes between two progress reports: a few milliseconds

}  // namespace

TextBuffer::int_type TextBuffer::underflow() {
  if (done_ == text_.size()) {
    return traits_type::eof();
  }
  progress_.report(double(done_) / double(text_.size()));
  const std::size_t size = std::min(piece, text_.size() - done_);
  char* first = const_cast<char*>(text_.data()) + done_;  // the stream only reads it
  setg(first, first, first + size);
  done_ += size;
  return traits_type::to_int_type(*first);
}

std::size_t line_at(std::string_view text, std::size_t position) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(position, text.size()));
  return static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n'));
}

void JsonScan::scan(const Progress& progress) {
  depth_ = 0;
  TextBuffer buffer(text_, progress);
  std::istream stream(&buffer);
  Json::sax_parse(stream, static_cast<nlohmann::json_sax<Json>*>(this));
}

bool JsonScan::put(Json value) {
  take_value(std::move(value));
  return true;
}

bool JsonScan::enter(Json empty) {
  if (depth_++ == deepest) {
    throw Error(shown(path_), "it is nested too deeply", remedy_);
  }
  open(std::move(empty));
  return true;
}

bool JsonScan::leave() {
  --depth_;
  close();
  return true;
}

bool JsonScan::key(std::string& key) {
  take_key(key);
  return true;
}

bool JsonScan::parse_error(std::size_t position, const std::string& /*last*/, const Json::exception& error) {
  if (dynamic_cast<const Json::parse_error*>(&error) == nullptr) {
    throw Error(shown(path_), "it contains a number that is too large for a double", remedy_);
  }
  throw Error(shown(path_, line_at(text_, position)), "it is not JSON", remedy_);
}

SmallTree::SmallTree() = default;

void SmallTree::open(Json empty) { open_.push_back(add(std::move(empty))); }

nlohmann::json SmallTree::take() {
  values_ = 0;
  return std::exchange(tree_, Json());
}

/// Adds a value to the innermost open array or object, and returns its address.
nlohmann::json* SmallTree::add(Json value) {
  if (open_.empty()) {
    tree_ = std::move(value);
    return &tree_;
  }
  if (++values_ > max_values || open_.back() == &dropped_) {
    return &dropped_;
  }
  Json& parent = *open_.back();
  if (parent.is_object()) {
    return &(parent[key_] = std::move(value));
  }
  parent.push_back(std::move(value));
  return &parent.back();
}

}  // namespace chainmail
