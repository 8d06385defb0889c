#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/progress.h"

namespace chainmail {

/// Reads a text word by word, wherever its lines end. A comment begins with # and ends with its line; a byte order mark
/// at the beginning is passed over. For all text formats whose lines have no meaning, or only here and there.
class Words {
 public:
  Words(std::string_view text, const std::filesystem::path& path, const Progress& progress);

  /// Throws Error at the line of the last word.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  /// Moves to the next word and returns it; empty at the end.
  std::string_view next();
  /// Lets the next word begin so many bytes behind the begin of the last one.
  void split(std::size_t bytes) { at_ = last_ + bytes; }
  /// True if the last word is the first of its line.
  bool begins_line() const;
  /// True if no word follows on the line of the last word.
  bool ends_line() const;
  /// Moves to the end of the line.
  void skip_line();
  /// Returns the next word without moving to it.
  std::string_view peek() const;
  /// Returns the next word as a whole number. `what` describes it in error messages.
  std::uint32_t count(const char* what);
  /// Returns the next word as a coordinate.
  double coordinate();
  /// Moves past words that are numbers.
  void skip_numbers();
  /// Returns the number of bytes after the last word.
  std::size_t left() const { return text_.size() - at_; }

 private:
  void skip_blanks();

  std::string_view text_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  std::size_t at_ = 0;    // begin of what was not read
  std::size_t last_ = 0;  // begin of the last word
};

}  // namespace chainmail
