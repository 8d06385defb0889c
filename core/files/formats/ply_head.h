#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/text/number_type.h"

namespace chainmail {

struct PlyProperty {
  std::string name;
  const NumberType* type = nullptr;
  const NumberType* count = nullptr;  // type of a list's length; null if it is not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyForm { text, little_endian, big_endian };

/// The header of a PLY file: the elements that follow, and the properties of each.
struct PlyHead {
  PlyForm form = PlyForm::text;
  std::vector<PlyElement> elements;
  std::size_t length = 0;  // length of the header (bytes)
  std::size_t lines = 0;
  std::size_t skipped = 0;  // lines that the format does not have
};

/// Reads the header. Throws Error, with the line.
PlyHead read_ply_head(std::string_view bytes, const std::filesystem::path& path);

}  // namespace chainmail
