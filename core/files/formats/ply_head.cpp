#include "files/formats/ply_head.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::array ply_types{
    number_type<std::int8_t>("char"),     number_type<std::int8_t>("int8"),     number_type<std::uint8_t>("uchar"),
    number_type<std::uint8_t>("uint8"),   number_type<std::int16_t>("short"),   number_type<std::int16_t>("int16"),
    number_type<std::uint16_t>("ushort"), number_type<std::uint16_t>("uint16"), number_type<std::int32_t>("int"),
    number_type<std::int32_t>("int32"),   number_type<std::uint32_t>("uint"),   number_type<std::uint32_t>("uint32"),
    number_type<float>("float"),          number_type<float>("float32"),        number_type<double>("double"),
    number_type<double>("float64"),
};

class PlyHeadReader {
 public:
  PlyHeadReader(std::string_view bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {}

  PlyHead read() {
    head_.length = mark_length(bytes_);
    ends_ = bytes_.substr(0, bytes_.find("end_header")).find('\n') == std::string_view::npos ? '\r' : '\n';
    if (trimmed(line()) != "ply") {
      fail("it does not begin with 'ply'", "use a PLY file");
    }
    while (take(line())) {
    }
    if (!has_form_) {
      fail("its header has no line 'format …'", "export it again");
    }
    return std::move(head_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, std::max<std::size_t>(head_.lines, 1)), problem, remedy);
  }

  std::string_view line();
  /// Reads a line of the header. Returns false at the end of the header.
  bool take(std::string_view line);
  void take_form(std::string_view rest);
  void take_element(std::string_view rest);
  void take_property(std::string_view rest);
  const NumberType& type_of(std::string_view name) const;

  std::string_view bytes_;
  const std::filesystem::path& path_;
  bool has_form_ = false;
  char ends_ = '\n';  // the last character of each line
  PlyHead head_;
};

std::string_view PlyHeadReader::line() {
  const std::size_t end = bytes_.find(ends_, head_.length);
  ++head_.lines;
  if (end == std::string_view::npos) {
    fail("its header does not end", "export it again");
  }
  std::string_view line = bytes_.substr(head_.length, end - head_.length);
  head_.length = end + 1;
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

bool PlyHeadReader::take(std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == "end_header") {
    return false;
  }
  if (word == "format") {
    take_form(line);
  } else if (word == "element") {
    take_element(line);
  } else if (word == "property") {
    take_property(line);
  } else if (!word.empty() && word != "comment" && word != "obj_info") {
    ++head_.skipped;  // Blender 2.47 forgot the word 'comment'
  }
  return true;
}

void PlyHeadReader::take_form(std::string_view rest) {
  const std::string_view form = take_word(rest);
  if (form == "ascii") {
    head_.form = PlyForm::text;
  } else if (form == "binary_little_endian") {
    head_.form = PlyForm::little_endian;
  } else if (form == "binary_big_endian") {
    head_.form = PlyForm::big_endian;
  } else {
    fail("the format " + in_quotes(form) + " is not known", "save it as ascii or binary_little_endian");
  }
  has_form_ = true;
}

void PlyHeadReader::take_element(std::string_view rest) {
  PlyElement element;
  element.name = take_word(rest);
  const auto count = parse_count(take_word(rest));
  if (element.name.empty() || !count) {
    fail("an 'element' line has no name, or its count is not a whole number", "write 'element NAME COUNT'");
  }
  element.count = *count;
  head_.elements.push_back(std::move(element));
}

void PlyHeadReader::take_property(std::string_view rest) {
  if (head_.elements.empty()) {
    fail("a 'property' line comes before the first 'element' line", "write 'element NAME COUNT' before it");
  }
  PlyProperty property;
  std::string_view name = take_word(rest);
  if (name == "list") {
    property.count = &type_of(take_word(rest));
    name = take_word(rest);
  }
  property.type = &type_of(name);
  property.name = take_word(rest);
  head_.elements.back().properties.push_back(std::move(property));
}

const NumberType& PlyHeadReader::type_of(std::string_view name) const {
  const NumberType* found = find_number_type(ply_types, name);
  if (found == nullptr) {
    fail("numbers of type " + in_quotes(name) + " are not known", "save it with floats and ints");
  }
  return *found;
}

}  // namespace

PlyHead read_ply_head(std::string_view bytes, const std::filesystem::path& path) {
  return PlyHeadReader(bytes, path).read();
}

}  // namespace chainmail
