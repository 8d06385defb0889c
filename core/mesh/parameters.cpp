#include "mesh/parameters.h"

#include <array>
#include <charconv>

#include "mesh/error.h"

namespace chainmail {
namespace {

/// Returns the shortest text that reads back as the same number; from 0.0001 to a billion without an exponent.
std::string shortest_digits(double number) {
  std::array<char, 32> text{};
  char* const end = text.data() + text.size();
  return {text.data(), number >= 1e-4 && number <= 1e9
                           ? std::to_chars(text.data(), end, number, std::chars_format::fixed).ptr
                           : std::to_chars(text.data(), end, number).ptr};
}

}  // namespace

std::string range_of(const Parameter& parameter) {
  const bool open = parameter.highest == parameters::no_highest;
  if (parameter.lowest == parameters::above_zero) {
    return "a number above 0" + (open ? std::string() : ", up to " + shortest_digits(parameter.highest));
  }
  const std::string highest =
      parameter.highest == parameters::below_half ? "below 0.5" : shortest_digits(parameter.highest);
  return shortest_digits(parameter.lowest) + (open ? std::string(" or more") : " to " + highest);
}

void check(const Parameter& parameter, double value) {
  if (!(value >= parameter.lowest && value <= parameter.highest)) {
    throw Error(std::string(parameter.name),
                std::string(parameter.label) + ' ' + shortest_digits(value) + " is out of range",
                "use " + range_of(parameter));
  }
}

}  // namespace chainmail
