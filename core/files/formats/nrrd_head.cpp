#include "files/formats/nrrd_head.h"

#include <algorithm>

#include "files/formats/data_file.h"
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
    if (lines.size() > limits::nrrd_header_lines) {
      throw Error(shown(path), "its header has more than " + std::to_string(limits::nrrd_header_lines) + " lines",
                  "leave out comments and keys");
    }
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

/// Takes the file names of a line, and of those behind it if it has a list. Returns the field with our names.
std::string take_names(const std::vector<std::string_view>& lines, std::size_t at, const std::filesystem::path& path,
                       NrrdHead& head) {
  const std::string_view line = lines[at];
  const std::string_view behind(line.end(), lines.back().end());
  const DataNames data = data_names(trimmed(line.substr(line.find(':') + 1)), behind, 0, limits::nrrd_files);
  if (data.names.empty() || data.names.size() > limits::nrrd_files) {
    refuse_header(path, at + 1, "it does not name 1 to " + std::to_string(limits::nrrd_files) + " data files");
  }
  head.data_files = data.names;
  std::string field = "data file: ";
  if (data.are_parts) {
    field.append("LIST").append(data.dimension.empty() ? "" : " ").append(data.dimension).append("\n");
  }
  for (std::size_t i = 0; i < data.names.size(); ++i) {
    field += nrrd_data_name(i) + "\n";
  }
  return field;
}

}  // namespace

NrrdHead read_nrrd_head(std::string_view beginning, const std::filesystem::path& path) {
  NrrdHead head;
  std::string data;  // the field of the data files, which is the last one
  const auto lines = header_lines(beginning, path);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string field = field_of(lines[i]);
    if (field == "data file" || field == "datafile") {
      if (!data.empty()) {
        refuse_header(path, i + 1, "its header names its data twice");
      }
      data = take_names(lines, i, path, head);
      i = data.starts_with("data file: LIST") ? lines.size() : i;
    } else if (field.find("file") != std::string::npos) {  // teem may read it as a data file
      refuse_header(path, i + 1, in_quotes(lines[i]) + " is not a field of a header");
    } else {
      head.text.append(lines[i]).append("\n");
    }
  }
  head.text += data;
  return head;
}

}  // namespace chainmail
