#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "files/text/regular_file.h"
#include "mesh/progress.h"

namespace chainmail {

/// Makes a text from outside safe for a message: control characters and invalid UTF-8 become \xNN. So a message has one
/// line and cannot control a terminal.
std::string printable(std::string_view text);
/// Makes a text from outside one line: line ends and other control characters become blanks.
std::string one_line(std::string text);
/// Returns a word in quotes; long words are shortened.
std::string in_quotes(std::string_view word);
/// Returns a text with at most `most` bytes: of a longer one the beginning, which ends between two characters of UTF-8
/// and with an ellipsis.
std::string shortened(std::string_view text, std::size_t most);
/// Returns '1 hole' or '3 holes'.
std::string counted(std::size_t count, const char* one, const char* several);
/// Joins words with a text between them.
std::string joined_words(const std::vector<std::string>& words, const std::string& between);
/// Returns a path as text for messages; with a line, as `file:line`.
std::string shown(const std::filesystem::path& path);
std::string shown(const std::filesystem::path& path, std::size_t line);

/// Reads a whole text file and closes it. Throws Error if it is not a regular file, or if it is empty, too large or not
/// text. `content` describes the expected content in error messages.
std::string read_text(RegularFile file, const std::string& content, const Progress& progress = {});
std::string read_text(const std::filesystem::path& path, const std::string& content, const Progress& progress = {});
/// Reads a whole file that may be binary.
std::string read_bytes(RegularFile file, const std::string& content, const Progress& progress = {});

/// Reads a text line by line. Lines end with \n, \r\n or \r, and their numbers start at 1. A byte order mark at the
/// beginning is passed over.
class Lines {
 public:
  /// A backslash at the end of a line may join it to the next one.
  enum class Backslash { is_text, joins };

  explicit Lines(std::string_view text, Backslash backslash = Backslash::is_text);

  /// Moves to the next line. Returns false at the end.
  bool next();
  std::string_view line() const { return line_; }
  /// The number of the line; of joined lines the first one.
  std::size_t number() const { return number_; }
  /// Reports the share of the text that was read.
  void report(const Progress& progress) const;

 private:
  std::string_view take_line();

  std::size_t size_;
  Backslash backslash_;
  std::string_view rest_;
  std::string_view line_;
  std::string joined_;
  std::size_t number_ = 0, ends_ = 0;
};

/// Returns the length of the byte order mark of UTF-8 with which a text begins, or 0.
std::size_t mark_length(std::string_view text);

/// Removes the first word from a line and returns it; empty if there is none. Blanks and tabs separate words.
std::string_view take_word(std::string_view& rest);

/// Returns a text without the blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// Converts A to Z to lower case. Other characters stay.
std::string lower_case(std::string_view text);

/// True if a word is `lower`, which has lower-case letters, in upper or lower case.
bool is_word(std::string_view word, std::string_view lower);

/// Parses a word that is a finite decimal number, to the nearest double; a number that is too small for it is 0.
std::optional<double> parse_number(std::string_view word);
/// True if a word would be a number with a point instead of a comma.
bool has_decimal_comma(std::string_view word);
/// Returns what to write instead of a word that parse_number() refuses.
std::string number_remedy(std::string_view word);
/// Parses a word of digits as a whole number of 32 bits.
std::optional<std::uint32_t> parse_count(std::string_view word);

/// Appends the fewest digits that read back as the same number.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::uint64_t number);

/// Writes text to a stream in large blocks, because writing each word to a stream or a string is slow.
class TextBlocks {
 public:
  explicit TextBlocks(std::ostream& out) : out_(out) {}
  TextBlocks(const TextBlocks&) = delete;
  TextBlocks& operator=(const TextBlocks&) = delete;

  TextBlocks& operator<<(char character);
  TextBlocks& operator<<(std::string_view text);
  /// Writes a number as append_number does.
  TextBlocks& operator<<(double number);
  TextBlocks& operator<<(std::uint32_t number);
  /// Writes the remaining text. Call this at the end.
  void flush();

 private:
  static constexpr std::ptrdiff_t longest_word = 32;

  void make_room();

  std::ostream& out_;
  std::array<char, std::size_t{1} << 16> block_;
  char* end_ = block_.data();
};

/// Returns the reason for the failure of the last system call, from errno.
std::string system_reason();
/// Returns what to do about that failure: an answer for what the whole system is short of, else `otherwise`.
std::string system_remedy(const std::string& otherwise);

/// Returns the values of a comment `# WORD value…`; none if the first value does not begin like a number, because then
/// the comment is a sentence.
std::optional<std::string_view> stated(std::string_view line, std::string_view word);

/// Returns the value of a comment `# space N`. Throws Error at `path:number` unless N is 1, 2 or 3.
std::optional<int> stated_space(std::string_view line, const std::filesystem::path& path, std::size_t number);

}  // namespace chainmail
