#include "files/text/words.h"

#include <algorithm>
#include <cmath>

#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

namespace chainmail {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

/// Returns the number of lines that end in a text. They end with \n, \r\n or \r.
std::size_t line_ends(std::string_view text) {
  std::size_t ends = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    ends += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) ? 1 : 0;
  }
  return ends;
}

}  // namespace

Words::Words(std::string_view text, const std::filesystem::path& path, const Progress& progress)
    : text_(text), path_(path), progress_(progress) {
  at_ = last_ = mark_length(text);
}

void Words::fail(const std::string& problem, const std::string& remedy) const {
  throw Error(shown(path_, 1 + line_ends(text_.substr(0, last_))), problem, remedy);
}

void Words::skip_blanks() {
  for (;;) {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    if (at_ == text_.size() || text_[at_] != '#') {
      return;
    }
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  }
}

std::string_view Words::next() {
  skip_blanks();
  progress_.report(at_, text_.size());
  last_ = at_;
  const std::size_t end = std::min(text_.find_first_of(blanks, at_), text_.size());
  const std::string_view word = text_.substr(at_, end - at_);
  at_ = end;
  return word;
}

bool Words::begins_line() const {
  const std::size_t before = text_.substr(0, last_).find_last_not_of(" \t\v\f");
  return before == std::string_view::npos || text_[before] == '\n' || text_[before] == '\r';
}

bool Words::ends_line() const {
  const std::size_t next = text_.find_first_not_of(" \t\v\f", at_);
  return next == std::string_view::npos || text_[next] == '\n' || text_[next] == '\r' || text_[next] == '#';
}

void Words::skip_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }

std::string_view Words::peek() const {
  Words ahead = *this;
  return ahead.next();
}

std::uint32_t Words::count(const char* what) {
  const std::string_view word = next();
  const auto number = parse_count(word);
  if (!number) {
    fail((word.empty() ? "a number is missing: " : in_quotes(word) + " is not ") + std::string(what),
         "write a whole number");
  }
  return *number;
}

double Words::coordinate() {
  const std::string_view word = next();
  const auto number = parse_number(word);
  if (!number || std::abs(*number) > coordinate_limit) {
    fail(word.empty() ? "it ends before all coordinates" : in_quotes(word) + " is not a valid coordinate",
         number_remedy(word));
  }
  return *number;
}

void Words::skip_numbers() {
  for (;;) {
    const std::size_t before = at_;
    const std::string_view word = next();
    if (word.empty() || !parse_number(word)) {
      at_ = before;
      return;
    }
  }
}

}  // namespace chainmail
