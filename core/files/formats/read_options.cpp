#include "files/formats/read_options.h"

#include <algorithm>

#include "files/text/text.h"

namespace chainmail {

std::optional<std::array<std::uint32_t, 3>> parse_size(std::string_view text, int sizes) {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  int count = 0;
  for (;;) {
    const std::size_t end = std::min(text.find('x'), text.size());
    const auto number = parse_count(text.substr(0, end));
    if (!number || *number == 0 || count == 3) {
      return std::nullopt;
    }
    size[count++] = *number;
    if (end == text.size()) {
      break;
    }
    text.remove_prefix(end + 1);
  }
  return (sizes == 0 ? count > 1 : count == sizes) ? std::optional(size) : std::nullopt;
}

}  // namespace chainmail
