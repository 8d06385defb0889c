#include "files/formats/dat_rows.h"

#include <string>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

class DatParser {
 public:
  explicit DatParser(const std::filesystem::path& path) : path_(path) {}

  DatRows parse(std::string_view text, const Progress& progress);

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }
  template <class Value>
  void state(std::optional<Stated<Value>>& known, const Value& value, const std::string& what) const;
  void read_comment(std::string_view line);
  void read_size(std::string_view numbers);
  void read_spacing(std::string_view numbers);
  void read_row(std::string_view line);
  ElementId read_id(std::string_view word) const;
  std::uint32_t read_count(std::string_view word) const;

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  DatRows result_;
};

template <class Value>
void DatParser::state(std::optional<Stated<Value>>& known, const Value& value, const std::string& what) const {
  if (known && known->value != value) {
    fail("the " + what + " differs from that of line " + std::to_string(known->line), "state it once");
  }
  known = Stated<Value>{value, line_};
}

void DatParser::read_size(std::string_view numbers) {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  int count = 0;
  for (auto word = take_word(numbers); !word.empty(); word = take_word(numbers)) {
    const auto number = parse_count(word);
    if (!number || *number == 0 || count == 3) {
      fail("the size is not up to three whole numbers from 1", "write '# size W [H [D]]'");
    }
    size[count++] = *number;
  }
  state(result_.size, size, "size");
}

void DatParser::read_spacing(std::string_view numbers) {
  const auto number = parse_number(take_word(numbers));
  if (!number || !(*number > 0) || !take_word(numbers).empty()) {
    fail("the spacing is not one number above 0", "write '# spacing S'");
  }
  state(result_.spacing, *number, "spacing");
}

void DatParser::read_comment(std::string_view line) {
  if (const auto size = stated(line, "size")) {
    read_size(*size);
  } else if (const auto spacing = stated(line, "spacing")) {
    read_spacing(*spacing);
  } else if (const auto space = stated_space(line, path_, line_)) {
    state(result_.space, *space, "space dimension");
  }
}

ElementId DatParser::read_id(std::string_view word) const {
  const auto id = parse_count(word);
  if (!id) {
    fail(in_quotes(word) + " is not an element's id", "ids are whole numbers from 0");
  }
  return *id;
}

std::uint32_t DatParser::read_count(std::string_view word) const {
  if (word.empty()) {
    fail("the row ends before the count", "write 'id count neighbour…'");
  }
  const auto count = parse_count(word);
  if (!count) {
    fail(in_quotes(word) + " is not a count of neighbours", "write 'id count neighbour…'");
  }
  return *count;
}

void DatParser::read_row(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const auto first = take_word(line);
  if (first.empty()) {
    return;
  }
  if (result_.rows.size() == element_limit) {
    fail("there are more than " + std::to_string(element_limit) + " rows", "use a smaller mesh");
  }
  DatRows::Row row{read_id(first), line_, result_.neighbours.size(), 0};
  const std::uint32_t count = read_count(take_word(line));
  for (auto word = take_word(line); !word.empty(); word = take_word(line)) {
    result_.neighbours.push_back(read_id(word));
    if (result_.neighbours.back() == row.id) {
      fail("element " + std::to_string(row.id) + " is linked to itself", "remove that neighbour");
    }
  }
  row.last = result_.neighbours.size();
  if (const std::size_t listed = row.last - row.first; listed != count) {
    fail("the count says " + std::to_string(count) + " neighbours, the row lists " + std::to_string(listed),
         "make them agree");
  }
  result_.rows.push_back(row);
}

DatRows DatParser::parse(std::string_view text, const Progress& progress) {
  Lines lines(text);
  while (lines.next()) {
    line_ = lines.number();
    lines.report(progress);
    read_comment(lines.line());
    read_row(lines.line());
  }
  result_.last_line = line_;
  return std::move(result_);
}

}  // namespace

DatRows parse_dat(std::string_view text, const std::filesystem::path& path, const Progress& progress) {
  return DatParser(path).parse(text, progress);
}

}  // namespace chainmail
