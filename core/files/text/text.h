#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "mesh/progress.h"

namespace chainmail {

/// A text from outside as a message may show it: control characters and what is not UTF-8 become \xNN,
/// so that a message stays one line and cannot steer a terminal.
std::string printable(std::string_view text);
/// A word from a file, in quotes, shortened where it is long.
std::string in_quotes(std::string_view word);
/// A path as messages show it, and with a line as `file:line`.
std::string shown(const std::filesystem::path& path);
std::string shown(const std::filesystem::path& path, std::size_t line);

/// The whole of a text file. Throws Error where it is no regular file, empty, too large or not text; `content` is what
/// the file should hold.
std::string read_text(const std::filesystem::path& path, const std::string& content = "a mesh",
                      const Progress& progress = {});
/// The same of a file that need not be text.
std::string read_bytes(const std::filesystem::path& path, const std::string& content = "a mesh",
                       const Progress& progress = {});

/// Walks through a text line by line; lines end in \n, \r\n or \r and count from 1.
class Lines {
 public:
  explicit Lines(std::string_view text);

  /// Goes to the next line; says whether there is one.
  bool next();
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }
  /// How much of the text is done.
  void report(const Progress& progress) const;

 private:
  std::size_t size_;
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
};

/// Takes the first word off a line (words are parted by blanks and tabs); empty where none is left.
std::string_view take_word(std::string_view& rest);

/// A finite number in decimal digits, nothing behind it; the nearest double.
std::optional<double> parse_number(std::string_view word);
/// A whole number from 0 that fits 32 bits, in digits alone.
std::optional<std::uint32_t> parse_count(std::string_view word);

/// The fewest digits that read back as the same number.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::uint64_t number);

/// Text on its way to a stream, in blocks: a stream, and a string, take long over each word.
class TextBlocks {
 public:
  explicit TextBlocks(std::ostream& out) : out_(out) {}
  TextBlocks(const TextBlocks&) = delete;
  TextBlocks& operator=(const TextBlocks&) = delete;

  TextBlocks& operator<<(char character);
  TextBlocks& operator<<(std::string_view text);
  /// As append_number does.
  TextBlocks& operator<<(double number);
  TextBlocks& operator<<(std::uint32_t number);
  /// To be called at the end.
  void flush();

 private:
  static constexpr std::ptrdiff_t longest_word = 32;

  void make_room();

  std::ostream& out_;
  std::array<char, std::size_t{1} << 16> block_;
  char* end_ = block_.data();
};

/// A comment `# WORD value…` that states something: the line behind WORD where its first word begins
/// like a number. Prose that happens to begin with WORD is none.
std::optional<std::string_view> stated(std::string_view line, std::string_view word);

/// The value of a comment `# space N`; throws Error at `path:number` for any N but 1, 2 and 3.
std::optional<int> stated_space(std::string_view line, const std::filesystem::path& path, std::size_t number);

}  // namespace chainmail
