#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "files/text/text.h"

namespace chainmail {

/// Writes the bytes of numbers in base64 (RFC 4648).
class Base64Writer {
 public:
  explicit Base64Writer(TextBlocks& text) : text_(text) {}

  template <class Number>
  void add(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    for (const std::uint8_t byte : std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(number)) {
      add_byte(byte);
    }
  }
  /// Writes the remaining bytes. Call this at the end.
  void finish();

 private:
  void add_byte(std::uint8_t byte) {
    group_ = group_ << 8 | byte;
    if (++bytes_ == 3) {
      write_group(4);
    }
  }
  void write_group(int characters);

  TextBlocks& text_;
  std::uint32_t group_ = 0;
  int bytes_ = 0;
};

/// Decodes a text in the exact form that Base64Writer writes; none if it has another form.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace chainmail
