#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace chainmail::report {

/// A number for people: three digits, `n/a` where there is none. The same whatever the locale.
std::string figure(double number);
std::string figure(const std::optional<double>& number);
/// A share for people, in percent.
std::string percent(double share);
/// A number for programs: the fewest digits that read back as the same number.
std::string all_digits(double number);
std::string all_digits(const std::optional<double>& number);  // none: empty

/// Text as a field of CSV, in quotes where it must be.
std::string csv_field(const std::string& text);
/// Text as it may stand in XML and HTML, in attributes too. Control characters, which neither can hold, and
/// what is not UTF-8 become question marks.
std::string escaped(std::string_view text);

}  // namespace chainmail::report
