#include "files/formats/vtk_cursor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::string_view vtk_blanks = " \t\r\n";

/// Types of numbers, with the sizes that VTK's legacy readers use on 64-bit machines.
constexpr std::array vtk_types{
    number_type<float>("float"),
    number_type<double>("double"),
    number_type<std::int32_t>("int"),
    number_type<std::uint32_t>("unsigned_int"),
    number_type<std::int64_t>("long"),
    number_type<std::uint64_t>("unsigned_long"),
    number_type<std::int64_t>("vtktypeint64"),
    number_type<std::uint64_t>("vtktypeuint64"),
    number_type<std::int64_t>("vtkidtype"),
    number_type<std::int16_t>("short"),
    number_type<std::uint16_t>("unsigned_short"),
    number_type<std::int8_t>("char"),
    number_type<std::uint8_t>("unsigned_char"),
};

}  // namespace

void VtkCursor::fail(const std::string& problem, const std::string& remedy) const {
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(std::min(at_, bytes_.size())), '\n');
  // In a binary file, lines have no meaning.
  throw Error(binary_ ? shown(path_) : shown(path_, static_cast<std::size_t>(lines) + 1), problem, remedy);
}

std::string_view VtkCursor::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  std::string_view result = bytes_.substr(std::min(at_, end), end - std::min(at_, end));
  at_ = std::min(end + 1, bytes_.size());
  if (result.ends_with('\r')) {
    result.remove_suffix(1);
  }
  return result;
}

std::string_view VtkCursor::word() {
  at_ = std::min(bytes_.find_first_not_of(vtk_blanks, at_), bytes_.size());
  const std::size_t end = std::min(bytes_.find_first_of(vtk_blanks, at_), bytes_.size());
  const std::string_view result = bytes_.substr(at_, end - at_);
  at_ = end;
  return result;
}

std::uint64_t VtkCursor::count(const std::string& what) {
  const auto text = word();
  const auto number = parse_count(text);
  if (!number) {
    fail((text.empty() ? "a number is missing: " : in_quotes(text) + " is not ") + what, "write a whole number");
  }
  return *number;
}

double VtkCursor::number() {
  const auto text = word();
  const auto number = parse_number(text);
  if (!number) {
    fail(text.empty() ? "it ends within its numbers" : in_quotes(text) + " is not a number", number_remedy(text));
  }
  return *number;
}

template <class Visit>
void VtkCursor::visit_binary(std::uint64_t count, std::string_view type, Visit visit) {
  const NumberType* found = find_number_type(vtk_types, lower_case(type));
  if (found == nullptr) {
    fail("numbers of type " + in_quotes(type) + " are not known", "save it with floats or doubles");
  }
  line();  // the numbers begin on the next line
  if (count > (bytes_.size() - at_) / found->bytes) {
    fail("it ends within its numbers", "export it again");
  }
  for (std::uint64_t i = 0; i < count; ++i, at_ += found->bytes) {
    progress_.report(at_, bytes_.size());
    constexpr bool big_endian = true;
    visit(found->read(bytes_.data() + at_, big_endian));
  }
}

template <class Visit>
void VtkCursor::visit_numbers(std::uint64_t count, std::string_view type, Visit visit) {
  if (binary_) {
    return visit_binary(count, type, visit);
  }
  if (count > (bytes_.size() - at_ + 1) / 2) {
    fail("it ends within its numbers", "export it again");
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    progress_.report(i, count);
    visit(number());
  }
}

std::vector<double> VtkCursor::reals(std::uint64_t count, std::string_view type) {
  std::vector<double> numbers;
  visit_numbers(count, type, [&](double number) { numbers.push_back(number); });
  return numbers;
}

std::vector<std::uint64_t> VtkCursor::wholes(std::uint64_t count, std::string_view type) {
  static constexpr double largest = 1e15;  // smaller whole numbers are exact in double
  std::vector<std::uint64_t> numbers;
  visit_numbers(count, type, [&](double number) {
    if (!(number >= 0 && number <= largest) || number != std::floor(number)) {
      fail("a number is not a whole number from 0", "export it again");
    }
    numbers.push_back(static_cast<std::uint64_t>(number));
  });
  return numbers;
}

void VtkCursor::skip_field(std::uint64_t count, std::string_view type) {
  if (type == "string") {
    line();
    for (std::uint64_t i = 0; i < count; ++i) {
      skip_string();
    }
  } else if (type == "bit" && binary_) {
    line();
    skip_bytes(count / 8 + (count % 8 > 0 ? 1 : 0));
  } else {
    visit_numbers(count, type, [](double) {});
  }
}

void VtkCursor::skip_bytes(std::uint64_t count) {
  if (count > bytes_.size() - at_) {
    fail("it ends within a field", "export it again");
  }
  at_ += count;
}

/// In a binary file, the two highest bits of the first byte say how many bytes the length has, big end first.
void VtkCursor::skip_string() {
  if (at_ == bytes_.size()) {
    fail("it ends within a field", "export it again");
  }
  if (!binary_) {
    line();
    return;
  }
  const auto first = static_cast<unsigned char>(bytes_[at_]);
  const std::size_t bytes = std::size_t{1} << (3U - (first >> 6U));
  std::uint64_t length = first & 63U;
  for (std::size_t i = 1; i < std::min(bytes, bytes_.size() - at_); ++i) {
    length = length << 8U | static_cast<unsigned char>(bytes_[at_ + i]);
  }
  skip_bytes(bytes);
  skip_bytes(length);
}

void VtkCursor::skip_block() {
  line();
  while (at_ < bytes_.size() && !line().empty()) {
  }
}

}  // namespace chainmail
