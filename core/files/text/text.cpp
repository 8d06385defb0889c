#include "files/text/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "files/text/limits.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t longest_quote = 40;
constexpr std::size_t lines_between_reports = 4096;  // one or two milliseconds

/// Returns the length of the UTF-8 sequence at the start of a text (bytes); 0 if it is invalid.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (length == 0 || length > text.size() || byte(0) > 0xf4) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) {
      return 0;
    }
  }
  // Overlong forms, surrogates, and codes beyond Unicode.
  const bool wrong = length > 2 && ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
                                    (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f));
  return wrong ? 0 : length;
}

bool is_control(std::string_view sequence) {
  const auto first = static_cast<unsigned char>(sequence[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(sequence[1]) < 0xa0);
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

std::string printable(std::string_view text) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length != 0 && !is_control(text.substr(0, length))) {
      result += text.substr(0, length);
    } else {
      for (const char c : text.substr(0, std::max<std::size_t>(length, 1))) {
        const auto byte = static_cast<unsigned char>(c);
        result += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
      }
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string one_line(std::string text) {
  // U+0085, U+2028 and U+2029 end a line, too.
  for (const std::string_view end : {"\u0085", "\u2028", "\u2029"}) {
    for (std::size_t at = text.find(end); at != std::string::npos; at = text.find(end, at)) {
      text.replace(at, end.size(), " ");
    }
  }
  std::ranges::replace_if(
      text, [](unsigned char one) { return one < ' ' || one == 0x7f; }, ' ');
  return text;
}

std::string in_quotes(std::string_view word) {
  const bool is_long = word.size() > longest_quote;
  return "'" + printable(word.substr(0, longest_quote)) + (is_long ? "…'" : "'");
}

std::string shortened(std::string_view text, std::size_t most) {
  static constexpr std::string_view ellipsis = "…";
  if (text.size() <= most) {
    return std::string(text);
  }
  std::size_t end = most - ellipsis.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
    --end;
  }
  return std::string(text.substr(0, end)) + std::string(ellipsis);
}

std::string counted(std::size_t count, const char* one, const char* several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

std::string joined_words(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

std::string shown(const std::filesystem::path& path) { return path.empty() ? "''" : printable(path.string()); }

std::string shown(const std::filesystem::path& path, std::size_t line) {
  return shown(path) + ":" + std::to_string(line);
}

namespace {

/// Reads a whole file. A text file must not contain a byte 0.
// Some programs end a text with zero bytes, or with the end of file of CP/M, Ctrl+Z.
constexpr std::string_view padding("\0\x1a", 2), padding_and_blanks("\0\x1a \t\r\n", 6);

/// True if text stands behind a zero byte.
bool is_binary(std::string_view text, std::size_t from) {
  const std::size_t zero = text.find('\0', from);
  return zero != std::string_view::npos && text.find_first_not_of(padding_and_blanks, zero) != std::string_view::npos;
}

std::string read_whole(RegularFile file, bool is_text, const std::string& content, const Progress& progress) {
  const std::filesystem::path& path = file.path();
  const Error too_large(shown(path), "it is larger than 4 GiB", "use a smaller file");
  const Error no_text(shown(path), "it is not a text file", "use a text file with " + content);
  if (file.size() > limits::file_bytes) {
    throw too_large;
  }
  std::string text;
  text.reserve(file.size());
  std::vector<char> part(std::size_t{1} << 20);
  while (const std::size_t got = file.read(part)) {
    text.append(part.data(), got);
    progress.report(std::min(1.0, double(text.size()) / double(file.size())));
    if (is_text && is_binary(text, text.size() - got)) {
      throw no_text;  // before the rest of a large file is read
    }
    if (text.size() > limits::file_bytes) {
      throw too_large;  // the file grew while it was read
    }
  }
  if (text.empty()) {
    throw Error(shown(path), "it is empty", "use a file that contains " + content);
  }
  if (is_text && is_binary(text, 0)) {
    throw no_text;
  }
  const std::size_t end = text.find_last_not_of(padding_and_blanks) + 1;
  if (is_text && text.find_first_of(padding, end) != std::string::npos) {
    text.resize(std::max<std::size_t>(end, 1));
  }
  return text;
}

}  // namespace

std::string read_text(RegularFile file, const std::string& content, const Progress& progress) {
  return read_whole(std::move(file), true, content, progress);
}

std::string read_text(const std::filesystem::path& path, const std::string& content, const Progress& progress) {
  return read_text(RegularFile(path), content, progress);
}

std::string read_bytes(RegularFile file, const std::string& content, const Progress& progress) {
  return read_whole(std::move(file), false, content, progress);
}

std::size_t mark_length(std::string_view text) {
  static constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  return text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
}

Lines::Lines(std::string_view text, Backslash backslash) : size_(text.size()), backslash_(backslash), rest_(text) {
  rest_.remove_prefix(mark_length(text));
}

std::string_view Lines::take_line() {
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : rest_.empty() ? 0 : 1);
  ++ends_;
  return line;
}

bool Lines::next() {
  if (rest_.empty()) {
    return false;
  }
  number_ = ends_ + 1;
  line_ = take_line();
  if (backslash_ == Backslash::joins && line_.ends_with('\\')) {
    joined_.clear();
    for (; line_.ends_with('\\') && !rest_.empty(); line_ = take_line()) {
      joined_ += line_.substr(0, line_.size() - 1);
      joined_ += ' ';
    }
    joined_ += line_.substr(0, line_.size() - (line_.ends_with('\\') ? 1 : 0));
    line_ = joined_;
  }
  return true;
}

void Lines::report(const Progress& progress) const {
  if (ends_ % lines_between_reports == 0) {
    progress.report(1 - double(rest_.size()) / double(size_));
  }
}

std::string_view take_word(std::string_view& rest) {
  std::size_t first = 0;
  while (first < rest.size() && is_blank(rest[first])) {
    ++first;
  }
  std::size_t last = first;
  while (last < rest.size() && !is_blank(rest[last])) {
    ++last;
  }
  const std::string_view word = rest.substr(first, last - first);
  rest.remove_prefix(last);
  return word;
}

std::string_view trimmed(std::string_view text) {
  static constexpr std::string_view removed = " \t\r";
  const std::size_t first = text.find_first_not_of(removed);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(removed) + 1 - first);
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// True if a decimal number that no double holds is too small, not too large.
bool is_tiny(std::string_view word) {
  const std::size_t end = std::min(word.find_first_of("eE"), word.size());
  const std::string_view digits = word.substr(0, end);
  const std::size_t first = digits.find_first_of("123456789"), point = std::min(digits.find('.'), digits.size());
  std::string_view written = word.substr(std::min(end + 1, word.size()));
  written.remove_prefix(written.starts_with('+') ? 1 : 0);
  std::int64_t power = 0;
  const auto parsed = std::from_chars(written.data(), written.data() + written.size(), power);
  if (parsed.ec == std::errc::result_out_of_range) {
    return written.starts_with('-');
  }
  // The power of ten of the first digit.
  return first == std::string_view::npos ||
         power + (std::int64_t(point) - std::int64_t(first)) - (first < point ? 1 : 0) < 0;
}

std::optional<double> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);  // files contain a plus sign, which from_chars does not accept
  }
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc::result_out_of_range && end == word.data() + word.size() && is_tiny(word)) {
    return 0;
  }
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

bool has_decimal_comma(std::string_view word) {
  std::string with_point(word);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return with_point != word && parse_number(with_point);
}

std::string number_remedy(std::string_view word) {
  return has_decimal_comma(word) ? "write a decimal point instead of the comma" : "write a finite decimal number";
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

std::optional<std::uint32_t> parse_count(std::string_view word) {
  std::uint64_t number = 0;
  for (const char c : word) {
    const unsigned digit = static_cast<unsigned char>(c) - unsigned{'0'};
    number = 10 * number + digit;
    if (digit > 9 || number > std::numeric_limits<std::uint32_t>::max()) {
      return std::nullopt;
    }
  }
  return word.empty() ? std::nullopt : std::optional(static_cast<std::uint32_t>(number));
}

void append_number(std::string& text, double number) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

void append_number(std::string& text, std::uint64_t number) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

void TextBlocks::flush() {
  out_.write(block_.data(), end_ - block_.data());
  end_ = block_.data();
}

void TextBlocks::make_room() {
  if (block_.data() + block_.size() - end_ < longest_word) {
    flush();
  }
}

TextBlocks& TextBlocks::operator<<(char character) {
  make_room();
  *end_++ = character;
  return *this;
}

TextBlocks& TextBlocks::operator<<(std::string_view text) {
  while (!text.empty()) {
    make_room();
    const auto part = text.substr(0, static_cast<std::size_t>(block_.data() + block_.size() - end_));
    end_ = std::copy(part.begin(), part.end(), end_);
    text.remove_prefix(part.size());
  }
  return *this;
}

TextBlocks& TextBlocks::operator<<(double number) {
  make_room();
  end_ = std::to_chars(end_, end_ + longest_word, number).ptr;
  return *this;
}

TextBlocks& TextBlocks::operator<<(std::uint32_t number) {
  make_room();
  end_ = std::to_chars(end_, end_ + longest_word, number).ptr;
  return *this;
}

std::optional<std::string_view> stated(std::string_view line, std::string_view word) {
  std::string_view rest = line;
  while (!rest.empty() && is_blank(rest[0])) {
    rest.remove_prefix(1);
  }
  if (!rest.starts_with('#')) {
    return std::nullopt;  // fast path: most lines are not comments
  }
  rest.remove_prefix(1);
  const std::string_view first = take_word(rest);
  std::string_view behind = rest;
  if (const auto value = take_word(behind);
      first != word || value.empty() || std::string_view("0123456789+-.").find(value[0]) == std::string_view::npos) {
    return std::nullopt;
  }
  return rest;
}

std::optional<int> stated_space(std::string_view line, const std::filesystem::path& path, std::size_t number) {
  auto rest = stated(line, "space");
  if (!rest) {
    return std::nullopt;
  }
  const auto space = parse_count(take_word(*rest));
  if (!space || *space < 1 || *space > 3 || !take_word(*rest).empty()) {
    throw Error(shown(path, number), "the space dimension is not 1, 2 or 3", "write '# space N' with one of these");
  }
  return static_cast<int>(*space);
}

std::string system_reason() { return std::generic_category().message(errno); }

std::string system_remedy(const std::string& otherwise) {
  switch (errno) {
    case EMFILE:
    case ENFILE:
    case EAGAIN:
    case ENOMEM:
      return "close other programs, or raise the limits of this user (ulimit)";
    default:
      return otherwise;
  }
}

}  // namespace chainmail
