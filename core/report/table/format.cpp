#include "report/table/format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace chainmail::report {
namespace {

std::string written(double number, std::chars_format format, int precision) {
  std::array<char, 400> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, format, precision).ptr;
  return {digits.data(), end};
}

/// Returns the number of bytes of the first UTF-8 character; 0 if it is invalid.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80                      ? 1
                             : byte(0) >= 0xC2 && byte(0) < 0xE0 ? 2
                             : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                             : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                                 : 0;
  if (length == 0 || length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) >= 0xC0) {
      return 0;
    }
  }
  // Overlong forms, surrogates, and codes above the last character.
  const bool wrong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) >= 0xA0) ||
                     (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) >= 0x90);
  return wrong ? 0 : length;
}

std::string_view entity_of(char character) {
  switch (character) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

constexpr const char* thousands_separator = ",";
constexpr const char* figure_space = "\u2007";  // as wide as a digit
constexpr const char* point_space = "\u2008";   // as wide as a point
constexpr double least_grouped = 1e3, max_grouped = 1e6;

/// Returns the number of digits behind the point of a figure such as '0.12', '1.5%' or '12'; none for other texts.
std::optional<std::size_t> decimals_of(const std::string& text) {
  std::string number = text.substr(0, text.ends_with('%') ? text.size() - 1 : text.size());
  for (auto at = number.find(thousands_separator); at != std::string::npos; at = number.find(thousands_separator)) {
    number.erase(at, std::string_view(thousands_separator).size());
  }
  if (number.empty() || number.find_first_not_of("0123456789.-") != std::string::npos) {
    return std::nullopt;
  }
  const auto point = number.find('.');
  return point == std::string::npos ? 0 : number.size() - point - 1;
}

}  // namespace

std::string error_figure(double error, const std::optional<double>& change) {
  return change && error < *change ? "below " + figure(*change) : figure(error);
}

std::string thousands(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t end = text.size(); end > 3; end -= 3) {
    text.insert(end - 3, thousands_separator);
  }
  return text;
}

std::vector<std::string> aligned(std::vector<std::string> column) {
  std::size_t most = 0;
  for (const std::string& text : column) {
    most = std::max(most, decimals_of(text).value_or(0));
  }
  for (std::string& text : column) {
    if (const auto decimals = decimals_of(text)) {
      for (std::size_t i = *decimals; i < most; ++i) {
        text += figure_space;
      }
      text += *decimals == 0 && most > 0 ? point_space : "";
    }
  }
  return column;
}

std::string figure(double number, int digits) {
  if (std::abs(number) >= least_grouped && std::abs(number) < max_grouped) {
    return (number < 0 ? "-" : "") + thousands(static_cast<std::uint64_t>(std::llround(std::abs(number))));
  }
  std::string text = written(number, std::chars_format::general, digits);
  // 1e-07 reads better as 1e-7.
  if (const auto power = text.find('e'); power != std::string::npos) {
    const auto first = power + 2;
    text.erase(first, text.find_first_not_of('0', first) - first);
    if (text[power + 1] == '+') {
      text.erase(power + 1, 1);
    }
  }
  return text;
}

std::string figure(const std::optional<double>& number) { return number ? figure(*number) : "n/a"; }

namespace {

/// Formats numbers of a softness with their names.
std::string in_words(const LinkSoftness& softness, std::span<const SoftnessNumber> numbers) {
  std::string text;
  for (const auto& [parameter, value] : numbers) {
    text += (text.empty() ? "" : ", ") + std::string(parameter->name) + " " + figure(softness.*value);
  }
  return text;
}

}  // namespace

std::string region_in_words(const LinkSoftness& softness) {
  return in_words(softness, std::span(softness_numbers).first(region_numbers));
}

/// The stiffness of all links at once changes nothing, so no calibration finds it.
std::string energy_in_words(const LinkSoftness& softness) {
  std::vector<SoftnessNumber> found(softness_numbers.begin() + region_numbers, softness_numbers.end());
  std::erase_if(found, [](const SoftnessNumber& one) { return one.value == &LinkSoftness::stiffness; });
  return in_words(softness, found);
}

std::string time_in_words(double ms) {
  constexpr double least_ms = 0.1, most_ms = 1000;
  return ms < least_ms ? figure(1e3 * ms) + " µs" : ms > most_ms ? figure(ms / 1e3) + " s" : figure(ms) + " ms";
}

std::string signed_percent(const std::optional<double>& change) {
  return change ? (*change > 0 ? "+" : "") + figure(100 * *change) : figure(change);
}

std::string count(const std::optional<double>& number) {
  return number ? thousands(std::uint64_t(*number)) : figure(number);
}

std::string percent(double share) { return figure(100 * share) + "%"; }
std::string percent(const std::optional<double>& share) { return share ? percent(*share) : figure(share); }

std::string all_digits(double number) {
  std::array<char, 40> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

std::string all_digits(const std::optional<double>& number) { return number ? all_digits(*number) : ""; }

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char character : text) {
    quoted += character == '"' ? "\"\"" : std::string(1, character);
  }
  return quoted + '"';
}

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const bool control = static_cast<unsigned char>(text[0]) < 0x20 && text[0] != '\t' && text[0] != '\n';
    if (length == 0 || control || text[0] == 0x7F) {
      result += '?';
    } else if (const auto entity = entity_of(text[0]); !entity.empty()) {
      result += entity;
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

}  // namespace chainmail::report
