#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace chainmail {

/// A type of numbers in binary files: its name, its size and how to read it.
struct NumberType {
  std::string_view name;
  std::size_t bytes;
  double (*read_native)(const char* in_native_order);
  void (*read_natives)(const char* in_native_order, std::span<double> to);

  /// Returns the number at the beginning of `from`.
  double read(const char* from, bool big_endian) const {
    if (big_endian == (std::endian::native == std::endian::big)) {
      return read_native(from);
    }
    std::array<char, 8> native{};
    std::reverse_copy(from, from + bytes, native.begin());
    return read_native(native.data());
  }

  /// Reads numbers that follow each other.
  void read(const char* from, bool big_endian, std::span<double> to) const {
    if (big_endian == (std::endian::native == std::endian::big)) {
      read_natives(from, to);
      return;
    }
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] = read(from + i * bytes, big_endian);
    }
  }
};

template <class Number>
double number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

template <class Number>
constexpr NumberType number_type(std::string_view name) {
  constexpr auto read_all = [](const char* bytes, std::span<double> to) {
    for (double& one : to) {
      one = number_at<Number>(bytes);
      bytes += sizeof(Number);
    }
  };
  return {name, sizeof(Number), number_at<Number>, read_all};
}

/// Returns the type with this name; null if there is none.
inline const NumberType* find_number_type(std::span<const NumberType> types, std::string_view name) {
  const auto found = std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.name == name; });
  return found == types.end() ? nullptr : &*found;
}

}  // namespace chainmail
