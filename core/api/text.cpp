#include "chainmail/text.h"

#include "api/access.h"
#include "files/formats/read_options.h"
#include "files/text/text.h"
#include "report/page/format.h"

namespace chainmail::api {

std::string printable(std::string_view text) { return inner::printable(text); }
std::string in_quotes(std::string_view word) { return inner::in_quotes(word); }
std::string shown(const std::filesystem::path& path) { return inner::shown(path); }

std::string digits_of(double number) {
  std::string text;
  inner::append_number(text, number);
  return text;
}

std::string in_words(const Vector3& point) {
  return "(" + digits_of(point.x) + ", " + digits_of(point.y) + ", " + digits_of(point.z) + ")";
}

std::string figure(double number) { return report::figure(number); }

std::optional<double> parse_number(std::string_view word) { return inner::parse_number(word); }
std::optional<std::uint32_t> parse_count(std::string_view word) { return inner::parse_count(word); }
std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes) {
  return inner::parse_size(text, sizes);
}

std::string system_reason() { return inner::system_reason(); }

}  // namespace chainmail::api
