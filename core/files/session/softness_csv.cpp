#include "files/session/softness_csv.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Fields of a row: the two ends of a link, then the first numbers of its softness or all.
constexpr std::size_t short_columns = 2 + region_numbers, all_columns = 2 + softness_numbers.size();

std::string row_form(std::size_t columns) { return "a,b," + softness_names(",", 0, columns - 2); }

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = std::min(line.find(','), line.size());
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == line.size()) {
      return fields;
    }
    line.remove_prefix(end + 1);
  }
}

bool is_header(std::span<const std::string_view> fields) {
  return std::ranges::equal(fields, fields_of(row_form(all_columns))) ||
         std::ranges::equal(fields, fields_of(row_form(short_columns)));
}

class SoftnessReader {
 public:
  SoftnessReader(const std::filesystem::path& path, const Mesh& mesh) : path_(path), mesh_(mesh) {}

  OwnSoftness read(std::string_view text) {
    Lines lines(text);
    bool is_first = true;
    while (lines.next()) {
      line_ = lines.number();
      const std::string_view row = trimmed(lines.line().substr(0, lines.line().find('#')));
      if (row.empty()) {
        continue;
      }
      const auto fields = fields_of(row);
      if (!is_first || !is_header(fields)) {
        read_row(fields);
      }
      is_first = false;
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }
  void read_row(const std::vector<std::string_view>& fields) {
    if (fields.size() != short_columns && fields.size() != all_columns) {
      fail("the row has " + std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields") +
               ", not five or eight",
           "write '" + row_form(short_columns) + "' or '" + row_form(all_columns) + "'");
    }
    const LinkId link = read_link(fields[0], fields[1]);
    LinkSoftness softness;
    for (std::size_t i = 2; i < fields.size(); ++i) {
      softness.*softness_numbers[i - 2].value = read_number(fields[i]);
    }
    try {
      check(softness);
    } catch (const Error& error) {
      throw error.at(shown(path_, line_) + ": " + error.where());
    }
    if (const auto [known, is_new] = line_of_.emplace(link, line_); !is_new) {
      fail("this link is given twice, first in line " + std::to_string(known->second), "remove one of the rows");
    }
    result_.set(link, softness);
  }
  LinkId read_link(std::string_view first, std::string_view second) const {
    const ElementId a = read_id(first), b = read_id(second);
    const auto link = find_link(mesh_, a, b);
    if (!link) {
      fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
           "give the two ends of a link");
    }
    return *link;
  }
  ElementId read_id(std::string_view field) const {
    const auto id = parse_count(field);
    if (!id) {
      fail(in_quotes(field) + " is not an element's id", "ids are whole numbers from 0");
    }
    if (*id >= mesh_.element_count()) {
      fail("there is no element " + std::to_string(*id),
           "ids run from 0 to " + std::to_string(mesh_.element_count() - 1));
    }
    return *id;
  }
  double read_number(std::string_view field) const {
    const auto number = parse_number(field);
    if (!number) {
      fail(in_quotes(field) + " is not a finite number", "write a decimal number like 0.5");
    }
    return *number;
  }

  const std::filesystem::path& path_;
  const Mesh& mesh_;
  std::size_t line_ = 0;
  OwnSoftness result_;
  std::map<LinkId, std::size_t> line_of_;
};

}  // namespace

OwnSoftness read_softness(std::string_view text, const std::filesystem::path& path, const Mesh& mesh) {
  return SoftnessReader(path, mesh).read(text);
}

OwnSoftness read_softness(const std::filesystem::path& path, const Mesh& mesh) {
  return read_softness(read_text(path, "softness"), path, mesh);
}

}  // namespace chainmail
