#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "body/softness.h"

namespace chainmail::report {

/// Formats a number for people, with three significant digits in every locale; `n/a` if there is none. Numbers from
/// 1,000 to a million are written as whole numbers with separated thousands.
std::string figure(double number, int digits = 3);
std::string figure(const std::optional<double>& number);
/// Formats an error for people. One below the change of its reference by the last refinement says no more than that:
/// `below 0.02`.
std::string error_figure(double error, const std::optional<double>& change);
/// Formats a count for people: a comma separates the thousands, as in the window.
std::string thousands(std::uint64_t count);
/// Pads the figures of a column with spaces as wide as digits, so that their decimal points stand below each other when
/// they are aligned to the right. Texts that are not one number stay.
std::vector<std::string> aligned(std::vector<std::string> column);
/// Formats a time (ms) with a fitting unit: 21 µs, 0.45 ms, 1.2 s.
std::string time_in_words(double ms);
/// Formats a share for people, in percent; `n/a` if there is none.
std::string percent(double share);
std::string percent(const std::optional<double>& share);
/// Formats a change for people, in percent with its sign; `n/a` if there is none.
std::string signed_percent(const std::optional<double>& change);
/// Formats a number of things for people; `n/a` if there is none.
std::string count(const std::optional<double>& number);
/// Formats the numbers that a calibration finds, with their names: those of the valid region, or those of the energy.
std::string region_in_words(const LinkSoftness& softness);
std::string energy_in_words(const LinkSoftness& softness);
/// Formats a number for programs, with the fewest digits that read back as the same number; empty if there is none.
std::string all_digits(double number);
std::string all_digits(const std::optional<double>& number);

/// Returns text as a field of CSV, in quotes if needed.
std::string csv_field(const std::string& text);
/// Returns text for XML and HTML, attributes included. Control characters and invalid UTF-8 become question marks.
std::string escaped(std::string_view text);

}  // namespace chainmail::report
