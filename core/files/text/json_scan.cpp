#include "files/text/json_scan.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <streambuf>
#include <utility>

#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr std::size_t piece = std::size_t{1} << 18;  // bytes between two progress reports: a few milliseconds

/// Passes a text to a stream in pieces. Between pieces it reports progress and can be cancelled.
class TextBuffer : public std::streambuf {
 public:
  TextBuffer(std::string_view text, const Progress& progress) : text_(text), progress_(progress) {}

  /// Returns the number of bytes that were read.
  std::size_t position() const { return done_ - static_cast<std::size_t>(egptr() - gptr()); }

 private:
  int_type underflow() override {
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

  std::string_view text_;
  const Progress& progress_;
  std::size_t done_ = 0;
};

/// Receives the values of a file from nlohmann's parser, in the order of the text. (The parser's own filter takes
/// quadratic time, because it searches the parent of each object that ends.)
class JsonScanner {
 public:
  JsonScanner(std::string_view text, const std::filesystem::path& path, const std::string& where, const JsonForm& form,
              PackedJson& result, const Progress& progress)
      : text_(text), path_(path), where_(where), form_(form), result_(result), buffer_(text, progress) {}

  void scan() {
    std::istream stream(&buffer_);
    Json::sax_parse(stream, this);
  }

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return number(value, false); }
  bool number_unsigned(std::uint64_t value) {
    return number(value, value <= std::numeric_limits<std::uint32_t>::max());
  }
  bool number_float(double value, const std::string& /*text*/) { return number(value, false); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t& /*value*/) { return false; }  // JSON has none
  bool start_object(std::size_t /*size*/) { return open(Json::object()); }
  bool start_array(std::size_t /*size*/) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    if (skipped_ > 0) {
      return true;
    }
    if (open_.back()->contains(key)) {
      const bool in_item = items_ != nullptr && open_.size() > 2 && open_[1] == items_;
      const std::string item = in_item ? form_.item + std::to_string(items_taken_) : "";
      throw Error(where_ + item, in_quotes(key) + " appears twice", "remove one of them");
    }
    key_ = std::move(key);
    if (open_.size() == 1) {
      top_ = key_;
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string& last, const Json::exception& error);

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& problem) const {
    throw Error(where, problem, "use a file with " + form_.content);
  }
  template <class Number>
  bool number(Number value, bool is_id) {
    if (packed_ == nullptr || skipped_ > 0) {
      return put(value);
    }
    pack(double(value), is_id);
    return true;
  }
  bool put(Json value) {
    if (skipped_ > 0) {
      return true;
    }
    if (packed_ != nullptr) {
      refuse("is not a number");
      return true;
    }
    add(std::move(value));
    take_item();
    return true;
  }
  bool open(Json container) {
    if (depth_++ == limits::json_levels) {
      fail(where_, "it is nested too deeply");
    }
    const bool is_array = container.is_array();
    if (skipped_ > 0) {
      ++skipped_;
    } else if (packed_ != nullptr) {
      open_packed(is_array);
    } else if (is(form_.text)) {
      add(nullptr);
      text_begin_ = buffer_.position() - 1;  // with its bracket
      skipped_ = 1;
    } else if (const PackedKey* key = is_array ? packed_key() : nullptr) {
      ids_ = key->ids;
      add(result_.add({}));
      packed_ = &result_.arrays.back();
    } else {
      const bool has_items = is_array && is(form_.items);
      open_.push_back(&add(std::move(container)));
      if (has_items) {
        items_ = open_.back();
        values_outside_ = values_;
        arrays_outside_ = result_.arrays.size();
      }
    }
    return true;
  }
  bool close() {
    --depth_;
    if (skipped_ > 0) {
      if (--skipped_ == 0 && packed_ == nullptr) {
        result_.text = text_.substr(text_begin_, buffer_.position() - text_begin_);
      }
    } else if (in_row_) {
      end_row();
    } else if (packed_ != nullptr) {
      packed_ = nullptr;
    } else {
      open_.pop_back();
      take_item();
    }
    return true;
  }
  /// Adds a value to the tree.
  Json& add(Json value) {
    values_ += value.is_structured() || value.is_binary() ? limits::values_of_container : 1;
    values_ += is_member() ? limits::values_of_key : 0;
    if (values_ > limits::json_values) {
      fail(where_, "it contains too many values");
    }
    if (open_.empty()) {
      return result_.tree = std::move(value);
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return open_.back()->back();
    }
    return (*open_.back())[key_] = std::move(value);
  }
  /// Takes and drops the value that is complete, if it is an item.
  void take_item() {
    if (items_ == nullptr || open_.empty() || open_.back() != items_) {
      return;
    }
    form_.take(items_->back());
    items_->clear();
    ++items_taken_;
    result_.arrays.resize(arrays_outside_);
    values_ = values_outside_;
  }

  void pack(double number, bool is_id) {
    if (!packed_->fault.empty()) {
      return;
    }
    if (column_ < ids_) {
      if (!is_id) {
        refuse("is not a whole number");
        return;
      }
      packed_->ids.push_back(static_cast<std::uint32_t>(number));
    } else {
      packed_->reals.push_back(number);
    }
    if (in_row_) {
      ++column_;
    } else if (packed_->width == 0) {
      ++packed_->size;
    } else {
      refuse("is not a row");
    }
  }
  void open_packed(bool is_array) {
    if (is_array && !in_row_ && (packed_->size == 0 || packed_->width > 0)) {
      in_row_ = true;
    } else {
      refuse("is not a number");
      skipped_ = 1;
    }
  }
  void end_row() {
    if (column_ == 0 || (packed_->size > 0 && column_ != packed_->width)) {
      refuse("is a row of " + std::to_string(column_) + " numbers");
    }
    packed_->width = column_;
    ++packed_->size;
    in_row_ = false;
    column_ = 0;
  }
  void refuse(const std::string& problem) {
    if (packed_->fault.empty()) {
      packed_->fault = "number " + std::to_string(packed_->size) + " of '" + key_ + "' " + problem;
    }
  }

  bool is_member() const { return !open_.empty() && open_.back()->is_object(); }
  /// True if the value that follows is this member of the file.
  bool is(std::string_view member) const {
    return !member.empty() && open_.size() == 1 && is_member() && key_ == member;
  }
  const PackedKey* packed_key() const {
    if (!is_member() || (!form_.unpacked.empty() && top_ == form_.unpacked)) {
      return nullptr;
    }
    const auto found = std::ranges::find(form_.packed, key_, &PackedKey::key);
    return found == form_.packed.end() ? nullptr : &*found;
  }

  std::string_view text_;
  const std::filesystem::path& path_;
  const std::string& where_;
  const JsonForm& form_;
  PackedJson& result_;
  TextBuffer buffer_;

  std::size_t depth_ = 0, values_ = 0;
  std::vector<Json*> open_;     // arrays and objects of the tree, from the outermost on
  std::string key_, top_;       // of the value that follows, and the outermost key around it
  std::size_t skipped_ = 0;     // arrays and objects that are open and not in the tree
  std::size_t text_begin_ = 0;  // of the member that stays text
  Json* items_ = nullptr;       // the array whose items are taken
  std::size_t items_taken_ = 0;
  std::size_t values_outside_ = 0, arrays_outside_ = 0;  // before the items
  PackedArray* packed_ = nullptr;                        // the one that is open
  std::size_t ids_ = 0, column_ = 0;                     // of its items, and in its open row
  bool in_row_ = false;
};

bool JsonScanner::parse_error(std::size_t position, const std::string& /*last*/, const Json::exception& error) {
  if (dynamic_cast<const Json::parse_error*>(&error) == nullptr) {
    fail(where_, "it contains a number that is too large for a double");
  }
  const auto lines = std::ranges::count(text_.substr(0, std::min(position, text_.size())), '\n');
  fail(shown(path_, static_cast<std::size_t>(1 + lines)),
       position > text_.size() ? "it ends too early" : "it is not JSON");
}

}  // namespace

Json PackedJson::add(PackedArray array) {
  arrays.push_back(std::move(array));
  return Json::binary(Json::binary_t::container_type(), arrays.size() - 1);
}

void scan_json(std::string_view text, const std::filesystem::path& path, const std::string& where, const JsonForm& form,
               PackedJson& result, const Progress& progress) {
  JsonScanner(text, path, where, form, result, progress).scan();
}

Json parse_json(std::string_view text, const std::filesystem::path& path, const std::string& content) {
  PackedJson result;
  scan_json(text, path, shown(path), {.content = content}, result);
  return std::move(result.tree);
}

}  // namespace chainmail
