#include "report/page/figures.h"

namespace chainmail::report {
namespace {

std::optional<double> number_in(const FigureValue& value) {
  const auto* number = std::get_if<double>(&value);
  const auto* count = std::get_if<std::int64_t>(&value);
  const auto* is = std::get_if<bool>(&value);
  return number != nullptr  ? std::optional(*number)
         : count != nullptr ? std::optional(double(*count))
         : is != nullptr    ? std::optional(double(*is))
                            : std::nullopt;
}

}  // namespace

std::string csv_text(const FigureValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  const auto* count = std::get_if<std::int64_t>(&value);
  return text != nullptr ? csv_field(*text) : count != nullptr ? std::to_string(*count) : all_digits(number_in(value));
}

std::string cell_of(const FigureValue& value, std::string (*of_number)(const std::optional<double>&)) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : of_number(number_in(value));
}

}  // namespace chainmail::report
