#include "files/formats/nrrd_head.h"

#include <algorithm>
#include <vector>

#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Returns the field name of a line in lower case; empty for a comment and for a pair `key:=value` of the user.
std::string field_of(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (line.starts_with('#') || colon == std::string_view::npos || line.substr(colon).starts_with(":=")) {
    return {};
  }
  return lower_case(line.substr(0, colon));
}

[[noreturn]] void refuse_header(const std::filesystem::path& path, std::size_t line, const std::string& problem) {
  throw Error(shown(path, line), problem, "export it again, as one file");
}

/// Returns the lines up to the empty one that ends a header, or up to the end of the file.
std::vector<std::string_view> header_lines(std::string_view text, const std::filesystem::path& path) {
  std::vector<std::string_view> lines;
  const bool is_whole = text.size() < limits::nrrd_header_bytes;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    line.remove_suffix(line.ends_with('\r') ? 1 : 0);
    if (line.empty()) {
      return lines;
    }
    lines.push_back(line);
    if (line.find('\r') != std::string_view::npos) {
      refuse_header(path, lines.size(), "a line of its header contains a carriage return");
    }
    text.remove_prefix(std::min(end, text.size() - 1) + 1);
  }
  if (!is_whole) {
    refuse_header(path, lines.size(), "its header does not end with an empty line");
  }
  return lines;
}

/// Returns the file name in a field.
std::string named_in(std::string_view line, const std::filesystem::path& path, std::size_t number) {
  const auto name = trimmed(line.substr(line.find(':') + 1));
  if (name.empty() || name.starts_with("LIST") || name.find('%') != std::string_view::npos) {
    refuse_header(path, number, "its data are in several files, or in none");
  }
  return std::string(name);
}

}  // namespace

NrrdHead read_nrrd_head(std::string_view beginning, const std::filesystem::path& path) {
  NrrdHead head;
  std::size_t number = 0;
  for (std::string_view line : header_lines(beginning, path)) {
    ++number;
    const std::string field = field_of(line);
    if (field == "data file" || field == "datafile") {
      if (!head.data_file.empty()) {
        refuse_header(path, number, "its header names its data twice");
      }
      head.data_file = named_in(line, path, number);
      line = "data file: data";
    } else if (field.find("file") != std::string::npos) {  // teem may read it as a data file
      refuse_header(path, number, in_quotes(line) + " is not a field of a header");
    }
    head.text.append(line).append("\n");
  }
  return head;
}

}  // namespace chainmail
