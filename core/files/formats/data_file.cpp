#include "files/formats/data_file.h"

#include <algorithm>

#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

bool is_beneath(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Adds the name that a pattern gives for a number, unless its only conversion is not that of a whole number.
void add_numbered(std::string_view pattern, std::uint64_t number, std::vector<std::string>& names) {
  const std::size_t begin = pattern.find('%'),
                    end = std::min(pattern.find_first_not_of("0123456789", begin + 1), pattern.size());
  const std::string_view digits = pattern.substr(begin + 1, end - begin - 1), behind = pattern.substr(end);
  if (digits.size() <= 2 && behind.starts_with('d') && behind.find('%') == std::string_view::npos) {
    std::string text = std::to_string(number);
    const std::size_t width = std::max<std::size_t>(parse_count(digits).value_or(0), text.size());
    text.insert(0, width - text.size(), digits.starts_with('0') ? '0' : ' ');
    names.push_back(std::string(pattern.substr(0, begin)) + text + std::string(behind.substr(1)));
  }
}

}  // namespace

fs::path data_file(const fs::path& header, const std::string& name, bool outside) {
  if (name.empty()) {
    throw Error(shown(header), "it does not name a data file", "export it again");
  }
  fs::path path = header.parent_path() / name;
  if (outside) {
    return path;
  }
  fs::path target = resolved(path);
  if (!is_beneath(target, resolved(header.has_parent_path() ? header.parent_path() : "."))) {
    throw Error(shown(header), "its data are outside its folder, in " + in_quotes(name),
                "copy them into that folder, or use --data-outside allow on the command line");
  }
  return target;
}

DataNames data_names(std::string_view value, std::string_view lines_behind, std::uint64_t count, std::uint64_t most) {
  DataNames result;
  std::string_view words = value;
  if (take_word(words) == "LIST") {
    Lines lines(lines_behind);
    while (lines.next() && result.names.size() <= most) {
      if (const auto name = trimmed(lines.line()); !name.empty()) {
        result.names.emplace_back(name);
      }
    }
    result.are_parts = true;
  } else if (value.find('%') != std::string_view::npos) {
    words = value;
    const std::string_view pattern = take_word(words);
    const auto number = [&words](std::uint64_t usual) { return parse_count(take_word(words)).value_or(usual); };
    const std::uint64_t first = number(1), last = number(count), step = number(1);
    if (step > 0 && first <= last && (last - first) / step < most) {
      for (std::uint64_t i = first; i <= last; i += step) {
        add_numbered(pattern, i, result.names);
      }
    }
    result.are_parts = true;
  } else if (!value.empty()) {
    result.names.emplace_back(value);
  }
  result.dimension = result.are_parts ? trimmed(words) : std::string_view();
  return result;
}

}  // namespace chainmail
