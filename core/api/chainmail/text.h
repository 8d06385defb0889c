#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "chainmail/types.h"

namespace chainmail::api {

// Texts and numbers as the library reads and writes them, for programs that take arguments and write messages.

/// Makes a text from outside safe for a message: control characters and invalid UTF-8 become \\xNN. So a message has
/// one line and cannot control a terminal.
std::string printable(std::string_view text);
/// Returns a word in quotes; long words are shortened.
std::string in_quotes(std::string_view word);
/// Returns a path as text for messages.
std::string shown(const std::filesystem::path& path);

/// Returns the fewest digits that read back as the same number.
std::string digits_of(double number);
/// Returns a point as `(x, y, z)`, with these digits.
std::string in_words(const Vector3& point);
/// Returns a number for readers, with three significant digits. Numbers from 1,000 to a million are whole numbers with
/// separated thousands.
std::string figure(double number);

/// Parses a word that is a finite decimal number, to the nearest double. A number that is too small for it is 0.
std::optional<double> parse_number(std::string_view word);
/// Parses a word of digits as a whole number of 32 bits.
std::optional<std::uint32_t> parse_count(std::string_view word);
/// Parses a size like `9x7` or `9x7x5`, each number 1 or more. `sizes` is how many there must be, 1 to 3; with 0, two
/// or three. Missing ones are 1.
std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes = 0);

/// Returns the reason for the failure of the last system call, from errno.
std::string system_reason();

}  // namespace chainmail::api
