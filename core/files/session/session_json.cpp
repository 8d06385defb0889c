#include "files/session/session_json.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <string>

#include "files/text/json_scan.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Json = nlohmann::json;

constexpr std::size_t deepest = 16;
// Of what is neither packed nor moves. A value takes some hundred times the memory of its text.
constexpr std::size_t most_values = 10'000'000;

enum class Packed { no, ids, reals };

/// What a member of the session that `top` is, or is part of, holds as numbers alone.
Packed packed_as(const std::string& top, const std::string& key) {
  if (top == "ui") {
    return Packed::no;
  }
  for (const char* ids :
       {"links", "counts", "neighbours", "triangles", "polygons", "tetrahedra", "hexahedra", "cuts", "pins", "runs"}) {
    if (key == ids) {
      return Packed::ids;
    }
  }
  return key == "rest" || key == "own" || key == "held" ? Packed::reals : Packed::no;
}

/// What nlohmann's parser calls, value by value.
class Scanner {
 public:
  /// Reads from `buffer`, which holds the text.
  Scanner(std::string_view text, const TextBuffer& buffer, const std::filesystem::path& path, SessionJson& result)
      : text_(text), buffer_(buffer), file_(shown(path)), path_(path), result_(result) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return number(value, double(value), std::nullopt); }
  bool number_unsigned(std::uint64_t value) { return number(value, double(value), value); }
  bool number_float(double value, const std::string&) { return number(value, value, std::nullopt); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // JSON has none
  bool start_object(std::size_t) { return open(Json::object()); }
  bool key(std::string& key);
  bool end_object() { return close(); }
  bool start_array(std::size_t);
  bool end_array();
  bool parse_error(std::size_t position, const std::string& last, const Json::exception& error);

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(file_, problem, remedy);
  }
  template <class Value>
  bool number(Value value, double real, std::optional<std::uint64_t> whole);
  bool put(Json value);
  bool open(Json container);
  bool close();
  Json& place(Json value);
  std::size_t packed_count() const;
  [[noreturn]] void refuse_in_array() const;

  std::string_view text_;
  const TextBuffer& buffer_;
  std::string file_;
  const std::filesystem::path& path_;
  SessionJson& result_;
  std::vector<Json*> open_;  // from the outermost on
  std::string key_;          // of the value that follows, in an object
  std::string top_;          // the outermost key
  Packed packed_ = Packed::no;
  std::size_t values_ = 0;
  std::size_t moves_begin_ = 0;  // in the text
  std::size_t in_moves_ = 0;     // number of arrays and objects of the moves that are open
};

std::size_t Scanner::packed_count() const {
  return packed_ == Packed::ids ? result_.ids.back().size() : result_.reals.back().size();
}

void Scanner::refuse_in_array() const {
  const bool ids = packed_ == Packed::ids;
  fail("number " + std::to_string(packed_count()) + " of '" + key_ + "' is no " + (ids ? "whole number" : "number"),
       ids ? "whole numbers run from 0 to 4294967295" : "write decimal numbers alone");
}

template <class Value>
bool Scanner::number(Value value, double real, std::optional<std::uint64_t> whole) {
  if (in_moves_ > 0) {
    return true;
  }
  if (packed_ == Packed::reals) {
    result_.reals.back().push_back(real);
    return true;
  }
  if (packed_ == Packed::ids) {
    if (!whole || *whole > std::numeric_limits<std::uint32_t>::max()) {
      refuse_in_array();
    }
    result_.ids.back().push_back(static_cast<std::uint32_t>(*whole));
    return true;
  }
  if (open_.size() == 1 && key_ == "version" && whole && *whole > session_version) {
    fail("its version is " + std::to_string(*whole) + ", and this program knows " + std::to_string(session_version) +
             " and older",
         "open it with a newer program");
  }
  return put(value);
}

/// Puts a value where it stands in the tree.
Json& Scanner::place(Json value) {
  if (++values_ > most_values) {
    fail("it holds too many values", "give a session");
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

bool Scanner::put(Json value) {
  if (in_moves_ > 0) {
    return true;
  }
  if (packed_ != Packed::no) {
    refuse_in_array();
  }
  if (!open_.empty() && open_.back()->is_object() && packed_as(top_, key_) != Packed::no) {
    fail("'" + key_ + "' is not an array", "write it in [ ]");
  }
  place(std::move(value));
  return true;
}

bool Scanner::open(Json container) {
  if (open_.size() + in_moves_ == deepest) {
    fail("it is nested too deeply", "give a session");
  }
  if (packed_ != Packed::no) {
    refuse_in_array();
  }
  if (in_moves_ > 0 || (open_.size() == 1 && key_ == "moves")) {
    if (in_moves_++ == 0) {
      place(nullptr);
      moves_begin_ = buffer_.position() - 1;  // with its bracket
    }
    return true;
  }
  open_.push_back(&place(std::move(container)));
  return true;
}

bool Scanner::close() {
  if (in_moves_ == 0) {
    open_.pop_back();
  } else if (--in_moves_ == 0) {
    result_.moves = text_.substr(moves_begin_, buffer_.position() - moves_begin_);
  }
  return true;
}

bool Scanner::key(std::string& key) {
  if (in_moves_ > 0) {
    return true;
  }
  if (open_.back()->contains(key)) {
    fail(in_quotes(key) + " stands twice", "remove one of them");
  }
  key_ = std::move(key);
  if (open_.size() == 1) {
    top_ = key_;
  }
  return true;
}

bool Scanner::start_array(std::size_t) {
  const bool named = in_moves_ == 0 && !open_.empty() && open_.back()->is_object();
  const Packed packed = named && packed_ == Packed::no ? packed_as(top_, key_) : Packed::no;
  if (packed == Packed::no) {
    return open(Json::array());
  }
  place(packed == Packed::ids ? result_.ids.size() : result_.reals.size());
  packed_ = packed;
  if (packed == Packed::ids) {
    result_.ids.emplace_back();
  } else {
    result_.reals.emplace_back();
  }
  return true;
}

bool Scanner::end_array() {
  if (packed_ == Packed::no) {
    return close();
  }
  packed_ = Packed::no;
  return true;
}

bool Scanner::parse_error(std::size_t position, const std::string&, const Json::exception& error) {
  if (dynamic_cast<const Json::parse_error*>(&error) == nullptr) {
    fail("a number in it is beyond what a double holds", "give a session");
  }
  const bool ended = position > text_.size();
  throw Error(shown(path_, line_at(text_, position)), ended ? "it ends too early" : "it is not JSON",
              "give a session as it was saved");
}

}  // namespace

SessionJson parse_session_json(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  SessionJson result;
  TextBuffer buffer(text, progress);
  Scanner scanner(text, buffer, path, result);
  std::istream stream(&buffer);
  Json::sax_parse(stream, &scanner);
  return result;
}

}  // namespace chainmail
