#include "files/text/base64.h"

#include <algorithm>

namespace chainmail {
namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t none = 64;

/// The six bits that each character encodes, or none.
constexpr std::array<std::uint8_t, 256> values = [] {
  std::array<std::uint8_t, 256> result{};
  result.fill(none);
  for (std::size_t i = 0; i < alphabet.size(); ++i) {
    result[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return result;
}();

}  // namespace

void Base64Writer::write_group(int characters) {
  for (int i = 0; i < 4; ++i) {
    text_ << (i < characters ? alphabet[group_ >> (18 - 6 * i) & 63] : '=');
  }
  group_ = 0;
  bytes_ = 0;
}

void Base64Writer::finish() {
  if (bytes_ != 0) {
    const int characters = bytes_ + 1;
    group_ <<= 8 * (3 - bytes_);
    write_group(characters);
  }
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) {
    return std::nullopt;
  }
  const std::size_t filled = text.size() - std::min(text.find('='), text.size());  // padding is only allowed at the end
  if (filled > 2) {
    return std::nullopt;
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    const std::size_t missing = i + 4 == text.size() ? filled : 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint8_t value = k < 4 - missing ? values[static_cast<unsigned char>(text[i + k])]
                                                 : static_cast<std::uint8_t>(text[i + k] == '=' ? 0 : none);
      if (value == none) {
        return std::nullopt;
      }
      group = group << 6 | value;
    }
    for (std::size_t k = 0; k < 3 - missing; ++k) {
      bytes.push_back(static_cast<std::uint8_t>(group >> (16 - 8 * k)));
    }
    if (missing > 0 && (group & ((1U << (8 * missing)) - 1)) != 0) {
      return std::nullopt;  // unused bits must be 0
    }
  }
  return bytes;
}

}  // namespace chainmail
