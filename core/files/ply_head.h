#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chainmail {

/// A type of numbers, by its size and kind: how many bytes it takes in a binary file, and how they are read.
struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  double (*read)(const char* in_native_order);
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count = nullptr;  // of a list, else none
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyForm { text, little_endian, big_endian };

/// The head of a PLY file: which elements follow, and which properties each has.
struct PlyHead {
  PlyForm form = PlyForm::text;
  std::vector<PlyElement> elements;
  std::size_t length = 0;  // of the head (bytes)
  std::size_t lines = 0;
};

/// Reads the head at the beginning of a file. Throws Error with the line.
PlyHead read_ply_head(std::string_view bytes, const std::filesystem::path& path);

}  // namespace chainmail
